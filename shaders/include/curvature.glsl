// Curvature of a bicubic patch from its first and second derivatives.
#ifndef CURVATURE_GLSL
#define CURVATURE_GLSL
#include "bezier.glsl"
#include "vector.glsl"

float shade_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// (mean, Gaussian) curvature at (u,v); zero where the patch has no tangent plane. For shading alone: no bits are promised.
vec2 shade_curvature_at(vec3 b[16], vec2 uv) {
    PatchPoint p = bicubic_point(b, uv);
    vec4 bu = bernstein3(uv.x);
    vec4 bv = bernstein3(uv.y);
    vec3 qu = bernstein2(uv.x);
    vec3 row[4];
    vec3 slope[4];
    vec3 bend[4];
    for (int j = 0; j < 4; ++j) {
        row[j] = combine4(bu, b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]);
        slope[j] = combine_differences(qu, b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]);
        bend[j] = combine_second_differences(uv.x, b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]);
    }
    precise vec3 duu = 6.0 * combine4(bv, bend[0], bend[1], bend[2], bend[3]);
    precise vec3 duv = 9.0 * combine_differences(bernstein2(uv.y), slope[0], slope[1], slope[2], slope[3]);
    precise vec3 dvv = 6.0 * combine_second_differences(uv.y, row[0], row[1], row[2], row[3]);
    vec3 n = unit_or_zero(cross_product(p.du, p.dv));
    float e = shade_dot(p.du, p.du);
    float f = shade_dot(p.du, p.dv);
    float g = shade_dot(p.dv, p.dv);
    float l = shade_dot(duu, n);
    float m = shade_dot(duv, n);
    float k = shade_dot(dvv, n);
    precise float area = e * g - f * f;
    precise vec2 r = vec2((e * k - 2.0 * (f * m)) + g * l, l * k - m * m) / vec2(2.0 * area, area);
    return area > 0.0 ? r : vec2(0.0);
}

#endif
