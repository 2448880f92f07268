#version 460
#extension GL_GOOGLE_include_directive : require
// Borders of patches with continuous curvature, with their spokes.
#include "border_stage.glsl"
#include "grids/quad.glsl"
#include "forms/biseptic.glsl"

vec3 control_origin() {
    return vec3(0.0);
}

void main() {
    write_border();
}
