// Vertex and edge records: the one source of positions and normals on shared vertices and edges (ARCHITECTURE.md, "Records").
// Equal record and equal t give equal bits in every stage and pipeline; hence `precise` throughout.
#ifndef RECORDS_GLSL
#define RECORDS_GLSL
#include "bindings.glsl"
#include "constants.glsl"
#include "edge_record.glsl"

// What a patch needs beside its net, twelve numbers: records of its corners; records of its sides, shifted left by one, plus the flip bit; then first index of
// the net in Nets (of a stored patch the first of its vectors in Coefficients), first weight of the change of basis in Weights, points of the net, tag: FORM_*, TAG_*, valence.
layout(set = 0, binding = BINDING_PATCHES) uniform usamplerBuffer patches;
// Position and normal of every vertex record.
layout(set = 0, binding = BINDING_VERTEX_RECORD_TEXELS) uniform samplerBuffer vertex_records;
// Control points of C and of D of every edge record.
layout(set = 0, binding = BINDING_EDGE_RECORD_TEXELS) uniform samplerBuffer edge_records;

// Record of a corner.
uint patch_vertex(uint id, uint corner) {
    return texelFetch(patches, int(3u * id))[corner];
}

// Record of a side and flip bit.
uint patch_edge(uint id, uint side) {
    return texelFetch(patches, int(3u * id + 1u))[side];
}

struct PatchBasis {
    uint net;
    uint basis;
    uint net_size;
    uint tag;
};

PatchBasis patch_basis(uint id) {
    uvec4 p = texelFetch(patches, int(3u * id + 2u));
    return PatchBasis(p.x, p.y, p.z, p.w);
}

vec3 edge_record_point(uint edge, uint i) {
    return texelFetch(edge_records, int(EDGE_RECORD_POINTS * edge + i)).xyz;
}

SurfacePoint vertex_record_point(uint vertex) {
    int at = int(2u * vertex);
    return SurfacePoint(texelFetch(vertex_records, at).xyz, texelFetch(vertex_records, at + 1).xyz);
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
