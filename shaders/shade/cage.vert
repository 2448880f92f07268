#version 460
#extension GL_GOOGLE_include_directive : require
// Edges of the control cage: two vertices per edge, pulled from the point buffer.
#include "frame.glsl"
#include "points.glsl"

layout(std430, set = 0, binding = BINDING_INDICES) readonly buffer Indices { uint ends[]; };

void main() {
    gl_Position = clip_position(load_point(ends[gl_VertexIndex]));
}
