#version 460
#extension GL_GOOGLE_include_directive : require
// Grids of bicubic patches.
#define CONTROL_POINTS 16
#define CONTROL_FROM_STAGE
#include "constants.glsl"
#include "grid_stage.glsl"
#include "grids/quad.glsl"
#include "bezier.glsl"
#include "forms/bicubic.glsl"

shared vec3 shared_rows[16];

// The two products of bases/bicubic.glsl, one after the other: a thread reads four points of the net where one that made a control point alone would read all
// sixteen. The sums are the same.
void make_control_points() {
    for (uint t = gl_LocalInvocationIndex; t < 16u; t += gl_WorkGroupSize.x) {
        uint first = t & ~3u;
        shared_rows[t] = bspline_to_bezier(
            t & 3u, net_point_at(first), net_point_at(first + 1u), net_point_at(first + 2u), net_point_at(first + 3u));
    }
    barrier();
    for (uint t = gl_LocalInvocationIndex; t < 16u; t += gl_WorkGroupSize.x) {
        uint i = t & 3u;
        shared_control[t] = bspline_to_bezier(t >> 2u, shared_rows[i], shared_rows[4u + i], shared_rows[8u + i], shared_rows[12u + i]);
    }
    barrier();
}

void main() {
    write_patch();
}
