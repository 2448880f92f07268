// The triangle with barycentric coordinates (w, u, v) of corners 0, 1, 2; side k runs from corner k to the next.
#ifndef DOMAINS_TRIANGLE_GLSL
#define DOMAINS_TRIANGLE_GLSL

// The coordinate of corner 0. On the side opposite it tessellation coordinates are (x, 1 - x), and this is exactly 0.
float first_coordinate(vec2 uv) {
    precise float w = (1.0 - uv.x) - uv.y;
    return w;
}

// The side that (u,v) lies on, 0..2 as v=0, w=0, u=0, or 4 inside.
uint side_of(vec2 uv) {
    return uv.y == 0.0 ? 0u : first_coordinate(uv) == 0.0 ? 1u : uv.x == 0.0 ? 2u : 4u;
}

// The corner at (u,v), or 4.
uint corner_of(vec2 uv) {
    return uv.y == 0.0 ? (uv.x == 0.0 ? 0u : uv.x == 1.0 ? 1u : 4u) : (uv.x == 0.0 && uv.y == 1.0 ? 2u : 4u);
}

// Edge record parameter at (u,v) on a side: the coordinate of the corner that the record runs to. For corner 0 it is 1 less that of the other end, which is exact
// for tessellation coordinates.
float edge_parameter(uint side, uint flip, vec2 uv) {
    uint end = (side + 1u - flip) % 3u;
    precise float other = 1.0 - (side == 0u ? uv.x : uv.y);
    return end == 0u ? other : end == 1u ? uv.x : uv.y;
}

// What the corners count for; the fourth is not there.
vec4 corner_weights(vec2 uv) {
    return vec4(first_coordinate(uv), uv, 0.0);
}

vec4 corner_weights_du(vec2 uv) {
    return vec4(-1.0, 1.0, 0.0, 0.0);
}

vec4 corner_weights_dv(vec2 uv) {
    return vec4(-1.0, 0.0, 1.0, 0.0);
}

// Reciprocals of the distances from the sides, measured by the coordinates that are 0 there.
vec4 side_nearness(vec2 uv) {
    precise vec3 r = 1.0 / vec3(uv.y, first_coordinate(uv), uv.x);
    return vec4(r, 0.0);
}

// Segments across, of the inner factors: there is one.
float shade_segments(vec2 inner) {
    return inner.x;
}

// Coordinates that are 0 on the sides.
vec2 shade_outline(vec2 uv) {
    return vec2(min(min(uv.x, uv.y), first_coordinate(uv)));
}

#endif
