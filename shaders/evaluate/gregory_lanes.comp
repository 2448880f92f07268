#version 460
#extension GL_GOOGLE_include_directive : require
// Insides of Gregory patches, one thread each.
#include "constants.glsl"
#include "lane_stage.glsl"
#include "grids/quad.glsl"
#include "points.glsl"
#include "nets.glsl"
#include "coefficients.glsl"
#include "forms/gregory.glsl"

vec3 own_control[GREGORY_POINTS];

vec3 control(uint i) {
    return own_control[i];
}

// All rows of bases/gregory.glsl at once: each point of the net is read once. The sums run in the same order.
void weigh_net(uint id) {
    uint net = patch_basis(id).net;
    uint size = patch_basis(id).net_size;
    uint basis = patch_basis(id).basis;
    for (uint row = 0u; row < GREGORY_POINTS; ++row) {
        own_control[row] = vec3(0.0);
    }
    for (uint i = size; i-- > 0u;) {
        vec3 p = load_point(net_index(net + i));
        for (uint row = 0u; row < GREGORY_POINTS; ++row) {
            precise vec3 sum = own_control[row] + weight_at(basis + row * size + i) * p;
            own_control[row] = sum;
        }
    }
}

void make_control_points(uint id) {
    if ((patch_basis(id).tag & TAG_STORED) == 0u) {
        weigh_net(id);
        return;
    }
    uint at = patch_basis(id).net;
    for (uint i = 0u; i < GREGORY_POINTS; ++i) {
        own_control[i] = stored_vector(at + i);
    }
}

void enter_column(uint id, float u) {
}

InnerPoint column_point(uint id, vec2 uv) {
    return inner_point(id, uv);
}

void main() {
    write_inside();
}
