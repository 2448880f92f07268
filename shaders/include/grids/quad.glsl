// Grids on the unit square: rows of vertices along u.
#ifndef GRIDS_QUAD_GLSL
#define GRIDS_QUAD_GLSL
#include "grid.glsl"

uint side_count() {
    return 4u;
}

// A place on a side, `along` from its first corner, which is `back` from its second.
vec2 side_uv(uint side, float along, float back) {
    return side == 0u ? vec2(along, 0.0) : side == 1u ? vec2(1.0, along) : side == 2u ? vec2(back, 1.0) : vec2(0.0, back);
}

uint inner_count(GridPatch grid) {
    return (rate_segments(grid.inner_rate[0]) - 1u) * (rate_segments(grid.inner_rate[1]) - 1u);
}

vec2 inner_uv(GridPatch grid, uint i) {
    uint width = rate_segments(grid.inner_rate[0]) - 1u;
    return vec2(rate_parameter(grid.inner_rate[0], i % width + 1u), rate_parameter(grid.inner_rate[1], i / width + 1u));
}

#endif
