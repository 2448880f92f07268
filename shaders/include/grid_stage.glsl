// The compute evaluator's counterpart of evaluation_stage.glsl: one workgroup per patch. Its threads make the control points once, by the basis of the control
// stage, then share the patch's vertices: those inside, and those on the border if their shade takes the patch's own formula. A kernel includes this, its grid, its basis and its form. Define CONTROL_POINTS, the most that are made here, before
// the include.
#ifndef GRID_STAGE_GLSL
#define GRID_STAGE_GLSL
#define SIDES_IN_SEGMENTS
#include "grid.glsl"
#include "grid_sides.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "coefficients.glsl"
#include "bases/net.glsl"
#include "forms/form.glsl"
#include "grid_store.glsl"

layout(local_size_x = GRID_GROUP_SIZE, local_size_x_id = SPEC_GRID_GROUP) in;

shared vec3 shared_control[CONTROL_POINTS];

// The patch at hand.
GridPatch grid;

// From the grid: number of sides, places on them and inside, which are numbered row by row.
uint side_count();
vec2 side_uv(uint side, float along, float back);
uint inner_count(GridPatch grid);
vec2 inner_uv(GridPatch grid, uint i);

vec3 net_point_at(uint i) {
    return load_point(net_index(patch_basis(grid.patch_id).net + i));
}

// From the kernel: how many control points the basis makes.
uint control_count();

// From the basis.
vec3 change_basis(uint point, uint basis, uint net_size);

#ifdef CONTROL_FROM_STAGE
// The kernel makes the control points in a way of its own; none of its patches are stored.
void make_control_points();

vec3 control(uint i) {
    return shared_control[i];
}
#else
// Whether the control points of the patch at hand are stored, and where.
bool stored;
uint stored_at;

vec3 control(uint i) {
    return stored ? stored_vector(stored_at + i) : shared_control[i];
}

void make_control_points() {
    PatchBasis p = patch_basis(grid.patch_id);
    stored = (p.tag & TAG_STORED) != 0u;
    stored_at = p.net;
    if (!stored) {
        for (uint i = gl_LocalInvocationIndex; i < control_count(); i += gl_WorkGroupSize.x) {
            shared_control[i] = change_basis(i, p.basis, p.net_size);
        }
    }
    barrier();
}
#endif

// Stores the vertex with that number at (u,v), displaced if the surface is. `inner` is for that, and for what is measured.
void store_vertex(uint number, vec2 uv, SurfacePoint point, InnerPoint inner) {
    uint id = grid.patch_id;
    vec2 segments = vec2(rate_segments(grid.inner_rate[0]), rate_segments(grid.inner_rate[1]));
    store_grid_vertex(number, id, grid_point(id, uv, inner, point), shade_measure(id, uv, inner, segments));
}

// Which vertex of the patch a thread is at.
struct GridVertex {
    vec2 uv;
    uint number;
    // Whether it is this patch that evaluates it.
    bool owned;
};

// Vertex `i` of the border, counter-clockwise from corner 0. Parameters mirror each other without rounding, so nothing is computed here.
GridVertex border_vertex(uint i) {
    uint side = 0u;
    while (i >= rate_segments(grid.side_rate[side])) {
        i -= rate_segments(grid.side_rate[side]);
        ++side;
    }
    uint rate = grid.side_rate[side];
    uint last = rate_segments(rate);
    GridVertex vertex;
    vertex.uv = side_uv(side, rate_parameter(rate, i), rate_parameter(rate, last - i));
    bool flipped = (patch_edge(grid.patch_id, side) & 1u) == 1u;
    vertex.number = i == 0u ? grid.corner_vertex[side] : grid.side_vertex[side] + (flipped ? last - i : i) - 1u;
    vertex.owned = ((grid.owned >> (i == 0u ? side : GRID_OWNED_SIDES + side)) & 1u) == 1u;
    return vertex;
}

// All vertices of one patch.
void write_patch() {
    uint index = gl_WorkGroupID.x + gl_WorkGroupID.y * GROUPS_X;
    if (index >= kernel.count) {
        return;
    }
    grid = grid_patches[kernel.first + index];
    make_control_points();
    // Elsewhere the border is made without control points: see border_stage.glsl.
    uint border = 0u;
    if (shade_measures_patch()) {
        for (uint side = 0u; side < side_count(); ++side) {
            border += rate_segments(grid.side_rate[side]);
        }
    }
    // Border and inside are loops of their own: where lanes go through both branches of a condition, each vertex would be evaluated both ways.
    for (uint i = gl_LocalInvocationIndex; i < border; i += gl_WorkGroupSize.x) {
        GridVertex vertex = border_vertex(i);
        SurfacePoint point;
        if (vertex.owned && shared_point(grid.patch_id, vertex.uv, point)) {
            InnerPoint inner = InnerPoint(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
            if (SHADE == SHADE_WIREFRAME) {
                inner = inner_point(grid.patch_id, vertex.uv);
            }
            store_vertex(vertex.number, vertex.uv, point, inner);
        }
    }
    for (uint i = gl_LocalInvocationIndex; i < inner_count(grid); i += gl_WorkGroupSize.x) {
        vec2 uv = inner_uv(grid, i);
        InnerPoint inner = inner_point(grid.patch_id, uv);
        store_vertex(grid.first_inner + i, uv, SurfacePoint(inner.position, unit_or_zero(inner.plane)), inner);
    }
}

#endif
