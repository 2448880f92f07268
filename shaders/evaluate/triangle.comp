#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of Gregory triangles, which are always stored: nothing is made here.
#define CONTROL_POINTS 1
#include "grid_stage.glsl"
#include "grids/triangle.glsl"
#include "forms/triangle.glsl"

uint control_count() {
    return 0u;
}

vec3 change_basis(uint point, uint basis, uint net_size) {
    return stored_vector(patch_basis(grid.patch_id).net + point);
}

void main() {
    write_patch();
}
