#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Control points of quads and triangles with any corners, one thread per corner: p, e+, e-, f+, f-, gathered from the fans of the corners. Derivation:
// osculate_surface::gregory::{quad_points, triangle_points}. Twin: osculate_subdiv::twin::coefficients.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "fans.glsl"

struct GatheredPatch {
    // Fan of each corner.
    uint fan[4];
    // Number of the side from each corner to the next in the corner's fan.
    uint edge[4];
    // First vector of the control points in Coefficients.
    uint first;
    // 3 or 4.
    uint sides;
};

layout(std430, set = 0, binding = BINDING_SOURCES) readonly buffer Sources { GatheredPatch sources[]; };
layout(set = 0, binding = BINDING_COEFFICIENT_TEXELS) uniform samplerBuffer fan_vectors;
layout(scalar, set = 0, binding = BINDING_COEFFICIENTS) writeonly buffer Coefficients { vec3 coefficients[]; };

vec3 fan_vector(uint i) {
    return texelFetch(fan_vectors, int(i)).xyz;
}

void store_vector(uint i, vec3 v) {
    coefficients[i] = v;
}

// The side that leaves a corner for the next one.
FanSpoke plus_spoke(GatheredPatch source, uint corner) {
    return fan_spoke(source.fan[corner], source.edge[corner]);
}

// The side that leaves a corner for the previous one: the next edge around it.
FanSpoke minus_spoke(GatheredPatch source, uint corner) {
    uint fan = source.fan[corner];
    return fan_spoke(fan, (source.edge[corner] + 1u) % fans[fan].edges);
}

// The face point beside an edge, at its own end; `left` is 1 for the face on the left of the edge walked away from there, else -1.
vec3 face_point(FanSpoke own, FanSpoke other, float own_cosine, float other_cosine, float left, float degree) {
    precise vec3 along =
        other_cosine * (own.position - own.edge_point) + (2.0 * own_cosine) * (other.edge_point - own.edge_point);
    precise vec3 r = own.edge_point + (along + left * own.cross_inner) * degree;
    return r;
}

void main() {
    uint thread = thread_index();
    uint patch_index = thread >> 2u;
    uint corner = thread & 3u;
    if (patch_index >= kernel.count || corner >= sources[patch_index].sides) {
        return;
    }
    GatheredPatch source = sources[patch_index];
    uint next = (corner + 1u) % source.sides;
    uint previous = (corner + source.sides - 1u) % source.sides;
    float degree = source.sides == 3u ? 0.25 : 1.0 / 3.0;
    FanSpoke plus = plus_spoke(source, corner);
    FanSpoke minus = minus_spoke(source, corner);
    float cosine = fans[source.fan[corner]].cosine;
    uint at = source.first + 5u * corner;
    store_vector(at, plus.position);
    store_vector(at + 1u, plus.edge_point);
    store_vector(at + 2u, minus.edge_point);
    store_vector(at + 3u, face_point(plus, minus_spoke(source, next), cosine, fans[source.fan[next]].cosine, 1.0, degree));
    store_vector(at + 4u, face_point(minus, plus_spoke(source, previous), cosine, fans[source.fan[previous]].cosine, -1.0, degree));
}
