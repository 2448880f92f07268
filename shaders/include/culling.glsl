// Patches of which nothing can be seen are left out before they are tessellated. What is left out covers no sample, so a picture stays the same, and the
// patches beside it are drawn as ever. The stage defines the points of a hull.
//
// A hull holds all points of the patch: exactly those of a control net whose weights are never negative, else that net's, let out. A weight below zero
// can lead beyond the extent of the points along a direction by its share of that extent, so `cull_overshoot`, the sum of the negative weights of the
// worst control point, times the extent, is what has to be added on both sides.
#ifndef CULLING_GLSL
#define CULLING_GLSL
#include "frame.glsl"

// 0 where nothing is left out: devices without branches would look at the hull all the same.
layout(constant_id = SPEC_CULLS) const uint CULLS = 1;

bool cull_is_on() {
    return CULLS != 0u && frame.cull != 0u;
}

// From the stage: the points of the hull.
uint cull_hull_size();
vec3 cull_hull_point(uint i);
float cull_overshoot();

// Roundings, as a share of the extent and of the distance: far more than evaluation and transformation make.
#define CULL_ROUNDING 1e-5

// Clip-space extents of the hull: distances from the six planes, and where it lies in the picture, in samples.
struct HullExtent {
    // Least and greatest of w+x, w-x, w+y, w-y.
    vec4 side_low;
    vec4 side_high;
    // Least and greatest of z, w-z.
    vec2 depth_low;
    vec2 depth_high;
    // Least and greatest of x/w, y/w. Means something where all of w is positive.
    vec2 screen_low;
    vec2 screen_high;
    float w_low;
};

HullExtent cull_extent() {
    HullExtent extent;
    for (uint i = 0u; i < cull_hull_size(); ++i) {
        vec4 clip = frame.cull_clip_from_cage * vec4(cull_hull_point(i), 1.0);
        vec4 side = clip.w + vec4(clip.x, -clip.x, clip.y, -clip.y);
        vec2 depth = vec2(clip.z, clip.w - clip.z);
        vec2 screen = clip.xy / clip.w;
        if (i == 0u) {
            extent = HullExtent(side, side, depth, depth, screen, screen, clip.w);
        }
        extent.side_low = min(extent.side_low, side);
        extent.side_high = max(extent.side_high, side);
        extent.depth_low = min(extent.depth_low, depth);
        extent.depth_high = max(extent.depth_high, depth);
        extent.screen_low = min(extent.screen_low, screen);
        extent.screen_high = max(extent.screen_high, screen);
        extent.w_low = min(extent.w_low, clip.w);
    }
    return extent;
}

// Whether all of the hull lies beyond one of the planes.
bool cull_beyond_a_plane(HullExtent extent) {
    float share = cull_overshoot() + CULL_ROUNDING;
    vec4 side = extent.side_high + share * (extent.side_high - extent.side_low) + CULL_ROUNDING * abs(extent.side_high);
    vec2 depth = extent.depth_high + share * (extent.depth_high - extent.depth_low) + CULL_ROUNDING * abs(extent.depth_high);
    return any(lessThan(side, vec4(0.0))) || any(lessThan(depth, vec2(0.0)));
}

// Whether the hull covers no place where a sample can lie: it falls between them along x or along y. Samples of several per pixel lie on a grid of
// sixteenths. The rasterizer moves vertices by less than a 64th of a pixel.
bool cull_between_samples(HullExtent extent) {
    if (cull_overshoot() > 0.0 || !(extent.w_low > 0.0)) {
        return false;
    }
    vec2 per_axis = 0.5 * frame.cull_viewport * frame.cull_samples;
    float offset = frame.cull_samples > 1.0 ? 0.0 : 0.5;
    float snap = frame.cull_samples / 64.0;
    vec2 rounding = CULL_ROUNDING * per_axis;
    vec2 low = (extent.screen_low + 1.0) * per_axis - rounding - snap;
    vec2 high = (extent.screen_high + 1.0) * per_axis + rounding + snap;
    return any(greaterThan(ceil(low - offset), floor(high - offset)));
}

bool cull_hull_is_unseen() {
    HullExtent extent = cull_extent();
    return ((frame.cull & CULL_FRUSTUM) != 0u && cull_beyond_a_plane(extent)) || ((frame.cull & CULL_SMALL) != 0u && cull_between_samples(extent));
}

#endif
