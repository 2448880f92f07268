#version 460
#extension GL_GOOGLE_include_directive : require
// Normals of the surface at the corners of its patches: a line each.
#include "frame.glsl"
#include "mark_push.glsl"
#include "records.glsl"

void main() {
    SurfacePoint at = vertex_record_point(uint(gl_VertexIndex) / 2u);
    gl_Position = clip_position(at.position + (gl_VertexIndex % 2 == 1 ? mark.size : 0.0) * at.normal);
}
