#version 460
#extension GL_GOOGLE_include_directive : require
// Vertices along edges between regular vertices, whose records are made on the way and kept nowhere: memory is what they cost.
#include "edge_points.glsl"
#include "regular_edge.glsl"

void main() {
    uint thread = thread_index();
    if (thread < edges.count) {
        // Sources are numbered as records are.
        uint edge = edges.first_record + thread;
        write_edge_points(edge, regular_edge_record(edge));
    }
}
