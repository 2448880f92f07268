// Curvature from first and second derivatives.
#ifndef CURVATURE_GLSL
#define CURVATURE_GLSL
#include "bezier.glsl"
#include "vector.glsl"

float shade_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// (mean, Gaussian) curvature from the derivatives; zero where there is no tangent plane. For shading alone: no bits are promised.
vec2 shade_curvature_of(vec3 du, vec3 dv, vec3 duu, vec3 duv, vec3 dvv) {
    vec3 n = unit_or_zero(cross_product(du, dv));
    float e = shade_dot(du, du);
    float f = shade_dot(du, dv);
    float g = shade_dot(dv, dv);
    float l = shade_dot(duu, n);
    float m = shade_dot(duv, n);
    float k = shade_dot(dvv, n);
    float area = e * g - f * f;
    vec2 r = vec2((e * k - 2.0 * (f * m)) + g * l, l * k - m * m) / vec2(2.0 * area, area);
    return area > 0.0 ? r : vec2(0.0);
}

// Curvature of a bicubic Bezier patch.
vec2 shade_bicubic_curvature(vec3 b[16], vec2 uv) {
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
    vec3 duu = 6.0 * combine4(bv, bend[0], bend[1], bend[2], bend[3]);
    vec3 duv = 9.0 * combine_differences(bernstein2(uv.y), slope[0], slope[1], slope[2], slope[3]);
    vec3 dvv = 6.0 * combine_second_differences(uv.y, row[0], row[1], row[2], row[3]);
    return shade_curvature_of(p.du, p.dv, duu, duv, dvv);
}

#endif
