#version 460
#extension GL_GOOGLE_include_directive : require
// Triangles: factors alone, their control points were computed before the draw.
#include "factors.glsl"
#include "stored_hull.glsl"

layout(vertices = 1) out;

layout(location = 1) patch out uint patch_id;

void main() {
    uint id = net_patch[0];
    patch_id = id;
    if (cull_patch()) {
        discard_patch();
    } else {
        write_triangle_factors(id);
    }
}
