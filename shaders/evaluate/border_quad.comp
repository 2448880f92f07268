#version 460
#extension GL_GOOGLE_include_directive : require
// Borders of quad patches with cubic sides.
#define CUBIC_SIDES
#include "border_stage.glsl"
#include "grids/quad.glsl"
#include "forms/bicubic.glsl"

void main() {
    write_border();
}
