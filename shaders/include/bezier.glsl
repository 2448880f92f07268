// Cubic Bezier curves and bicubic Bezier patches, and the change of basis from uniform cubic B-splines (report, section 4.1).
// Derivation and tests: osculate_surface::{bezier, bspline}.
#ifndef BEZIER_GLSL
#define BEZIER_GLSL

// Bernstein polynomials of degree 3 at t.
vec4 bernstein3(float t) {
    precise float s = 1.0 - t;
    precise vec4 b = vec4((s * s) * s, 3.0 * (t * (s * s)), 3.0 * ((t * t) * s), (t * t) * t);
    return b;
}

// Bernstein polynomials of degree 2 at t.
vec3 bernstein2(float t) {
    precise float s = 1.0 - t;
    precise vec3 b = vec3(s * s, 2.0 * (t * s), t * t);
    return b;
}

vec3 combine4(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = ((w.x * a + w.y * b) + w.z * c) + w.w * d;
    return r;
}

// The derivative of a cubic over 3: a combination of control point differences.
vec3 combine_differences(vec3 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = (w.x * (b - a) + w.y * (c - b)) + w.z * (d - c);
    return r;
}

// Second derivative over 6.
vec3 combine_second_differences(float t, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise float s = 1.0 - t;
    precise vec3 r = s * ((c - b) - (b - a)) + t * ((d - c) - (c - b));
    return r;
}

// Row `row` of the 4x4 change of basis from B-spline to Bezier points of one segment, times four points.
vec3 bspline_to_bezier(uint row, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r;
    if (row == 0u) {
        r = (a + c) * (1.0 / 6.0) + b * (2.0 / 3.0);
    } else if (row == 1u) {
        r = b * (2.0 / 3.0) + c * (1.0 / 3.0);
    } else if (row == 2u) {
        r = b * (1.0 / 3.0) + c * (2.0 / 3.0);
    } else {
        r = (b + d) * (1.0 / 6.0) + c * (2.0 / 3.0);
    }
    return r;
}

// Position and partial derivatives of a patch at (u,v).
struct PatchPoint {
    vec3 position;
    vec3 du;
    vec3 dv;
};

// A bicubic Bezier patch at a fixed u: the control points of the curve along v, and those of its derivative by u over 3.
struct BicubicColumn {
    vec3 row[4];
    vec3 slope[4];
};

// Of the patch with point i + 4 j, i along u.
BicubicColumn bicubic_column(vec3 b[16], float u) {
    vec4 bu = bernstein3(u);
    vec3 qu = bernstein2(u);
    BicubicColumn column;
    for (int j = 0; j < 4; ++j) {
        column.row[j] = combine4(bu, b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]);
        column.slope[j] = combine_differences(qu, b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]);
    }
    return column;
}

PatchPoint bicubic_column_point(BicubicColumn column, float v) {
    vec4 bv = bernstein3(v);
    vec3 qv = bernstein2(v);
    precise PatchPoint r;
    r.position = combine4(bv, column.row[0], column.row[1], column.row[2], column.row[3]);
    r.du = 3.0 * combine4(bv, column.slope[0], column.slope[1], column.slope[2], column.slope[3]);
    r.dv = 3.0 * combine_differences(qv, column.row[0], column.row[1], column.row[2], column.row[3]);
    return r;
}

PatchPoint bicubic_point(vec3 b[16], vec2 uv) {
    return bicubic_column_point(bicubic_column(b, uv.x), uv.y);
}

#endif
