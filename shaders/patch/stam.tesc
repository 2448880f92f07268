#version 460
#extension GL_GOOGLE_include_directive : require
// Exact patches about an inner vertex of valence n: 2n+8 net points to as many coefficients of eigenfunctions (report, section 4.2), one row per
// invocation. POINTS_OUT comes with the variant: as many as the net has points.
#include "constants.glsl"
#include "control_stage.glsl"
#include "bases/stam.glsl"

void main() {
    control_point[gl_InvocationID] = change_basis(uint(gl_InvocationID), list.weights, NET_SIZE);
    write_patch();
}
