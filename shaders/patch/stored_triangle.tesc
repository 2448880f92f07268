#version 460
#extension GL_GOOGLE_include_directive : require
// Triangles: factors alone, their control points were computed before the draw.
#include "factors.glsl"

layout(vertices = 1) out;

layout(location = 1) in flat uint net_patch[];

layout(location = 1) patch out uint patch_id;

void main() {
    uint id = net_patch[0];
    patch_id = id;
    write_triangle_factors(id);
}
