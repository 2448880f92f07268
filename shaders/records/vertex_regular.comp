#version 460
#extension GL_GOOGLE_include_directive : require
// Vertex records of regular vertices: tensor products of (1 4 1)/6 and (-1 0 1)/2 on the 3x3 points around a corner of a regular net.
// Derivation: osculate_surface::gregory::vertex(Regular, corner). Twin: osculate_subdiv::twin::vertex_records.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "regular_sources.glsl"
#include "vertex_store.glsl"

// Net index of the corner.
const uint CENTRE[4] = uint[](5u, 6u, 10u, 9u);

void main() {
    uint record = thread_index();
    if (record >= kernel.count) {
        return;
    }
    uint patch_id = regular_source(record) >> 2u;
    uint centre = CENTRE[regular_source(record) & 3u];
    vec3 limit[3];
    vec3 slope[3];
    for (uint j = 0u; j < 3u; ++j) {
        uint at = centre - 4u + 4u * j;
        vec3 a = regular_net_point(patch_id, at - 1u);
        vec3 b = regular_net_point(patch_id, at);
        vec3 c = regular_net_point(patch_id, at + 1u);
        precise vec3 m = (a + c) * (1.0 / 6.0) + b * (2.0 / 3.0);
        precise vec3 d = (c - a) * 0.5;
        limit[j] = m;
        slope[j] = d;
    }
    precise vec3 position = (limit[0] + limit[2]) * (1.0 / 6.0) + limit[1] * (2.0 / 3.0);
    precise vec3 along_u = (slope[0] + slope[2]) * (1.0 / 6.0) + slope[1] * (2.0 / 3.0);
    precise vec3 along_v = (limit[2] - limit[0]) * 0.5;
    store_vertex(kernel.first + record, position, along_u, along_v);
}
