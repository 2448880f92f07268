// Quartic Gregory triangles: 15 points, corner i has p, e+, e-, f+, f- at 5 i .. 5 i + 4; sides are cubics (Loop, Schaefer, Ni, Castano 2009; report, section 4.4).
// u and v are the barycentric coordinates of corners 1 and 2. Derivation and tests: osculate_surface::gregory::evaluate_triangle_frozen.
#ifndef FORMS_TRIANGLE_GLSL
#define FORMS_TRIANGLE_GLSL
#include "forms/form.glsl"
#include "domains/triangle.glsl"
#include "curvature.glsl"
#include "gregory_blend.glsl"

// Bezier point (j, k) of a triangle lies at 5 k + j: corner 0 at (0, 0), corner 1 at the largest j, corner 2 at the largest k.
#define TRIANGLE_GRID 25

// A point of the quartic next to the corner p of a cubic side.
vec3 beside_corner(vec3 p, vec3 e) {
    precise vec3 r = 0.25 * p + 0.75 * e;
    return r;
}

vec3 middle_of(vec3 a, vec3 b) {
    precise vec3 r = 0.5 * (a + b);
    return r;
}

// The quartic Bezier points that stand for the patch at (u,v), its sides raised by a degree. Differentiating them as constants is exact on all three sides.
void triangle_bezier(vec2 uv, out vec3 b[TRIANGLE_GRID]) {
    vec3 g[TRIANGLE_POINTS];
    for (uint i = 0u; i < TRIANGLE_POINTS; ++i) {
        g[i] = control(i);
    }
    float w = first_coordinate(uv);
    b[0] = g[0];
    b[1] = beside_corner(g[0], g[1]);
    b[2] = middle_of(g[1], g[7]);
    b[3] = beside_corner(g[5], g[7]);
    b[4] = g[5];
    b[5] = beside_corner(g[0], g[2]);
    b[6] = gregory_blend(g[3], g[4], uv.x, uv.y);
    b[7] = gregory_blend(g[8], g[9], uv.y, w);
    b[8] = beside_corner(g[5], g[6]);
    b[10] = middle_of(g[2], g[11]);
    b[11] = gregory_blend(g[13], g[14], w, uv.x);
    b[12] = middle_of(g[6], g[12]);
    b[15] = beside_corner(g[10], g[11]);
    b[16] = beside_corner(g[10], g[12]);
    b[20] = g[10];
}

// One step of de Casteljau's algorithm: from the Bezier points of `degree` + 1 to those of `degree`.
void triangle_step(inout vec3 b[TRIANGLE_GRID], vec2 uv, int degree) {
    float w = first_coordinate(uv);
    for (int k = 0; k <= degree; ++k) {
        for (int j = 0; j <= degree - k; ++j) {
            int at = 5 * k + j;
            precise vec3 r = (w * b[at] + uv.x * b[at + 1]) + uv.y * b[at + 5];
            b[at] = r;
        }
    }
}

InnerPoint inner_point(uint id, vec2 uv) {
    vec3 b[TRIANGLE_GRID];
    triangle_bezier(uv, b);
    triangle_step(b, uv, 3);
    triangle_step(b, uv, 2);
    triangle_step(b, uv, 1);
    precise InnerPoint r;
    r.du = 4.0 * (b[1] - b[0]);
    r.dv = 4.0 * (b[5] - b[0]);
    triangle_step(b, uv, 0);
    r.position = b[0];
    r.plane = cross_product(r.du, r.dv);
    return r;
}

vec2 shade_curvature(uint id, vec2 uv) {
    vec3 b[TRIANGLE_GRID];
    triangle_bezier(uv, b);
    triangle_step(b, uv, 3);
    triangle_step(b, uv, 2);
    vec3 duu = 12.0 * ((b[2] - b[1]) - (b[1] - b[0]));
    vec3 duv = 12.0 * ((b[6] - b[1]) - (b[5] - b[0]));
    vec3 dvv = 12.0 * ((b[10] - b[5]) - (b[5] - b[0]));
    triangle_step(b, uv, 1);
    return shade_curvature_of(4.0 * (b[1] - b[0]), 4.0 * (b[5] - b[0]), duu, duv, dvv);
}

SurfacePoint side_point(uint id, uint side, vec2 uv) {
    return cubic_side_point(id, side, uv);
}

#endif
