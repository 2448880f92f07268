// Grids of the compute evaluator: how patches are divided, and the vertices that come of it. Planned by crates/engine/src/grid.
#ifndef GRID_GLSL
#define GRID_GLSL
#include "bindings.glsl"
#include "constants.glsl"

// How one patch is divided. A rate is the segments of a side, below bit GRID_SEGMENT_BITS, and its first parameter in GridParameters, above.
struct GridPatch {
    uint patch_id;
    // Bit k: this patch evaluates the vertex at corner k; bit GRID_OWNED_SIDES + k: those along side k.
    uint owned;
    // Its first inner vertex; u runs fastest.
    uint first_inner;
    // Rates of the sides.
    uint side_rate[4];
    // Rates inside along u and along v.
    uint inner_rate[2];
    // Vertex at each corner.
    uint corner_vertex[4];
    // First vertex along each side, in the direction of the edge record.
    uint side_vertex[4];
};

layout(std430, set = 0, binding = BINDING_GRID_PATCHES) readonly buffer GridPatches { GridPatch grid_patches[]; };
layout(set = 0, binding = BINDING_GRID_PARAMETERS) uniform samplerBuffer grid_parameters;

uint rate_segments(uint rate) {
    return rate & ((1u << GRID_SEGMENT_BITS) - 1u);
}

// End `i` of the segments.
float rate_parameter(uint rate, uint i) {
    return texelFetch(grid_parameters, int((rate >> GRID_SEGMENT_BITS) + i)).x;
}

#endif
