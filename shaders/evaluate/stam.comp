#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of exact patches. Those whose nets have more than 32 points are stored.
#define CONTROL_POINTS 32
#include "constants.glsl"
#include "grid_stage.glsl"
#include "grids/quad.glsl"
#include "bases/stam.glsl"
#include "forms/stam.glsl"

uint control_count() {
    return patch_basis(grid.patch_id).net_size;
}

void main() {
    write_patch();
}
