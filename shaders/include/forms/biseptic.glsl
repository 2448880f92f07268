// Patches of bidegree 7 with continuous curvature: 64 control points less the net's first point (report, section 4.3).
// Derivation, twin: osculate_surface::biseptic.
#ifndef FORMS_BISEPTIC_GLSL
#define FORMS_BISEPTIC_GLSL
#include "forms/form.glsl"
#include "domains/quad.glsl"
#include "spokes.glsl"
#include "curvature.glsl"

// From the stage: the net's first point, which control points are relative to.
vec3 control_origin();

// Bernstein polynomials of degree 7 at t.
void bernstein7(float t, out float b[8]) {
    precise float s = 1.0 - t;
    precise float t2 = t * t;
    precise float s2 = s * s;
    precise float t3 = t2 * t;
    precise float s3 = s2 * s;
    precise float t4 = t2 * t2;
    precise float s4 = s2 * s2;
    precise float r[8] = float[8](
        s4 * s3,
        7.0 * (t * (s3 * s3)),
        21.0 * (t2 * (s4 * s)),
        35.0 * (t3 * s4),
        35.0 * (t4 * s3),
        21.0 * ((t4 * t) * s2),
        7.0 * ((t3 * t3) * s),
        t4 * t3);
    b = r;
}

// Bernstein polynomials of degree 6 at t.
void bernstein6(float t, out float b[7]) {
    precise float s = 1.0 - t;
    precise float t2 = t * t;
    precise float s2 = s * s;
    precise float t3 = t2 * t;
    precise float s3 = s2 * s;
    precise float t4 = t2 * t2;
    precise float s4 = s2 * s2;
    precise float r[7] = float[7](
        s3 * s3, 6.0 * (t * (s4 * s)), 15.0 * (t2 * s4), 20.0 * (t3 * s3), 15.0 * (t4 * s2), 6.0 * ((t4 * t) * s), t3 * t3);
    b = r;
}

vec3 combine8(float w[8], vec3 p[8]) {
    precise vec3 sum = w[0] * p[0];
    for (int i = 1; i < 8; ++i) {
        sum = sum + w[i] * p[i];
    }
    return sum;
}

// The derivative of a curve of degree 7 over 7.
vec3 combine8_differences(float w[7], vec3 p[8]) {
    precise vec3 sum = w[0] * (p[1] - p[0]);
    for (int i = 1; i < 7; ++i) {
        sum = sum + w[i] * (p[i + 1] - p[i]);
    }
    return sum;
}

InnerPoint inner_point(uint id, vec2 uv) {
    float bu[8];
    float bv[8];
    float qu[7];
    float qv[7];
    bernstein7(uv.x, bu);
    bernstein7(uv.y, bv);
    bernstein6(uv.x, qu);
    bernstein6(uv.y, qv);
    vec3 row[8];
    vec3 slope[8];
    for (uint j = 0u; j < 8u; ++j) {
        vec3 p[8];
        for (uint i = 0u; i < 8u; ++i) {
            p[i] = control(8u * j + i);
        }
        row[j] = combine8(bu, p);
        slope[j] = combine8_differences(qu, p);
    }
    precise InnerPoint r;
    r.position = control_origin() + combine8(bv, row);
    r.du = 7.0 * combine8(bv, slope);
    r.dv = 7.0 * combine8_differences(qv, row);
    r.plane = cross_product(r.du, r.dv);
    return r;
}

// Second derivative of a curve of degree 7 over 42.
vec3 shade_bend(float t, vec3 p[8]) {
    float s = 1.0 - t;
    float w[6] = float[6](s * s * s * s * s, 5.0 * t * s * s * s * s, 10.0 * t * t * s * s * s, 10.0 * t * t * t * s * s, 5.0 * t * t * t * t * s, t * t * t * t * t);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 6; ++i) {
        sum += w[i] * ((p[i + 2] - p[i + 1]) - (p[i + 1] - p[i]));
    }
    return sum;
}

vec2 shade_curvature(uint id, vec2 uv) {
    float bu[8];
    float bv[8];
    float qu[7];
    float qv[7];
    bernstein7(uv.x, bu);
    bernstein7(uv.y, bv);
    bernstein6(uv.x, qu);
    bernstein6(uv.y, qv);
    vec3 row[8];
    vec3 slope[8];
    vec3 bend[8];
    for (uint j = 0u; j < 8u; ++j) {
        vec3 p[8];
        for (uint i = 0u; i < 8u; ++i) {
            p[i] = control(8u * j + i);
        }
        row[j] = combine8(bu, p);
        slope[j] = combine8_differences(qu, p);
        bend[j] = shade_bend(uv.x, p);
    }
    return shade_curvature_of(
        7.0 * combine8(bv, slope),
        7.0 * combine8_differences(qv, row),
        42.0 * combine8(bv, bend),
        49.0 * combine8_differences(qv, slope),
        42.0 * shade_bend(uv.y, row));
}

// The point of a spoke at t: its curve and cross derivative are of degree 7.
SurfacePoint biseptic_spoke_point(SpokeRecord spoke, float t) {
    vec3 curve[8];
    vec3 cross_field[8];
    for (uint i = 0u; i < 8u; ++i) {
        curve[i] = stored_vector(spoke.vectors + i);
        cross_field[i] = stored_vector(spoke.vectors + 8u + i);
    }
    float b[8];
    float q[7];
    bernstein7(t, b);
    bernstein6(t, q);
    vec3 plane = cross_product(combine8_differences(q, curve), combine8(b, cross_field));
    return SurfacePoint(combine8(b, curve), unit_or_zero(plane));
}

SurfacePoint side_point(uint id, uint side, vec2 uv) {
    return is_spoke(side) ? biseptic_spoke_point(spoke_of(id, side), spoke_parameter(side, uv)) : cubic_side_point(id, side, uv);
}

#endif
