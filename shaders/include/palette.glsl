// Colours of patches by kind and valence, in linear RGB; the legend stands in docs/shading.md.
#ifndef PALETTE_GLSL
#define PALETTE_GLSL
#include "constants.glsl"

vec3 shade_srgb(float r, float g, float b) {
    return pow(vec3(r, g, b), vec3(2.2));
}

// Hue of a valence: 3 to 8 have their own, higher ones fade from violet to black.
vec3 shade_valence_color(uint valence) {
    switch (valence) {
    case 2u: return shade_srgb(0.35, 0.85, 0.80);
    case 3u: return shade_srgb(0.25, 0.52, 0.90);
    case 4u: return shade_srgb(0.80, 0.80, 0.78);
    case 5u: return shade_srgb(0.98, 0.72, 0.20);
    case 6u: return shade_srgb(0.90, 0.36, 0.20);
    case 7u: return shade_srgb(0.80, 0.20, 0.45);
    case 8u: return shade_srgb(0.60, 0.25, 0.70);
    default: return shade_srgb(0.45, 0.22, 0.65) * max(0.15, 1.0 - float(valence - 8u) / 32.0);
    }
}

// Regular white, boundary red, one-face corner green, extraordinary yellow to orange by valence.
vec3 shade_patch_color(uint tag) {
    uint valence = tag >> TAG_VALENCE_SHIFT;
    bool boundary = (tag & TAG_BOUNDARY) != 0u;
    if ((tag & KIND_MASK) == KIND_REGULAR) {
        if (!boundary) {
            return shade_srgb(0.86, 0.86, 0.84);
        }
        return valence == 2u ? shade_srgb(0.35, 0.75, 0.40) : shade_srgb(0.85, 0.33, 0.30);
    }
    if (boundary) {
        return shade_srgb(0.62, 0.20, 0.45);
    }
    if (valence < 4u) {
        return shade_srgb(0.98, 0.90, 0.30);
    }
    float heat = clamp((float(valence) - 5.0) / 8.0, 0.0, 1.0);
    return mix(shade_srgb(0.99, 0.75, 0.22), shade_srgb(0.82, 0.30, 0.08), heat);
}

#endif
