// An edge record at hand: a cubic curve C and a cross field D, walked in the direction of the side that owns it.
#ifndef EDGE_RECORD_GLSL
#define EDGE_RECORD_GLSL
#include "vector.glsl"
#include "bezier.glsl"

struct SurfacePoint {
    vec3 position;
    vec3 normal;
};

// The control points of C and of D.
struct EdgeRecord {
    vec3 curve[4];
    vec3 cross_field[4];
};

// The point of an edge record at t: position C(t), normal along C'(t) x D(t).
SurfacePoint edge_point(EdgeRecord edge, float t) {
    vec4 b = bernstein3(t);
    vec3 c[4] = edge.curve;
    vec3 d[4] = edge.cross_field;
    vec3 tangent = combine_differences(bernstein2(t), c[0], c[1], c[2], c[3]);
    vec3 cross_field = combine4(b, d[0], d[1], d[2], d[3]);
    return SurfacePoint(combine4(b, c[0], c[1], c[2], c[3]), unit_or_zero(cross_product(tangent, cross_field)));
}

#endif
