#version 460
#extension GL_GOOGLE_include_directive : require
// Borders of exact patches, with their spokes.
#include "border_stage.glsl"
#include "grids/quad.glsl"
#include "forms/stam.glsl"

void main() {
    write_border();
}
