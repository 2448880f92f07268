// Spokes: sides 0 and 3 of an extraordinary patch, which meet at the extraordinary vertex V. Where the curve there is no cubic, both patches of a spoke read it
// from a record of their own, walked from V outwards, so that its parameter is u on side 0 and v on side 3: nothing is reversed.
#ifndef SPOKES_GLSL
#define SPOKES_GLSL
#include "bindings.glsl"
#include "coefficients.glsl"
#include "records.glsl"

struct SpokeRecord {
    // Its first vector in Coefficients.
    uint vectors;
    // First weight of the functions of its modes, for stam.
    uint table;
    // How many vectors it has.
    uint modes;
};

layout(std430, set = 0, binding = BINDING_SPOKES) readonly buffer Spokes {
    // Edge record that the first spoke record belongs to.
    uint first_spoke_edge;
    SpokeRecord spokes[];
};

// The spoke record of side 0 or 3 of a patch.
SpokeRecord spoke_of(uint id, uint side) {
    return spokes[(patch_edge(id, side) >> 1u) - first_spoke_edge];
}

bool is_spoke(uint side) {
    return side == 0u || side == 3u;
}

float spoke_parameter(uint side, vec2 uv) {
    return side == 0u ? uv.x : uv.y;
}

#endif
