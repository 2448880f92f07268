#version 460
#extension GL_GOOGLE_include_directive : require
// Borders of Gregory triangles.
#define CUBIC_SIDES
#include "border_stage.glsl"
#include "grids/triangle.glsl"
#include "forms/triangle.glsl"

void main() {
    write_border();
}
