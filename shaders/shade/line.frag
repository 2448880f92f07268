#version 460
#extension GL_GOOGLE_include_directive : require
// Lines of the cage overlay.
#include "frame.glsl"

layout(location = 0) out vec4 color;

void main() {
    color = frame.line_color;
}
