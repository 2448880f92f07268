#version 460
#extension GL_GOOGLE_include_directive : require
// Exact patches whose coefficients lie in the coefficient buffer: at boundaries, of valence 2 and above 12.
#include "evaluation_stage.glsl"
#include "forms/stam.glsl"
#include "coefficients.glsl"

vec3 control(uint i) {
    return stored_vector(patch_basis(patch_id).net + i);
}

void main() {
    write_vertex();
}
