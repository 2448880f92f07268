#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory patches: the rational blend, then bicubic Bezier evaluation (report, section 4.4). One stage for all valences.
#include "evaluation_stage.glsl"
#include "forms/gregory.glsl"

layout(location = 0) in vec3 control_point[];

vec3 control(uint i) {
    return control_point[i];
}

void main() {
    write_vertex();
}
