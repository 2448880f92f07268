#version 460
#extension GL_GOOGLE_include_directive : require
// Regular patches: bicubic Bezier evaluation (report, section 4.1).
#include "evaluation_stage.glsl"
#include "forms/bicubic.glsl"

layout(location = 0) in vec3 control_point[];

vec3 control(uint i) {
    return control_point[i];
}

void main() {
    write_vertex();
}
