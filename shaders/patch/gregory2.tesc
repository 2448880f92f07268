#version 460
#extension GL_GOOGLE_include_directive : require
// Extraordinary patches of the scheme gregory2: 2n+8 net points to 20 Gregory points, one row of osculate_surface::gregory::gregory2 per invocation,
// summed as in sources.glsl (report, section 4.4). One pipeline per valence n, which fixes the length of the sum.
#define POINTS_OUT GREGORY_POINTS
#include "constants.glsl"
#include "control_stage.glsl"
#include "nets.glsl"

layout(constant_id = SPEC_NET_SIZE) const uint NET_SIZE = 14;

void main() {
    uint row = list.weights + uint(gl_InvocationID) * NET_SIZE;
    precise vec3 sum = vec3(0.0);
    for (uint i = NET_SIZE; i-- > 0u;) {
        sum = sum + weights[row + i] * net_point[i];
    }
    control_point[gl_InvocationID] = sum;
    write_patch();
}
