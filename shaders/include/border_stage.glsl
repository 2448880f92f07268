// Vertices on the borders of patches, for shades that measure nothing but places: one thread per corner and the side that leaves it. All of them come from
// records, so no control points are needed. A kernel includes this, its grid and its form; with CUBIC_SIDES all sides are cubic records, each read once.
#ifndef BORDER_STAGE_GLSL
#define BORDER_STAGE_GLSL
#include "thread.glsl"
#include "kernel_push.glsl"
#define SIDES_IN_SEGMENTS
#include "grid.glsl"
#include "grid_sides.glsl"
#include "grid_store.glsl"

// From the grid: number of sides, and places on them.
uint side_count();
vec2 side_uv(uint side, float along, float back);

// No vertex here is computed from control points.
vec3 control(uint i) {
    return vec3(0.0);
}

const InnerPoint NOT_INSIDE = InnerPoint(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));

void store_border_vertex(uint number, uint id, vec2 uv, SurfacePoint point) {
    store_grid_vertex(number, id, grid_point(id, uv, NOT_INSIDE, point), shade_place(id, uv));
}

// The vertices along a side, its corners excepted. Parameters mirror each other without rounding, so nothing is computed here.
void write_side(uint grid_patch, uint side, uint id) {
    uint rate = grid_patches[grid_patch].side_rate[side];
    uint last = rate_segments(rate);
    if (last < 2u) {
        return;
    }
    uint first = grid_patches[grid_patch].side_vertex[side];
    uint edge = patch_edge(id, side);
    bool flipped = (edge & 1u) == 1u;
#ifdef CUBIC_SIDES
    EdgeRecord record = load_edge_record(edge >> 1u);
#endif
    for (uint i = 1u; i < last; ++i) {
        vec2 uv = side_uv(side, rate_parameter(rate, i), rate_parameter(rate, last - i));
#ifdef CUBIC_SIDES
        SurfacePoint point = edge_point(record, side_parameter(id, side, edge & 1u, uv));
#else
        SurfacePoint point = side_point(id, side, uv);
#endif
        store_border_vertex(first + (flipped ? last - i : i) - 1u, id, uv, point);
    }
}

// What one thread does: the corner and the side of a patch that are its own.
void write_border() {
    uint thread = thread_index();
    uint side = thread & 3u;
    if (thread >= 4u * kernel.count || side >= side_count()) {
        return;
    }
    uint grid_patch = kernel.first + (thread >> 2u);
    uint id = grid_patches[grid_patch].patch_id;
    uint owned = grid_patches[grid_patch].owned >> side;
    if ((owned & 1u) == 1u) {
        vec2 uv = side_uv(side, 0.0, 1.0);
        store_border_vertex(grid_patches[grid_patch].corner_vertex[side], id, uv, corner_point(id, side, uv));
    }
    if (((owned >> GRID_OWNED_SIDES) & 1u) == 1u) {
        write_side(grid_patch, side, id);
    }
}

#endif
