#version 460
#extension GL_GOOGLE_include_directive : require
// Vertices that the compute evaluator made, for the fragment stages of tessellated patches.
#include "frame.glsl"
#include "constants.glsl"

layout(std430, set = 0, binding = BINDING_GRID_VERTICES) readonly buffer GridVertices { uint grid_vertices[]; };

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_measure;
layout(location = 3) out flat uint out_patch;

vec3 load_vector(uint at) {
    return vec3(
        uintBitsToFloat(grid_vertices[at]), uintBitsToFloat(grid_vertices[at + 1u]), uintBitsToFloat(grid_vertices[at + 2u]));
}

void main() {
    uint at = GRID_VERTEX_WORDS * uint(gl_VertexIndex);
    vec3 position = load_vector(at);
    gl_Position = clip_position(position);
    out_normal = load_vector(at + 3u);
    if (shade_sees_position()) {
        out_position = position;
    }
    if (shade_sees_measure()) {
        out_measure = vec2(uintBitsToFloat(grid_vertices[at + 6u]), uintBitsToFloat(grid_vertices[at + 7u]));
    }
    if (shade_sees_patch()) {
        out_patch = grid_vertices[at + 8u];
    }
}
