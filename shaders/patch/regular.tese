#version 460
#extension GL_GOOGLE_include_directive : require
// Regular patches: bicubic Bezier evaluation (report, section 4.1).
#include "evaluation_stage.glsl"

layout(location = 0) in vec3 control_point[];

void main() {
    vec3 b[16];
    for (int i = 0; i < 16; ++i) {
        b[i] = control_point[i];
    }
    write_vertex(b);
}
