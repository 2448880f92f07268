// Net of 2n+8 points to 64 Bezier points of bidegree 7, less V: rows of osculate_surface::biseptic::patch (report, section 4.3).
#ifndef BASES_BISEPTIC_GLSL
#define BASES_BISEPTIC_GLSL
#include "bases/net.glsl"

vec3 change_basis(uint point, uint basis, uint net_size) {
    return weighted_differences(basis + point * net_size, net_size);
}

#endif
