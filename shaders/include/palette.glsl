// Colours that mean something, in linear RGB, written as the sRGB values that the legend in docs/shading.md shows.
#ifndef PALETTE_GLSL
#define PALETTE_GLSL
#include "constants.glsl"

// The linear colour of an sRGB colour, channels in 0..1 (IEC 61966-2-1).
vec3 shade_decode(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// The linear colour of an sRGB colour 0xRRGGBB.
vec3 shade_srgb(uint rgb) {
    return shade_decode(vec3(uvec3(rgb >> 16u, rgb >> 8u, rgb) & 255u) / 255.0);
}

// Colour of a number of edges: 4 is pale, 2 to 8 have hues of their own, more fade from violet to near black at 40.
vec3 shade_edges_color(uint edges) {
    switch (edges) {
    case 2u: return shade_srgb(0x3dbfa4);
    case 3u: return shade_srgb(0x3b7fd6);
    case 4u: return shade_srgb(0xe4e1da);
    case 5u: return shade_srgb(0xf6bc41);
    case 6u: return shade_srgb(0xe8702a);
    case 7u: return shade_srgb(0xcb2f46);
    case 8u: return shade_srgb(0x9c3aa6);
    default: return mix(shade_srgb(0x7a4bc2), shade_srgb(0x1e1738), clamp(float(edges - 9u) / 31.0, 0.0, 1.0));
    }
}

// By the edges at the patch's corner; paler where that is regular at a boundary.
vec3 shade_valence_color(uint tag) {
    vec3 color = shade_edges_color(tag >> TAG_VALENCE_SHIFT);
    bool regular = (tag & FORM_MASK) == FORM_BICUBIC;
    return regular ? mix(shade_edges_color(4u), color, 0.30) : color;
}

// Regular patches white to blue, extraordinary ones yellow to dark red by valence, those at a boundary green to purple.
vec3 shade_patch_color(uint tag) {
    uint valence = tag >> TAG_VALENCE_SHIFT;
    bool boundary = (tag & TAG_BOUNDARY) != 0u;
    if ((tag & FORM_MASK) == FORM_BICUBIC) {
        uint corner = valence == 2u ? 0x3f74b5u : 0x8fb8dau;
        return shade_srgb(boundary ? corner : 0xe4e1dau);
    }
    // 5 to 13 and beyond, the lower ones further apart.
    float more = sqrt(clamp((float(valence) - 5.0) / 8.0, 0.0, 1.0));
    if (boundary) {
        return valence < 4u ? shade_srgb(0x56b870) : mix(shade_srgb(0xc98bd8), shade_srgb(0x5a2a82), more);
    }
    if (valence < 4u) {
        return shade_srgb(valence == 2u ? 0xb9d63a : 0xf9e36a);
    }
    vec3 middle = shade_srgb(0xe2622a);
    return more < 0.5 ? mix(shade_srgb(0xf6b53c), middle, 2.0 * more) : mix(middle, shade_srgb(0x7d1420), 2.0 * more - 1.0);
}

// 0 flat, -1 and 1 the ends of a scale that a curvature comes to half way where its radius is a fifth of the half diagonal of the cage's box. `bend` is
// the curvature times that half diagonal.
float shade_curvature_scale(float bend) {
    float x = 0.2 * bend;
    return x / (1.0 + abs(x));
}

// From `low` over `flat_color` to `high`, by way of a paler colour on either side.
vec3 shade_diverging(float x, uint low, uint below, uint above, uint high) {
    vec3 flat_color = shade_srgb(0xf4f2ee);
    vec3 middle = shade_srgb(x > 0.0 ? above : below);
    float t = abs(x);
    return t < 0.5 ? mix(flat_color, middle, 2.0 * t) : mix(middle, shade_srgb(x > 0.0 ? high : low), 2.0 * t - 1.0);
}

// Mean curvature: blue hollow, white flat, red bulging as seen from outside.
vec3 shade_mean_color(float bulge) {
    return shade_diverging(shade_curvature_scale(bulge), 0x1f5fa8u, 0x67a9cfu, 0xef8a62u, 0xb2182bu);
}

// Gaussian curvature, by its root: violet saddles, white what is bent one way only, orange domes and bowls.
vec3 shade_gaussian_color(float product) {
    float bend = sign(product) * sqrt(abs(product));
    return shade_diverging(shade_curvature_scale(bend), 0x4d2a86u, 0xa99ccdu, 0xf2b056u, 0xb0530cu);
}

// A part of a range: off-white for nothing, then yellow, orange and red to dark violet at the end and beyond.
vec3 shade_difference_color(float part) {
    const uint COLORS[5] = uint[](0xf4f2eeu, 0xf8d568u, 0xec8a3cu, 0xbf3049u, 0x3d1152u);
    float x = 4.0 * clamp(part, 0.0, 1.0);
    uint i = min(uint(x), 3u);
    return mix(shade_srgb(COLORS[i]), shade_srgb(COLORS[i + 1u]), x - float(i));
}

// Steps between a number of segments and its double.
const float FACTOR_STEPS = 16.0;

// Segments across a patch as an even number, to be added to a coordinate from 0 to 1.
float shade_pack_factor(float segments) {
    return 2.0 * round(FACTOR_STEPS * log2(max(segments, 1.0)));
}

// That even number, without the coordinate.
float shade_packed_factor(float sum) {
    return 2.0 * floor(0.5 * sum + 0.25);
}

// Segments across a patch, 1 to 64, by their logarithm: in the colours of parts of a range.
vec3 shade_factor_color(float packed) {
    return shade_difference_color(packed / (12.0 * FACTOR_STEPS));
}

#endif
