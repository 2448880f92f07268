#version 460
#extension GL_GOOGLE_include_directive : require
// Patches with continuous curvature about an inner vertex of valence n: 2n+8 net points to 64 Bezier points (report, section 4.3). A patch has at most 32
// vertices, so each carries two points: 2w and 2w+1, neighbours along u. All are relative to the net's first point, which goes along once.
#define POINTS_OUT 32
#include "constants.glsl"
#include "control_stage.glsl"
#include "bases/biseptic.glsl"

layout(location = 2) out vec3 second_point[];
layout(location = 3) patch out vec3 origin;

void main() {
    uint w = uint(gl_InvocationID);
    control_point[gl_InvocationID] = change_basis(2u * w, list.weights, NET_SIZE);
    second_point[gl_InvocationID] = change_basis(2u * w + 1u, list.weights, NET_SIZE);
    if (w == 0u) {
        origin = net_point_at(0u);
    }
    write_patch();
}
