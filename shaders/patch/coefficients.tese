#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory patches whose points lie in the coefficient buffer.
#include "evaluation_stage.glsl"
#include "gregory.glsl"
#include "coefficients.glsl"

void main() {
    vec3 g[GREGORY_POINTS];
    load_coefficients(patches[patch_id].basis, g);
    vec3 b[16];
    gregory_bezier(g, gl_TessCoord.xy, b);
    write_vertex(b);
}
