// The coefficient buffer: vectors computed before the draw (records/coefficients.comp): control points of stored patches, then spoke records.
#ifndef COEFFICIENTS_GLSL
#define COEFFICIENTS_GLSL
#include "bindings.glsl"

layout(set = 0, binding = BINDING_COEFFICIENT_TEXELS) uniform samplerBuffer coefficients;

vec3 stored_vector(uint index) {
    return texelFetch(coefficients, int(index)).xyz;
}

#endif
