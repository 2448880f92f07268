// Interface of the tessellation control stages that change the basis of a net: a stage includes this and its basis. Define POINTS_OUT, the vertices written,
// before the include.
#ifndef CONTROL_STAGE_GLSL
#define CONTROL_STAGE_GLSL
#include "patch_push.glsl"
#include "factors.glsl"
#include "bases/net.glsl"

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

// Once per patch: its id and its factors.
void write_patch() {
    if (gl_InvocationID == 0) {
        uint id = net_patch[0];
        patch_id = id;
        write_factors(id);
    }
}

#endif
