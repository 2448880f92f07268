// Uniform bicubic B-spline net to bicubic Bezier net: the two 4x4 products of the report, section 4.1.
#ifndef BASES_BICUBIC_GLSL
#define BASES_BICUBIC_GLSL
#include "bases/net.glsl"
#include "bezier.glsl"

// Bezier point i + 4 j of the patch of a 16-point net.
vec3 change_basis(uint point, uint basis, uint net_size) {
    uint i = point & 3u;
    uint j = point >> 2u;
    vec3 row[4];
    for (uint b = 0u; b < 4u; ++b) {
        row[b] = bspline_to_bezier(
            i, net_point_at(4u * b), net_point_at(4u * b + 1u), net_point_at(4u * b + 2u), net_point_at(4u * b + 3u));
    }
    return bspline_to_bezier(j, row[0], row[1], row[2], row[3]);
}

#endif
