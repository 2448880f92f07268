#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of bicubic patches.
#define CONTROL_POINTS 16
#include "constants.glsl"
#include "grid_stage.glsl"
#include "grids/quad.glsl"
#include "bases/bicubic.glsl"
#include "forms/bicubic.glsl"

uint control_count() {
    return 16u;
}

void main() {
    write_patch();
}
