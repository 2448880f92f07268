// Inner vertices of patches, for shades that measure nothing but places: one thread per patch. Processors that run threads in the lanes of a vector, and know no
// memory faster than any other, evaluate as many patches at once as a vector has lanes, and hold control points in registers. A kernel includes this, its grid
// and its form, and says how control points come about.
#ifndef LANE_STAGE_GLSL
#define LANE_STAGE_GLSL
#include "kernel_push.glsl"
#include "grid.glsl"
#include "grid_store.glsl"

layout(local_size_x = GRID_GROUP_SIZE, local_size_x_id = SPEC_GRID_GROUP) in;

// From the kernel: makes the control points of a patch; begins to evaluate at a fixed u, then at (u,v).
void make_control_points(uint id);
void enter_column(uint id, float u);
InnerPoint column_point(uint id, vec2 uv);

void write_inside() {
    uint thread = gl_LocalInvocationIndex + gl_WorkGroupSize.x * (gl_WorkGroupID.x + gl_WorkGroupID.y * GROUPS_X);
    if (thread >= kernel.count) {
        return;
    }
    uint grid_patch = kernel.first + thread;
    uint id = grid_patches[grid_patch].patch_id;
    uint rate_u = grid_patches[grid_patch].inner_rate[0];
    uint rate_v = grid_patches[grid_patch].inner_rate[1];
    uint first = grid_patches[grid_patch].first_inner;
    uint width = rate_segments(rate_u) - 1u;
    uint height = rate_segments(rate_v) - 1u;
    make_control_points(id);
    for (uint i = 0u; i < width; ++i) {
        float u = rate_parameter(rate_u, i + 1u);
        enter_column(id, u);
        for (uint j = 0u; j < height; ++j) {
            vec2 uv = vec2(u, rate_parameter(rate_v, j + 1u));
            InnerPoint inner = column_point(id, uv);
            SurfacePoint point = SurfacePoint(inner.position, unit_or_zero(inner.plane));
            store_grid_vertex(first + j * width + i, id, grid_point(id, uv, inner, point), shade_place(id, uv));
        }
    }
}

#endif
