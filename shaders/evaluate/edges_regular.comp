#version 460
#extension GL_GOOGLE_include_directive : require
// Vertices along edges between regular vertices, whose records are made on the way and kept nowhere: memory is what they cost.
#include "edge_points.glsl"
#include "regular_edge.glsl"

void main() {
    uint source = thread_index();
    if (source < edges.count) {
        write_edge_points(edges.first_record + source, regular_edge_record(source));
    }
}
