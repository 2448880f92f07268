// Unit vectors for colours: of no promised bits, so that the device's reciprocal root serves. `normalize` also keeps the squares of huge and tiny vectors in
// range, which takes three divisions a fragment on some drivers.
#ifndef UNIT_GLSL
#define UNIT_GLSL

// The unit vector along a, or another where a is zero: undefined normals must not become colours that are not numbers.
vec3 shade_unit_or(vec3 a, vec3 other) {
    float squared = dot(a, a);
    return squared > 1e-30 ? a * inversesqrt(squared) : other;
}

vec3 shade_unit_or_zero(vec3 a) {
    return shade_unit_or(a, vec3(0.0));
}

#endif
