// The coefficient buffer: 20 Gregory points per patch that does not go through a patch list of net points.
#ifndef COEFFICIENTS_GLSL
#define COEFFICIENTS_GLSL
#include "bindings.glsl"
#include "constants.glsl"

layout(std430, set = 0, binding = BINDING_COEFFICIENTS) readonly buffer Coefficients { float coefficients[]; };

void load_coefficients(uint index, out vec3 g[GREGORY_POINTS]) {
    for (uint i = 0u; i < GREGORY_POINTS; ++i) {
        uint at = 3u * (GREGORY_POINTS * index + i);
        g[i] = vec3(coefficients[at], coefficients[at + 1u], coefficients[at + 2u]);
    }
}

#endif
