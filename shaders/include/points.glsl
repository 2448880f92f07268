// The point buffer: all levels of the cage, then the phantom points; three floats each.
// Define POINTS_WRITABLE before the include in a kernel that computes points.
#ifndef POINTS_GLSL
#define POINTS_GLSL
#include "bindings.glsl"
#include "constants.glsl"

#ifdef POINTS_WRITABLE
layout(std430, set = 0, binding = BINDING_POINTS) buffer Points { float points[]; };

void store_point(uint index, vec3 p) {
    points[POINT_FLOATS * index] = p.x;
    points[POINT_FLOATS * index + 1] = p.y;
    points[POINT_FLOATS * index + 2] = p.z;
}
#else
layout(std430, set = 0, binding = BINDING_POINTS) readonly buffer Points { float points[]; };
#endif

vec3 load_point(uint index) {
    return vec3(points[POINT_FLOATS * index], points[POINT_FLOATS * index + 1], points[POINT_FLOATS * index + 2]);
}

#endif
