// Tessellation factors. Outer factors depend on edge records and the frame alone, so both patches of an edge agree bit for bit.
#ifndef EDGE_FACTOR_GLSL
#define EDGE_FACTOR_GLSL
#include "frame.glsl"
#include "records.glsl"

// 0 where factors are known to be uniform: devices without branches would compute adaptive ones all the same.
layout(constant_id = SPEC_ADAPTIVE) const uint ADAPTIVE = 1;

float distance_between(vec3 a, vec3 b) {
    precise vec3 d = b - a;
    return sqrt(squared_length(d));
}

// Factor of an edge: the uniform level, or the length of its control polygon over its distance from the eye.
float edge_factor(uint edge) {
    if (ADAPTIVE == 0u || frame.factor_mode == FACTORS_UNIFORM) {
        return frame.level;
    }
    vec3 c0 = edge_record_point(edge, 0u);
    vec3 c1 = edge_record_point(edge, 1u);
    vec3 c2 = edge_record_point(edge, 2u);
    vec3 c3 = edge_record_point(edge, 3u);
    precise float polygon = (distance_between(c0, c1) + distance_between(c1, c2)) + distance_between(c2, c3);
    precise vec3 middle = (c1 + c2) * 0.5;
    precise float factor = (polygon * frame.segments_per_length) / max(distance_between(middle, frame.factor_eye.xyz), frame.near);
    // A factor that is not a number counts as 1, lest the patch be culled.
    return factor > 1.0 ? min(factor, 64.0) : 1.0;
}

#endif
