// Bicubic Bezier patches: 16 control points (report, section 4.1).
#ifndef FORMS_BICUBIC_GLSL
#define FORMS_BICUBIC_GLSL
#include "forms/form.glsl"
#include "domains/quad.glsl"
#include "curvature.glsl"

void bicubic_points(out vec3 b[16]) {
    for (uint i = 0u; i < 16u; ++i) {
        b[i] = control(i);
    }
}

InnerPoint inner_point(uint id, vec2 uv) {
    vec3 b[16];
    bicubic_points(b);
    PatchPoint p = bicubic_point(b, uv);
    return InnerPoint(p.position, p.du, p.dv, cross_product(p.du, p.dv));
}

vec2 shade_curvature(uint id, vec2 uv) {
    vec3 b[16];
    bicubic_points(b);
    return shade_bicubic_curvature(b, uv);
}

SurfacePoint side_point(uint id, uint side, vec2 uv) {
    return cubic_side_point(id, side, uv);
}

#endif
