// Vector operations written out, so that every pipeline rounds alike: dot, cross and normalize may be lowered differently per stage.
#ifndef VECTOR_GLSL
#define VECTOR_GLSL

// The smallest float that is not subnormal: devices may flush smaller ones to zero.
const float SMALLEST_NORMAL = 1.17549435e-38;

vec3 cross_product(vec3 a, vec3 b) {
    precise vec3 r = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return r;
}

float squared_length(vec3 a) {
    precise float r = (a.x * a.x + a.y * a.y) + a.z * a.z;
    return r;
}

// The unit vector along a, or zero where a is zero or too small for its reciprocal. Dividing by the largest component first keeps the squares
// of small vectors away from underflow.
vec3 unit_or_zero(vec3 a) {
    float largest = max(max(abs(a.x), abs(a.y)), abs(a.z));
    if (!(largest >= SMALLEST_NORMAL)) {
        return vec3(0.0);
    }
    precise vec3 b = a / largest;
    precise vec3 r = b / sqrt(squared_length(b));
    return r;
}

#endif
