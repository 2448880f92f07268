#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory patches about an inner vertex of valence n: 2n+8 net points to 20 Gregory points (report, section 4.4), one row per invocation.
#define POINTS_OUT GREGORY_POINTS
#include "constants.glsl"
#include "control_stage.glsl"
#include "bases/gregory.glsl"

void main() {
    control_point[gl_InvocationID] = change_basis(uint(gl_InvocationID), list.weights, NET_SIZE);
    write_patch();
}
