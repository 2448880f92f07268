// The unit square: corners (0,0), (1,0), (1,1), (0,1), side k from corner k to the next.
#ifndef DOMAINS_QUAD_GLSL
#define DOMAINS_QUAD_GLSL

// The side that (u,v) lies on, 0..3 as v=0, u=1, v=1, u=0, or 4 inside. Comparing with 0 and 1 is exact: the tessellator gives exactly these on outer edges.
uint side_of(vec2 uv) {
    return uv.y == 0.0 ? 0u : uv.x == 1.0 ? 1u : uv.y == 1.0 ? 2u : uv.x == 0.0 ? 3u : 4u;
}

// The corner at (u,v), or 4.
uint corner_of(vec2 uv) {
    bool corner = (uv.x == 0.0 || uv.x == 1.0) && (uv.y == 0.0 || uv.y == 1.0);
    return !corner ? 4u : uv.y == 0.0 ? (uv.x == 0.0 ? 0u : 1u) : (uv.x == 0.0 ? 3u : 2u);
}

// Edge record parameter at (u,v) on a side: u on sides 0 and 2, v on sides 1 and 3. Sides 2 and 3 are walked against it, the flip bit walks once more; 1 - x is
// exact for tessellation coordinates, and is taken at most once.
float edge_parameter(uint side, uint flip, vec2 uv) {
    float x = (side & 1u) == 0u ? uv.x : uv.y;
    precise float reversed = 1.0 - x;
    return ((side >> 1u) ^ flip) == 1u ? reversed : x;
}

// What the corners count for.
vec4 corner_weights(vec2 uv) {
    precise vec2 rest = 1.0 - uv;
    precise vec4 r = vec4(rest.x * rest.y, uv.x * rest.y, uv.x * uv.y, rest.x * uv.y);
    return r;
}

vec4 corner_weights_du(vec2 uv) {
    precise vec4 r = vec4(uv.y - 1.0, 1.0 - uv.y, uv.y, -uv.y);
    return r;
}

vec4 corner_weights_dv(vec2 uv) {
    precise vec4 r = vec4(uv.x - 1.0, -uv.x, uv.x, 1.0 - uv.x);
    return r;
}

// Reciprocals of the distances from the sides.
vec4 side_nearness(vec2 uv) {
    precise vec4 r = 1.0 / vec4(uv.y, 1.0 - uv.x, 1.0 - uv.y, uv.x);
    return r;
}

// Segments across, of both inner factors.
float shade_segments(vec2 inner) {
    return max(inner.x, inner.y);
}

// Coordinates that are 0 or 1 on the sides.
vec2 shade_outline(vec2 uv) {
    return uv;
}

#endif
