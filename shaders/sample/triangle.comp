#version 460
#extension GL_GOOGLE_include_directive : require
// Points of Gregory triangles on request.
#include "sample_stage.glsl"
#include "forms/triangle.glsl"

// Triangles are always stored.
vec3 change_basis(uint point, uint basis, uint net_size) {
    return stored_vector(patch_basis(sampled_patch).net + point);
}

void main() {
    write_sample();
}
