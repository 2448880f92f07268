// Whether a regular patch shows its back from everywhere on it. Its partial derivatives are sums of the differences of its net with weights that are
// never negative, so they lie in a cone about those differences; normals lie in a cone about the product of the axes (Sederberg and Meyers, Loop
// detection in surface patch intersections, 1988, section 4).
#ifndef NORMAL_CONE_GLSL
#define NORMAL_CONE_GLSL
#include "frame.glsl"
#include "bases/net.glsl"

struct Cone {
    vec3 axis;
    // Of the half angle, which is below a right angle.
    float sine;
};

// Differences along u (step 1) or v (step 4) of the 16 points.
vec3 cull_difference(uint i, uint along) {
    uint row = i / 3u;
    uint place = i % 3u;
    uint first = along == 1u ? 4u * row + place : row + 4u * place;
    return net_point_at(first + along) - net_point_at(first);
}

// The cone of the differences, or a sine of 1 where they turn by a right angle or vanish.
Cone cull_tangent_cone(uint along) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 12u; ++i) {
        sum += cull_difference(i, along);
    }
    vec3 axis = sum / max(length(sum), 1e-30);
    float cosine = 1.0;
    for (uint i = 0u; i < 12u; ++i) {
        vec3 d = cull_difference(i, along);
        cosine = min(cosine, dot(d, axis) / max(length(d), 1e-30));
    }
    // Less one rounding of single precision each way.
    cosine -= 1e-5;
    return Cone(axis, cosine > 0.0 ? sqrt(1.0 - cosine * cosine) : 1.0);
}

bool cull_faces_away() {
    Cone u = cull_tangent_cone(1u);
    Cone v = cull_tangent_cone(4u);
    vec3 product = cross(u.axis, v.axis);
    float sine = length(product);
    float cosine = abs(dot(u.axis, v.axis));
    float spread = sqrt(u.sine * u.sine + 2.0 * u.sine * v.sine * cosine + v.sine * v.sine);
    if (!(u.sine < 1.0 && v.sine < 1.0 && spread < sine)) {
        return false;
    }
    vec3 normal = product / sine;
    // All points of the patch lie in a ball about the middle of the net.
    vec3 low = net_point_at(0u);
    vec3 high = low;
    for (uint i = 1u; i < 16u; ++i) {
        low = min(low, net_point_at(i));
        high = max(high, net_point_at(i));
    }
    vec3 sight = 0.5 * (low + high) - frame.cull_eye.xyz;
    float distance = length(sight);
    float radius = 0.5 * length(high - low);
    if (!(radius < distance)) {
        return false;
    }
    float angle = asin(min(spread / sine, 1.0)) + asin(radius / distance) + 1e-4;
    return angle < 1.5707 && dot(sight, normal) > distance * sin(angle);
}

#endif
