#version 460
#extension GL_GOOGLE_include_directive : require
// Gregory patches whose points lie in the coefficient buffer.
#include "evaluation_stage.glsl"
#include "forms/gregory.glsl"
#include "coefficients.glsl"

vec3 control(uint i) {
    return stored_vector(patch_basis(patch_id).net + i);
}

void main() {
    write_vertex();
}
