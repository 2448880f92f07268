#version 460
#extension GL_GOOGLE_include_directive : require
// Edge records between regular vertices.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "regular_edge.glsl"
#include "edge_store.glsl"

void main() {
    uint source = thread_index();
    if (source >= kernel.count) {
        return;
    }
    EdgeRecord record = regular_edge_record(source);
    uint edge = kernel.first + source;
    for (uint row = 0u; row < 4u; ++row) {
        store_edge_point(edge, row, record.curve[row]);
        store_edge_point(edge, row + 4u, record.cross_field[row]);
    }
}
