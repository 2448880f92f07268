// Vertex and edge records: the one source of positions and normals on shared vertices and edges (ARCHITECTURE.md, "Records").
// Equal record and equal t give equal bits in every stage and pipeline; hence `precise` throughout.
#ifndef RECORDS_GLSL
#define RECORDS_GLSL
#include "bindings.glsl"
#include "constants.glsl"
#include "edge_record.glsl"

// What a patch needs beside its net. vertex[k]: record of corner k. edge[k]: record of side k, shifted left by one, plus the flip bit.
struct PatchRecord {
    uint vertex[4];
    uint edge[4];
    // First index of the net in Nets; of a stored patch the first of its vectors in Coefficients.
    uint net;
    // First weight of the change of basis in Weights.
    uint basis;
    // Points of the net.
    uint net_size;
    // FORM_*, TAG_*, valence.
    uint tag;
};

layout(std430, set = 0, binding = BINDING_PATCHES) readonly buffer Patches { PatchRecord patches[]; };
layout(std430, set = 0, binding = BINDING_VERTEX_RECORDS) readonly buffer VertexRecords { float vertex_records[]; };
layout(std430, set = 0, binding = BINDING_EDGE_RECORDS) readonly buffer EdgeRecords { float edge_records[]; };

vec3 edge_record_point(uint edge, uint i) {
    uint at = EDGE_RECORD_FLOATS * edge + 3u * i;
    return vec3(edge_records[at], edge_records[at + 1u], edge_records[at + 2u]);
}

SurfacePoint vertex_record_point(uint vertex) {
    uint at = VERTEX_RECORD_FLOATS * vertex;
    return SurfacePoint(
        vec3(vertex_records[at], vertex_records[at + 1u], vertex_records[at + 2u]),
        vec3(vertex_records[at + 3u], vertex_records[at + 4u], vertex_records[at + 5u]));
}

EdgeRecord load_edge_record(uint edge) {
    EdgeRecord r;
    for (uint i = 0u; i < 4u; ++i) {
        r.curve[i] = edge_record_point(edge, i);
        r.cross_field[i] = edge_record_point(edge, 4u + i);
    }
    return r;
}

SurfacePoint edge_record_at(uint edge, float t) {
    return edge_point(load_edge_record(edge), t);
}

#endif
