#version 460
#extension GL_GOOGLE_include_directive : require
// The tessellation factor of every edge record, as the control stages compute it.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "edge_factor.glsl"

layout(std430, set = 0, binding = BINDING_EDGE_FACTORS) writeonly buffer EdgeFactors { float edge_factors[]; };

void main() {
    uint edge = thread_index();
    if (edge < kernel.count) {
        edge_factors[edge] = edge_factor(edge);
    }
}
