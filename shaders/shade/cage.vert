#version 460
#extension GL_GOOGLE_include_directive : require
// Edges of the control cage: two vertices per edge, pulled from the point buffer.
#include "frame.glsl"
#include "points.glsl"

layout(set = 0, binding = BINDING_INDICES) uniform usamplerBuffer ends;

// How far lines are drawn towards the eye, as a part of their distance: they stay where they are in the picture, and clear of a surface that they lie on.
const float TOWARDS_EYE = 0.003;

void main() {
    vec3 p = load_point(texelFetch(ends, gl_VertexIndex).x);
    gl_Position = clip_position(p + TOWARDS_EYE * (frame.eye.xyz - p));
}
