// Parameters on the records of sides, also beside faces that are left unrefined. The edge of such a face has one record; to the two patches on its other side
// each half of it is a side, number 0 of the one and 3 of the other, and their common corner, the middle, is a point of the record.
//
// Both sorts of patches must take the same points to the same bits, though the tessellator places i of n and 2 i of 2 n in fixed point. So a parameter is found
// by two integers, which are the same for both: the number of the point on the edge, and the segments of the edge.
#ifndef SIDE_PARAMETER_GLSL
#define SIDE_PARAMETER_GLSL
#include "records.glsl"
#include "sides.glsl"

// From the domain.
uint side_of(vec2 uv);
uint corner_of(vec2 uv);
float edge_parameter(uint side, uint flip, vec2 uv);

#ifdef SIDES_IN_SEGMENTS
// From the stage, all of whose points are ends of segments: segments of the sides of refined patches, and the parameter at end `i` of those of a whole edge.
uint refined_segments();
float whole_edge_parameter(uint i, uint segments);
#endif

// Whether the patch is an unrefined face.
bool is_unrefined(uint id) {
    return SIDES == SIDES_UNREFINED || (SIDES == SIDES_BY_TAG && (patch_basis(id).tag & TAG_UNREFINED) != 0u);
}

// Whether a side is half an edge.
bool is_half_side(uint id, uint side) {
    uint bit = side == 0u ? TAG_HALF_0 : side == 3u ? TAG_HALF_3 : 0u;
    return (SIDES == SIDES_HALVES || SIDES == SIDES_BY_TAG) && (patch_basis(id).tag & bit) != 0u;
}

// The half side that ends at a corner without a vertex record, the middle of an edge, or 4.
uint half_side_to(uint id, uint corner) {
    return corner == 1u && is_half_side(id, 0u) ? 0u : corner == 3u && is_half_side(id, 3u) ? 3u : 4u;
}

// The corner at (u,v) that has a vertex record, or 4; then `side` is one on whose record the point lies.
uint recorded_corner(uint id, vec2 uv, inout uint side) {
    uint corner = corner_of(uv);
    uint half_side = half_side_to(id, corner);
    if (half_side == 4u) {
        return corner;
    }
    side = half_side;
    return 4u;
}

// The parameter on the record of a side at (u,v).
float side_parameter(uint id, uint side, uint flip, vec2 uv) {
    bool is_half = is_half_side(id, side);
    if (SIDES == SIDES_PLAIN || !(is_half || is_unrefined(id))) {
        return edge_parameter(side, flip, uv);
    }
    // From the first corner of the side to the next.
    float x = edge_parameter(side, 0u, uv);
#ifdef SIDES_IN_SEGMENTS
    uint half_segments = refined_segments();
    uint segments = 2u * half_segments;
    precise float place = x * float(is_half ? half_segments : segments) + 0.5;
    uint i = uint(place) + (is_half && side == 3u ? half_segments : 0u);
    return whole_edge_parameter(flip == 1u ? segments - i : i, segments);
#else
    precise float along = is_half ? (side == 3u ? 0.5 + 0.5 * x : 0.5 * x) : x;
    precise float reversed = 1.0 - along;
    return flip == 1u ? reversed : along;
#endif
}

#endif
