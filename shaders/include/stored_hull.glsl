// The hull of a patch whose control points were computed before the draw, for the control stages.
#ifndef STORED_HULL_GLSL
#define STORED_HULL_GLSL
#include "culling.glsl"
#include "coefficients.glsl"
#include "records.glsl"

layout(location = 1) in flat uint net_patch[];

// Control points of the patch, which hold all of it; none where it has coefficients of eigenfunctions.
uint cull_hull_size() {
    uint form = patch_basis(net_patch[0]).tag & FORM_MASK;
    return form == FORM_GREGORY ? GREGORY_POINTS : form == FORM_TRIANGLE ? TRIANGLE_POINTS : 0u;
}

vec3 cull_hull_point(uint i) {
    return stored_vector(patch_basis(net_patch[0]).net + i);
}

float cull_overshoot() {
    return 0.0;
}

// Whether nothing of the patch can be seen.
bool cull_patch() {
    return cull_is_on() && cull_hull_size() > 0u && cull_hull_is_unseen();
}

#endif
