#version 460
#extension GL_GOOGLE_include_directive : require
// Dots at the cage's vertices: two triangles each, of a size in pixels.
#include "frame.glsl"
#include "mark_push.glsl"
#include "points.glsl"

layout(location = 0) out vec2 out_place;

// How far dots are drawn towards the eye, as a part of their distance: clear of edges and surface.
const float TOWARDS_EYE = 0.006;

void main() {
    uint corner = uint(gl_VertexIndex) % 6u;
    out_place = vec2(corner == 1u || corner == 3u || corner == 4u ? 1.0 : -1.0, corner == 2u || corner >= 4u ? 1.0 : -1.0);
    vec3 p = load_point(uint(gl_VertexIndex) / 6u);
    gl_Position = clip_position(p + TOWARDS_EYE * (frame.eye.xyz - p));
    gl_Position.xy += out_place * (mark.size / frame.viewport) * gl_Position.w;
}
