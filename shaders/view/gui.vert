#version 460
#extension GL_GOOGLE_include_directive : require
// Triangles of the interface, pulled from egui's vertices: position in points, texture coordinates, colour.
#include "bindings.glsl"
#include "gui_push.glsl"

layout(std430, set = 0, binding = BINDING_GUI_VERTICES) readonly buffer GuiVertices { uint gui_vertices[]; };

layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

const uint VERTEX_WORDS = 5u;

vec2 load_pair(uint at) {
    return vec2(uintBitsToFloat(gui_vertices[at]), uintBitsToFloat(gui_vertices[at + 1u]));
}

void main() {
    uint at = VERTEX_WORDS * uint(gl_VertexIndex);
    out_uv = load_pair(at + 2u);
    out_color = unpackUnorm4x8(gui_vertices[at + 4u]);
    gl_Position = vec4(2.0 * load_pair(at) / gui.size - 1.0, 0.0, 1.0);
}
