// Vertices along edges that are all divided alike: numbered by records, in the record's direction, nothing measured. One thread per edge.
#ifndef EDGE_POINTS_GLSL
#define EDGE_POINTS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "thread.glsl"
#include "edge_points_push.glsl"
#include "edge_record.glsl"
#include "grid.glsl"

layout(scalar, set = 0, binding = BINDING_GRID_VERTICES) writeonly buffer GridVertices { vec3 grid_vertices[]; };

void store_edge_vertex(uint number, SurfacePoint point) {
    grid_vertices[2u * number] = point.position;
    grid_vertices[2u * number + 1u] = point.normal;
}

void write_edge_points(uint edge, EdgeRecord record) {
    uint segments = rate_segments(edges.rate);
    uint first = edges.first_vertex + (segments - 1u) * edge;
    for (uint i = 1u; i < segments; ++i) {
        store_edge_vertex(first + i - 1u, edge_point(record, rate_parameter(edges.rate, i)));
    }
}

#endif
