// Tessellation factors of a patch, for the control stages.
#ifndef FACTORS_GLSL
#define FACTORS_GLSL
#include "edge_factor.glsl"
#include "sides.glsl"

// Factor of a side of a quad: that of its edge; or, an edge of an unrefined face being two of the others, twice as many segments.
float side_factor(uint edge) {
    precise float doubled = 2.0 * ceil(frame.level);
    return SIDES == SIDES_UNREFINED ? doubled : edge_factor(edge >> 1u);
}

// Zero, which no compiler knows: there are less than 2^31 patches. lavapipe compiles a stage anew with every frame if it stores one uniform, and nothing else, in
// five places or more, in the hope that a constant does better.
float hidden_zero(uint patch_id) {
    return float(patch_id >> 31u);
}

// Writes gl_TessLevelOuter and gl_TessLevelInner of a patch. Vulkan's outer levels are those of u=0, v=0, u=1, v=1.
void write_factors(uint patch_id) {
    float zero = hidden_zero(patch_id);
    precise float f0 = side_factor(patch_edge(patch_id, 0)) + zero;
    precise float f1 = side_factor(patch_edge(patch_id, 1)) + zero;
    precise float f2 = side_factor(patch_edge(patch_id, 2)) + zero;
    precise float f3 = side_factor(patch_edge(patch_id, 3)) + zero;
    gl_TessLevelOuter[0] = f3;
    gl_TessLevelOuter[1] = f0;
    gl_TessLevelOuter[2] = f1;
    gl_TessLevelOuter[3] = f2;
    gl_TessLevelInner[0] = max(f0, f2);
    gl_TessLevelInner[1] = max(f1, f3);
}

// The same for a triangle: outer levels are those of u=0, v=0, w=0.
void write_triangle_factors(uint patch_id) {
    float zero = hidden_zero(patch_id);
    precise float side0 = edge_factor(patch_edge(patch_id, 0) >> 1u) + zero;
    precise float side1 = edge_factor(patch_edge(patch_id, 1) >> 1u) + zero;
    precise float side2 = edge_factor(patch_edge(patch_id, 2) >> 1u) + zero;
    gl_TessLevelOuter[0] = side2;
    gl_TessLevelOuter[1] = side0;
    gl_TessLevelOuter[2] = side1;
    gl_TessLevelInner[0] = max(max(side0, side1), side2);
    // Wireframes are drawn as fine along u as along v.
    gl_TessLevelInner[1] = gl_TessLevelInner[0];
}

// A patch whose outer levels are zero is not tessellated.
void discard_patch() {
    gl_TessLevelOuter[0] = 0.0;
    gl_TessLevelOuter[1] = 0.0;
    gl_TessLevelOuter[2] = 0.0;
    gl_TessLevelOuter[3] = 0.0;
    gl_TessLevelInner[0] = 0.0;
    gl_TessLevelInner[1] = 0.0;
}

#endif
