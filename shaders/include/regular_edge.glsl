// Edge records between regular vertices: four rows of points across the edge (left, middle, right); C from the limits across, D from half their
// differences. Derivation: osculate_surface::gregory::edge(Regular, side). Twin: osculate_subdiv::twin::edge_records.
#ifndef REGULAR_EDGE_GLSL
#define REGULAR_EDGE_GLSL
#include "regular_sources.glsl"
#include "edge_record.glsl"
#include "bezier.glsl"

// Net index of the first middle point of each side, the step along the side, and the step to its left.
const uint START[4] = uint[](4u, 2u, 11u, 13u);
const int ALONG[4] = int[](1, 4, -1, -4);
const int LEFT[4] = int[](4, -1, -4, 1);

// The record of a source in `regular_sources`.
EdgeRecord regular_edge_record(uint source) {
    uint patch_id = regular_source(source) >> 2u;
    uint side = regular_source(source) & 3u;
    vec3 limit[4];
    vec3 slope[4];
    for (int i = 0; i < 4; ++i) {
        int at = int(START[side]) + i * ALONG[side];
        vec3 left = regular_net_point(patch_id, uint(at + LEFT[side]));
        vec3 middle = regular_net_point(patch_id, uint(at));
        vec3 right = regular_net_point(patch_id, uint(at - LEFT[side]));
        precise vec3 m = (left + right) * (1.0 / 6.0) + middle * (2.0 / 3.0);
        precise vec3 d = (left - right) * 0.5;
        limit[i] = m;
        slope[i] = d;
    }
    EdgeRecord record;
    for (uint row = 0u; row < 4u; ++row) {
        record.curve[row] = bspline_to_bezier(row, limit[0], limit[1], limit[2], limit[3]);
        record.cross_field[row] = bspline_to_bezier(row, slope[0], slope[1], slope[2], slope[3]);
    }
    return record;
}

#endif
