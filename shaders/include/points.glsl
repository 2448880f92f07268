// The point buffer: all levels of the cage, then the phantom points; three floats each.
// Define POINTS_WRITABLE before the include in a kernel that computes points.
#ifndef POINTS_GLSL
#define POINTS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "bindings.glsl"

layout(set = 0, binding = BINDING_POINT_TEXELS) uniform samplerBuffer point_texels;

vec3 load_point(uint index) {
    return texelFetch(point_texels, int(index)).xyz;
}

#ifdef POINTS_WRITABLE
layout(scalar, set = 0, binding = BINDING_POINTS) writeonly buffer Points { vec3 points[]; };

void store_point(uint index, vec3 p) {
    points[index] = p;
}
#endif

#endif
