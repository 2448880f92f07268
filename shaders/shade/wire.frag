#version 460
#extension GL_GOOGLE_include_directive : require
// Edges of the triangles. They fade where triangles are small in the picture, lest a fine tessellation become a black shape.
#include "frame.glsl"

// Width of the triangles in pixels; the second number is unused.
layout(location = 2) in vec2 width;

layout(location = 0) out vec4 color;

void main() {
    float visible = smoothstep(0.8, 6.0, width.x);
    // Both triangles of an edge draw it: two layers of this opacity make one of the colour's.
    float layer = 1.0 - sqrt(1.0 - frame.line_color.a * visible);
    color = vec4(frame.line_color.rgb, layer);
}
