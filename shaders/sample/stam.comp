#version 460
#extension GL_GOOGLE_include_directive : require
// Points of exact patches on request.
#include "sample_stage.glsl"
#include "bases/stam.glsl"
#include "forms/stam.glsl"

void main() {
    write_sample();
}
