// Net of K points to K coefficients in the eigenbasis of subdivision: rows of osculate_surface::stam::Patch::projection times the points less V; the first
// is the limit position of V (report, section 4.2).
#ifndef BASES_STAM_GLSL
#define BASES_STAM_GLSL
#include "bases/net.glsl"

vec3 change_basis(uint mode, uint basis, uint net_size) {
    precise vec3 r = projected_differences(basis + mode * net_size, net_size);
    precise vec3 limit = net_point_at(0u) + r;
    return mode == 0u ? limit : r;
}

#endif
