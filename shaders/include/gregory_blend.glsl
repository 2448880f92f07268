// Inner points of Gregory patches.
#ifndef GREGORY_BLEND_GLSL
#define GREGORY_BLEND_GLSL

// The interior point between f+ and f-, which each rule on their own edge. At the corner itself the quotient is 0/0; its Bernstein
// weight is zero there, so any finite value serves.
vec3 gregory_blend(vec3 plus, vec3 minus, float weight_plus, float weight_minus) {
    precise float sum = weight_plus + weight_minus;
    precise vec3 r = (weight_plus * plus + weight_minus * minus) / sum;
    return sum > 0.0 ? r : plus;
}

#endif
