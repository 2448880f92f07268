#version 460
#extension GL_GOOGLE_include_directive : require
// Vertices along edges, from their records.
#include "edge_points.glsl"
#include "records.glsl"

void main() {
    uint thread = thread_index();
    if (thread < edges.count) {
        uint edge = edges.first_record + thread;
        write_edge_points(edge, load_edge_record(edge));
    }
}
