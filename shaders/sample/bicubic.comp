#version 460
#extension GL_GOOGLE_include_directive : require
// Points of bicubic patches on request.
#include "sample_stage.glsl"
#include "bases/bicubic.glsl"
#include "forms/bicubic.glsl"

void main() {
    write_sample();
}
