#version 460
#extension GL_GOOGLE_include_directive : require
// New edge points: the average of four points, two old ends and two new face points; on the boundary the two ends, each twice.
// Face points of quads are averages of four too and run through this kernel (report, section 3.1). Twin: osculate_subdiv::twin::edge_points.
#define POINTS_WRITABLE
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "bindings.glsl"

layout(set = 0, binding = BINDING_QUADRUPLES) uniform usamplerBuffer quadruples;

void main() {
    uint edge = thread_index();
    if (edge >= kernel.count) {
        return;
    }
    uvec4 q = texelFetch(quadruples, int(edge));
    precise vec3 average = (((load_point(q.x) + load_point(q.y)) + load_point(q.z)) + load_point(q.w)) * 0.25;
    store_point(kernel.first + edge, average);
}
