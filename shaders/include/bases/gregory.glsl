// Net of 2n+8 points to 20 Gregory points: rows of osculate_surface::gregory::gregory2 (report, section 4.4).
#ifndef BASES_GREGORY_GLSL
#define BASES_GREGORY_GLSL
#include "bases/net.glsl"

vec3 change_basis(uint point, uint basis, uint net_size) {
    return weighted_row(basis + point * net_size, net_size);
}

#endif
