#version 460
#extension GL_GOOGLE_include_directive : require
// Regular patches: uniform bicubic B-spline net to Bezier net (report, section 4.1), one point per invocation.
#define POINTS_OUT 16
#define REGULAR
#include "constants.glsl"
#include "control_stage.glsl"
#include "bases/bicubic.glsl"

void main() {
    control_point[gl_InvocationID] = change_basis(uint(gl_InvocationID), list.weights, NET_SIZE);
    write_patch();
}
