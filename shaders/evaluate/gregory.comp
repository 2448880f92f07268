#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of Gregory patches.
#define CONTROL_POINTS GREGORY_POINTS
#include "constants.glsl"
#include "grid_stage.glsl"
#include "grids/quad.glsl"
#include "bases/gregory.glsl"
#include "forms/gregory.glsl"

uint control_count() {
    return GREGORY_POINTS;
}

void main() {
    write_patch();
}
