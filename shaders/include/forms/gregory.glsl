// Bicubic Gregory patches: 20 points, corner i has p, e+, e-, f+, f- at 5 i .. 5 i + 4 (Loop, Schaefer, Ni, Castano 2009; report, section 4.4).
// Derivation and tests: osculate_surface::gregory.
#ifndef FORMS_GREGORY_GLSL
#define FORMS_GREGORY_GLSL
#include "forms/form.glsl"
#include "domains/quad.glsl"
#include "curvature.glsl"
#include "gregory_blend.glsl"

// The bicubic Bezier points that stand for the Gregory patch at (u,v). Differentiating them as constants is exact on all four edges.
void gregory_bezier(vec2 uv, out vec3 b[16]) {
    vec3 g[GREGORY_POINTS];
    for (uint i = 0u; i < GREGORY_POINTS; ++i) {
        g[i] = control(i);
    }
    float u = uv.x;
    float v = uv.y;
    precise float u1 = 1.0 - u;
    precise float v1 = 1.0 - v;
    b[0] = g[0];
    b[1] = g[1];
    b[2] = g[7];
    b[3] = g[5];
    b[4] = g[2];
    b[5] = gregory_blend(g[3], g[4], u, v);
    b[6] = gregory_blend(g[8], g[9], v, u1);
    b[7] = g[6];
    b[8] = g[16];
    b[9] = gregory_blend(g[18], g[19], v1, u);
    b[10] = gregory_blend(g[13], g[14], u1, v1);
    b[11] = g[12];
    b[12] = g[15];
    b[13] = g[17];
    b[14] = g[11];
    b[15] = g[10];
}

InnerPoint inner_point(uint id, vec2 uv) {
    vec3 b[16];
    gregory_bezier(uv, b);
    PatchPoint p = bicubic_point(b, uv);
    return InnerPoint(p.position, p.du, p.dv, cross_product(p.du, p.dv));
}

vec2 shade_curvature(uint id, vec2 uv) {
    vec3 b[16];
    gregory_bezier(uv, b);
    return shade_bicubic_curvature(b, uv);
}

SurfacePoint side_point(uint id, uint side, vec2 uv) {
    return cubic_side_point(id, side, uv);
}

#endif
