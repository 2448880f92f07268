#version 460
#extension GL_GOOGLE_include_directive : require
// Regular patches: uniform bicubic B-spline net to Bezier net by the two 4x4 products of the report, section 4.1; one point per invocation.
#define POINTS_OUT 16
#include "control_stage.glsl"
#include "regular_basis.glsl"

void main() {
    vec3 net[16];
    for (int i = 0; i < 16; ++i) {
        net[i] = net_point[i];
    }
    control_point[gl_InvocationID] = regular_bezier_point(net, uint(gl_InvocationID));
    write_patch();
}
