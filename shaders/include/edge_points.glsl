// Vertices along edges that are all divided alike: numbered by records, in the record's direction, nothing measured. One thread per edge.
#ifndef EDGE_POINTS_GLSL
#define EDGE_POINTS_GLSL
#include "thread.glsl"
#include "edge_points_push.glsl"
#include "edge_record.glsl"
#include "grid.glsl"

layout(std430, set = 0, binding = BINDING_GRID_VERTICES) writeonly buffer GridVertices { float grid_vertices[]; };

void store_edge_vertex(uint number, SurfacePoint point) {
    uint at = GRID_PLACE_WORDS * number;
    grid_vertices[at] = point.position.x;
    grid_vertices[at + 1u] = point.position.y;
    grid_vertices[at + 2u] = point.position.z;
    grid_vertices[at + 3u] = point.normal.x;
    grid_vertices[at + 4u] = point.normal.y;
    grid_vertices[at + 5u] = point.normal.z;
}

void write_edge_points(uint edge, EdgeRecord record) {
    uint segments = rate_segments(edges.rate);
    uint first = edges.first_vertex + (segments - 1u) * edge;
    for (uint i = 1u; i < segments; ++i) {
        store_edge_vertex(first + i - 1u, edge_point(record, rate_parameter(edges.rate, i)));
    }
}

#endif
