#version 460
#extension GL_GOOGLE_include_directive : require
// New face points: the average of the face's points (report, section 3.1, row F of Figure 2). Twin: osculate_subdiv::twin::face_points.
#define POINTS_WRITABLE
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "tables.glsl"

void main() {
    uint face = thread_index();
    if (face >= kernel.count) {
        return;
    }
    uvec2 span = span_of(face);
    precise vec3 sum = load_point(index_at(span.x));
    for (uint i = 1u; i < span.y; ++i) {
        sum = sum + load_point(index_at(span.x + i));
    }
    precise vec3 average = sum / float(span.y);
    store_point(kernel.first + face, average);
}
