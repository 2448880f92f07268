// Tessellation factors. Outer factors depend on edge records and the frame alone, so both patches of an edge agree bit for bit.
#ifndef FACTORS_GLSL
#define FACTORS_GLSL
#include "frame.glsl"
#include "records.glsl"

float distance_between(vec3 a, vec3 b) {
    precise vec3 d = b - a;
    return sqrt(squared_length(d));
}

// Factor of an edge: the uniform level, or the length of its control polygon over its distance from the eye.
float edge_factor(uint edge) {
    if (frame.factor_mode == FACTORS_UNIFORM) {
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

// Writes gl_TessLevelOuter and gl_TessLevelInner of a patch. Vulkan's outer levels are those of u=0, v=0, u=1, v=1.
void write_factors(uint patch_id) {
    float f0 = edge_factor(patches[patch_id].edge[0] >> 1u);
    float f1 = edge_factor(patches[patch_id].edge[1] >> 1u);
    float f2 = edge_factor(patches[patch_id].edge[2] >> 1u);
    float f3 = edge_factor(patches[patch_id].edge[3] >> 1u);
    gl_TessLevelOuter[0] = f3;
    gl_TessLevelOuter[1] = f0;
    gl_TessLevelOuter[2] = f1;
    gl_TessLevelOuter[3] = f2;
    gl_TessLevelInner[0] = max(f0, f2);
    gl_TessLevelInner[1] = max(f1, f3);
}

// The same for a triangle: outer levels are those of u=0, v=0, w=0.
void write_triangle_factors(uint patch_id) {
    float side0 = edge_factor(patches[patch_id].edge[0] >> 1u);
    float side1 = edge_factor(patches[patch_id].edge[1] >> 1u);
    float side2 = edge_factor(patches[patch_id].edge[2] >> 1u);
    gl_TessLevelOuter[0] = side2;
    gl_TessLevelOuter[1] = side0;
    gl_TessLevelOuter[2] = side1;
    gl_TessLevelInner[0] = max(max(side0, side1), side2);
    // Wireframes are drawn as fine along u as along v.
    gl_TessLevelInner[1] = gl_TessLevelInner[0];
}

#endif
