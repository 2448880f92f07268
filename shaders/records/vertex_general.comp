#version 460
#extension GL_GOOGLE_include_directive : require
// Vertex records of nets that are not regular: the three rows of osculate_surface::gregory::vertex times the net.
// Twin: osculate_subdiv::twin::vertex_records.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "sources.glsl"
#include "vertex_store.glsl"

void main() {
    uint record = thread_index();
    if (record >= kernel.count) {
        return;
    }
    MatrixSource source = sources[record];
    store_vertex(kernel.first + record, matrix_row(source, 0u), matrix_row(source, 1u), matrix_row(source, 2u));
}
