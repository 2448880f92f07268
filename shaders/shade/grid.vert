#version 460
#extension GL_GOOGLE_include_directive : require
// Vertices that the compute evaluator made, for the fragment stages of tessellated patches. Without SEES_PATCH they hold nothing but position and normal.
#include "frame.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;

layout(location = 1) out vec3 out_normal;
#ifdef SEES_POSITION
layout(location = 0) out vec3 out_position;
#endif
#ifdef SEES_PATCH
layout(location = 2) in vec2 in_measure;
layout(location = 3) in uint in_patch;

layout(location = 2) out vec2 out_measure;
layout(location = 3) out flat uint out_patch;
#endif

void main() {
    gl_Position = clip_position(in_position);
    out_normal = shade_direction(in_normal);
#ifdef SEES_POSITION
    out_position = shade_place(in_position);
#endif
#ifdef SEES_PATCH
    out_measure = in_measure;
    out_patch = in_patch;
#endif
}
