#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory points of patches whose net does not go through a patch list (valence 2, above 12, extraordinary at a boundary): one thread per
// point, a row of osculate_surface::gregory::gregory2 times the net. Twin: osculate_subdiv::twin::coefficients.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "sources.glsl"

layout(std430, set = 0, binding = BINDING_COEFFICIENTS) writeonly buffer Coefficients { float coefficients[]; };

void main() {
    uint thread = thread_index();
    uint record = thread / GREGORY_POINTS;
    uint row = thread % GREGORY_POINTS;
    if (record >= kernel.count) {
        return;
    }
    vec3 p = matrix_row(sources[record], row);
    uint at = 3u * (GREGORY_POINTS * (kernel.first + record) + row);
    coefficients[at] = p.x;
    coefficients[at + 1u] = p.y;
    coefficients[at + 2u] = p.z;
}
