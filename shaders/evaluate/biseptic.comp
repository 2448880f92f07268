#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of patches with continuous curvature.
#define CONTROL_POINTS 64
#include "constants.glsl"
#include "grid_stage.glsl"
#include "grids/quad.glsl"
#include "bases/biseptic.glsl"
#include "forms/biseptic.glsl"

uint control_count() {
    return 64u;
}

vec3 control_origin() {
    return net_point_at(0u);
}

void main() {
    write_patch();
}
