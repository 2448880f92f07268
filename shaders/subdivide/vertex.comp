#version 460
#extension GL_GOOGLE_include_directive : require
// New vertex points: (n-2)/n V + P/n + Q/n; n = 1 marks a boundary vertex (1:6:1 with its two boundary neighbours), n = 0 a corner that stays
// (report, section 3.1, row V of Figure 2). With OLD_IN_ROW rows end with V: not all new points are there, so its distance varies. Twin: osculate_subdiv::twin::vertex_points.
#define POINTS_WRITABLE
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "tables.glsl"

vec3 smooth_vertex(vec3 old, uvec2 span) {
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 2u * span.y; ++i) {
        sum = sum + load_point(index_at(span.x + i));
    }
    precise float n = float(span.y);
    precise vec3 r = old * ((n - 2.0) / n) + sum / (n * n);
    return r;
}

vec3 boundary_vertex(vec3 old, uvec2 span) {
    precise vec3 r = ((load_point(index_at(span.x)) + load_point(index_at(span.x + 1u))) + 6.0 * old) * 0.125;
    return r;
}

void main() {
    uint vertex = thread_index();
    if (vertex >= kernel.count) {
        return;
    }
    uint target = kernel.first + vertex;
    uvec2 span = span_of(vertex);
#ifdef OLD_IN_ROW
    vec3 old = load_point(index_at(span.x + 2u * span.y));
#else
    vec3 old = load_point(target - kernel.old_distance);
#endif
    store_point(target, span.y > 1u ? smooth_vertex(old, span) : span.y == 1u ? boundary_vertex(old, span) : old);
}
