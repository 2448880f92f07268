#version 460
#extension GL_GOOGLE_include_directive : require
// Pulls the points of a patch list: vertex i of the draw is point i mod net_size of patch i / net_size. The patch id is carried from here
// because gl_PrimitiveID restarts within a draw on some drivers and between draws on all.
#include "constants.glsl"
#include "patch_push.glsl"
#include "points.glsl"
#include "nets.glsl"

layout(location = 0) out vec3 point;
layout(location = 1) out flat uint patch_id;

// Dividing by a constant is quick.
layout(constant_id = SPEC_NET_SIZE) const uint NET_SIZE = 16;

void main() {
    uint i = uint(gl_VertexIndex);
    patch_id = list.first_patch + i / NET_SIZE;
    point = load_point(net_index(list.net_offset + i));
}
