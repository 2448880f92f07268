// Parameters on the records of sides, also beside faces that are left unrefined. The edge of such a face has one record; to the two patches on its other side each half of it is a side, number 0 of the one and 3 of the other, and their common corner, the middle, is a point of the record.
//
// Both sorts of patches must take the same points to the same bits, though the tessellator places i of n and 2 i of 2 n in fixed point. So a parameter is
// divided out of two integers, which are the same for both: the number of the point on the edge, and the segments of the edge.
#ifndef SIDE_PARAMETER_GLSL
#define SIDE_PARAMETER_GLSL
#include "records.glsl"
#include "sides.glsl"

// From the domain.
uint side_of(vec2 uv);
uint corner_of(vec2 uv);
float edge_parameter(uint side, uint flip, vec2 uv);

#ifdef SIDES_IN_SEGMENTS
#include "frame.glsl"

// Segments of each side of the patches of the list. Factors are uniform.
uint side_segments() {
    uint segments = uint(ceil(frame.level));
    return SIDES == SIDES_UNREFINED ? 2u * segments : segments;
}
#endif

// Whether a side is half an edge.
bool is_half_side(uint id, uint side) {
    uint bit = side == 0u ? TAG_HALF_0 : side == 3u ? TAG_HALF_3 : 0u;
    return SIDES == SIDES_HALVES && (patch_basis(id).tag & bit) != 0u;
}

// The corner at (u,v) that has a vertex record, or 4; the middle of an edge has none, and lies on its halves.
uint recorded_corner(uint id, vec2 uv, inout uint side) {
    uint corner = corner_of(uv);
    if (SIDES == SIDES_HALVES) {
        if (corner == 1u && is_half_side(id, 0u)) {
            return 4u;
        }
        if (corner == 3u && is_half_side(id, 3u)) {
            side = 3u;
            return 4u;
        }
    }
    return corner;
}

// The parameter on the record of a side at (u,v).
float side_parameter(uint id, uint side, uint flip, vec2 uv) {
    bool is_half = is_half_side(id, side);
    if (SIDES == SIDES_PLAIN || !(is_half || SIDES == SIDES_UNREFINED)) {
        return edge_parameter(side, flip, uv);
    }
    // From the first corner of the side to the next.
    float x = edge_parameter(side, 0u, uv);
#ifdef SIDES_IN_SEGMENTS
    uint segments = side_segments();
    precise float place = x * float(segments) + 0.5;
    uint i = uint(place);
    if (is_half) {
        i += side == 3u ? segments : 0u;
        segments *= 2u;
    }
    precise float t = float(flip == 1u ? segments - i : i) / float(segments);
#else
    precise float along = is_half ? (side == 3u ? 0.5 + 0.5 * x : 0.5 * x) : x;
    precise float t = flip == 1u ? 1.0 - along : along;
#endif
    return t;
}

#endif
