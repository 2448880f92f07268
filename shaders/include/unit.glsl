// Unit vectors for colours: of no promised bits, so that the device's reciprocal root serves. `normalize` also keeps the squares of huge and tiny vectors in
// range, which takes three divisions a fragment on some drivers.
#ifndef UNIT_GLSL
#define UNIT_GLSL

// The unit vector along a, zero for zero: undefined normals must not become colours that are not numbers.
vec3 shade_unit_or_zero(vec3 a) {
    float squared = dot(a, a);
    return squared > 1e-30 ? a * inversesqrt(squared) : vec3(0.0);
}

#endif
