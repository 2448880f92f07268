// Uniform bicubic B-spline net to bicubic Bezier net.
#ifndef REGULAR_BASIS_GLSL
#define REGULAR_BASIS_GLSL
#include "bezier.glsl"

// Bezier point i + 4 j of the patch of a 16-point net.
vec3 regular_bezier_point(vec3 net[16], uint point) {
    uint i = point & 3u;
    uint j = point >> 2u;
    vec3 row[4];
    for (int b = 0; b < 4; ++b) {
        row[b] = bspline_to_bezier(i, net[4 * b], net[4 * b + 1], net[4 * b + 2], net[4 * b + 3]);
    }
    return bspline_to_bezier(j, row[0], row[1], row[2], row[3]);
}

#endif
