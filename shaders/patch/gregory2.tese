#version 460
#extension GL_GOOGLE_include_directive : require
// Extraordinary patches of the scheme gregory2: the rational blend, then bicubic Bezier evaluation (report, section 4.4). One stage for all valences.
#include "evaluation_stage.glsl"
#include "gregory.glsl"

layout(location = 0) in vec3 control_point[];

void main() {
    vec3 g[GREGORY_POINTS];
    for (int i = 0; i < GREGORY_POINTS; ++i) {
        g[i] = control_point[i];
    }
    vec3 b[16];
    gregory_bezier(g, gl_TessCoord.xy, b);
    write_vertex(b);
}
