// Grids on a triangle: rows of vertices along u, each shorter than the one before, with equal distances whatever the spacing of the sides.
#ifndef GRIDS_TRIANGLE_GLSL
#define GRIDS_TRIANGLE_GLSL
#include "grid.glsl"

uint side_count() {
    return 3u;
}

// A place on a side, `along` from its first corner, which is `back` from its second.
vec2 side_uv(uint side, float along, float back) {
    return side == 0u ? vec2(along, 0.0) : side == 1u ? vec2(back, along) : vec2(0.0, back);
}

uint inner_count(GridPatch grid) {
    uint n = rate_segments(grid.inner_rate[0]);
    return n < 3u ? 0u : (n - 1u) * (n - 2u) / 2u;
}

vec2 inner_uv(GridPatch grid, uint i) {
    uint n = rate_segments(grid.inner_rate[0]);
    uint row = 1u;
    while (i >= n - 1u - row) {
        i -= n - 1u - row;
        ++row;
    }
    precise vec2 uv = vec2(float(i + 1u), float(row)) / float(n);
    return uv;
}

#endif
