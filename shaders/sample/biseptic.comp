#version 460
#extension GL_GOOGLE_include_directive : require
// Points of biseptic patches on request.
#include "sample_stage.glsl"
#include "bases/biseptic.glsl"
#include "forms/biseptic.glsl"

vec3 control_origin() {
    return net_point_at(0u);
}

void main() {
    write_sample();
}
