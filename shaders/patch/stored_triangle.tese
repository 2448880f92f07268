#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory triangles, whose points lie in the coefficient buffer. gl_TessCoord is (u, v, w) of corners 1, 2, 0.
#define DOMAIN triangles
#include "evaluation_stage.glsl"
#include "forms/triangle.glsl"
#include "coefficients.glsl"

vec3 control(uint i) {
    return stored_vector(patch_basis(patch_id).net + i);
}

void main() {
    write_vertex();
}
