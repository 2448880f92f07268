#version 460
#extension GL_GOOGLE_include_directive : require
// Points of Gregory patches on request.
#include "sample_stage.glsl"
#include "bases/gregory.glsl"
#include "forms/gregory.glsl"

void main() {
    write_sample();
}
