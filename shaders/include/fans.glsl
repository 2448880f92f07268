// Fans: what a vertex contributes to the edges and patches around it, as vectors in Coefficients (osculate_surface::gregory::Fan): limit position, the edge point of
// every edge, then for every edge points 1 and 0 of the cross derivative of the edge walked outwards.
#ifndef FANS_GLSL
#define FANS_GLSL
#include "bindings.glsl"
#include "constants.glsl"

struct FanRecord {
    // First vector in Coefficients.
    uint first;
    // Number of edges.
    uint edges;
    // CROSS_END_*
    uint cross_end;
    // Cosine of the angle between neighbouring edges.
    float cosine;
};

layout(std430, set = 0, binding = BINDING_FANS) readonly buffer Fans { FanRecord fans[]; };

// From the kernel: vector i of Coefficients.
vec3 fan_vector(uint i);

// What an edge takes from the fan of one of its ends.
struct FanSpoke {
    vec3 position;
    vec3 edge_point;
    vec3 cross_inner;
    vec3 cross_end;
};

FanSpoke fan_spoke(uint fan, uint edge) {
    uint first = fans[fan].first;
    uint inner = first + 1u + fans[fan].edges + 2u * edge;
    return FanSpoke(fan_vector(first), fan_vector(first + 1u + edge), fan_vector(inner), fan_vector(inner + 1u));
}

#endif
