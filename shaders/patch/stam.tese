#version 460
#extension GL_GOOGLE_include_directive : require
// Exact patches: the bicubic sub-patch that the point lies in, from eigenfunctions (report, section 4.2). One stage for all valences.
#include "evaluation_stage.glsl"
#include "forms/stam.glsl"

layout(location = 0) in vec3 control_point[];

vec3 control(uint i) {
    return control_point[i];
}

void main() {
    write_vertex();
}
