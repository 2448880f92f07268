#version 460
#extension GL_GOOGLE_include_directive : require
// Marks of one colour.
#include "mark_push.glsl"

layout(location = 0) out vec4 color;

void main() {
    color = mark.color;
}
