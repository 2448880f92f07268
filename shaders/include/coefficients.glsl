// The coefficient buffer: vectors computed before the draw (records/coefficients.comp): control points of stored patches, then spoke records.
#ifndef COEFFICIENTS_GLSL
#define COEFFICIENTS_GLSL
#include "bindings.glsl"

layout(std430, set = 0, binding = BINDING_COEFFICIENTS) readonly buffer Coefficients { float coefficients[]; };

vec3 stored_vector(uint index) {
    return vec3(coefficients[3u * index], coefficients[3u * index + 1u], coefficients[3u * index + 2u]);
}

#endif
