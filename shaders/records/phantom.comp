#version 460
#extension GL_GOOGLE_include_directive : require
// Phantom points beyond the boundary: reflections 2 a - b, which make the net of a boundary patch regular and its boundary curve the cubic B-spline
// of the boundary points. Beyond a one-face corner the reflection of a reflection, 2 (2 a - b) - (2 c - d); a plain reflection repeats
// itself, (a, b, a, b), which is exact. Twin: osculate_subdiv::twin::phantom_points.
#define POINTS_WRITABLE
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "bindings.glsl"

layout(set = 0, binding = BINDING_QUADRUPLES) uniform usamplerBuffer reflections;

void main() {
    uint phantom = thread_index();
    if (phantom >= kernel.count) {
        return;
    }
    uvec4 r = texelFetch(reflections, int(phantom));
    precise vec3 first = 2.0 * load_point(r.x) - load_point(r.y);
    precise vec3 second = 2.0 * load_point(r.z) - load_point(r.w);
    precise vec3 point = 2.0 * first - second;
    store_point(kernel.first + phantom, point);
}
