#version 460
#extension GL_GOOGLE_include_directive : require
// Edge records of nets that are not regular: one thread per control point, a row of osculate_surface::gregory::edge times the net.
// Twin: osculate_subdiv::twin::edge_records.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "sources.glsl"
#include "edge_store.glsl"

void main() {
    uint thread = thread_index();
    uint record = thread / EDGE_RECORD_POINTS;
    uint row = thread % EDGE_RECORD_POINTS;
    if (record >= kernel.count) {
        return;
    }
    store_edge_point(kernel.first + record, row, matrix_row(sources[record], row));
}
