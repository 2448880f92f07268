#version 460
#extension GL_GOOGLE_include_directive : require
// Insides of bicubic patches, one thread each.
#include "constants.glsl"
#include "lane_stage.glsl"
#include "grids/quad.glsl"
#include "points.glsl"
#include "nets.glsl"
#include "bezier.glsl"
#include "forms/bicubic.glsl"

vec3 own_control[16];
BicubicColumn own_column;

vec3 control(uint i) {
    return own_control[i];
}

// The two products of bases/bicubic.glsl, one after the other.
void make_control_points(uint id) {
    uint net = patch_basis(id).net;
    vec3 row[16];
    for (uint b = 0u; b < 4u; ++b) {
        vec3 p[4];
        for (uint i = 0u; i < 4u; ++i) {
            p[i] = load_point(net_index(net + 4u * b + i));
        }
        for (uint i = 0u; i < 4u; ++i) {
            row[4u * b + i] = bspline_to_bezier(i, p[0], p[1], p[2], p[3]);
        }
    }
    for (uint j = 0u; j < 4u; ++j) {
        for (uint i = 0u; i < 4u; ++i) {
            own_control[4u * j + i] = bspline_to_bezier(j, row[i], row[4u + i], row[8u + i], row[12u + i]);
        }
    }
}

void enter_column(uint id, float u) {
    own_column = bicubic_column(own_control, u);
}

InnerPoint column_point(uint id, vec2 uv) {
    PatchPoint p = bicubic_column_point(own_column, uv.y);
    return InnerPoint(p.position, p.du, p.dv, cross_product(p.du, p.dv));
}

void main() {
    write_inside();
}
