#version 460
#extension GL_GOOGLE_include_directive : require
// Edge records between patches with any corners, one thread each: gathered from the fans of both ends. Derivation: osculate_surface::gregory::edge_record. Twin:
// osculate_subdiv::twin::edge_records.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "coefficients.glsl"
#include "fans.glsl"
#include "edge_store.glsl"

struct GatheredEdge {
    // Fans of start and end.
    uint fan[2];
    // Number of the edge in these fans.
    uint edge[2];
};

layout(std430, set = 0, binding = BINDING_SOURCES) readonly buffer Sources { GatheredEdge sources[]; };

vec3 fan_vector(uint i) {
    return stored_vector(i);
}

// The cross derivative d of the edge with the curve c, where an end is flat: see osculate_surface::gregory::CrossEnd.
void settle_ends(uint start, uint end, vec3 c[4], inout vec3 d[4]) {
    precise vec3 r[4] = d;
    if (start == CROSS_END_OPPOSED) {
        r[1] = r[1] + 2.0 * (c[2] - c[1]);
        r[2] = r[2] + (c[3] - c[2]);
    }
    if (end == CROSS_END_OPPOSED) {
        r[1] = r[1] + (c[0] - c[1]);
        r[2] = r[2] + 2.0 * (c[1] - c[2]);
    }
    if (start != CROSS_END_PLAIN) {
        r[0] = 3.0 * r[1];
        r[1] = r[1] + r[2];
        r[2] = r[2] + r[3] * (1.0 / 3.0);
    }
    if (end != CROSS_END_PLAIN) {
        r[3] = 3.0 * r[2];
        r[2] = r[2] + r[1];
        r[1] = r[1] + r[0] * (1.0 / 3.0);
    }
    d = r;
}

void main() {
    uint record = thread_index();
    if (record >= kernel.count) {
        return;
    }
    GatheredEdge source = sources[record];
    FanSpoke a = fan_spoke(source.fan[0], source.edge[0]);
    FanSpoke b = fan_spoke(source.fan[1], source.edge[1]);
    vec3 c[4] = vec3[](a.position, a.edge_point, b.edge_point, b.position);
    precise vec3 d[4] = vec3[](a.cross_end, a.cross_inner, -b.cross_inner, -b.cross_end);
    settle_ends(fans[source.fan[0]].cross_end, fans[source.fan[1]].cross_end, c, d);
    for (uint i = 0u; i < 4u; ++i) {
        store_edge_point(kernel.first + record, i, c[i]);
        store_edge_point(kernel.first + record, 4u + i, d[i]);
    }
}
