// Interface of the tessellation control stages that change the basis of a net: a stage includes this and its basis. Define POINTS_OUT, the vertices written,
// before the include, and
// REGULAR if nets are grids of 4 x 4 points.
#ifndef CONTROL_STAGE_GLSL
#define CONTROL_STAGE_GLSL
#include "patch_push.glsl"
#include "factors.glsl"
#include "bases/net.glsl"
#include "culling.glsl"

layout(vertices = POINTS_OUT) out;

layout(location = 0) in vec3 net_point[];
layout(location = 1) in flat uint net_patch[];

layout(location = 0) out vec3 control_point[];
layout(location = 1) patch out uint patch_id;

// Points of a net: one pipeline per valence fixes the length of the sums.
layout(constant_id = SPEC_NET_SIZE) const uint NET_SIZE = 16;

vec3 net_point_at(uint i) {
    return net_point[i];
}

uint cull_hull_size() {
    return NET_SIZE;
}

vec3 cull_hull_point(uint i) {
    return net_point[i];
}

float cull_overshoot() {
    return list.overshoot;
}

#ifdef REGULAR
#include "normal_cone.glsl"
#else
// Derivatives of the other forms are no sums of differences of the net.
bool cull_faces_away() {
    return false;
}
#endif

// Whether nothing of the patch can be seen.
bool cull_patch() {
    return cull_is_on() && (cull_hull_is_unseen() || ((frame.cull & CULL_BACK) != 0u && cull_faces_away()));
}

// Once per patch: its id and its factors.
void write_patch() {
    if (gl_InvocationID == 0) {
        uint id = net_patch[0];
        patch_id = id;
        if (cull_patch()) {
            discard_patch();
        } else {
            write_factors(id);
        }
    }
}

#endif
