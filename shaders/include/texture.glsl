// What the surface is painted with. For shading alone.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "attributes.glsl"

layout(set = 0, binding = BINDING_COLORS) uniform sampler2D colors;

// The colour of the surface at texture coordinates.
vec3 shade_texture(vec2 uv) {
    vec2 at = mapping.color_axes.xy * uv.x + mapping.color_axes.zw * uv.y + mapping.color_origin;
    return mapping.base_color.rgb * texture(colors, at).rgb;
}

// Squares, sixteen along a unit, that redden with u and green with v; where they are smaller than a pixel their mean.
vec3 shade_checker(vec2 uv) {
    vec2 place = 8.0 * uv;
    vec2 width = max(fwidth(place), vec2(1e-4));
    // The mean over a pixel of a wave that is 1 and -1 in turn.
    vec2 triangle = abs(fract(place + 0.5 * width) - 0.5) - abs(fract(place - 0.5 * width) - 0.5);
    vec2 wave = clamp(triangle / width, -1.0, 1.0);
    float light = 0.5 + 0.5 * wave.x * wave.y;
    vec2 part = fract(uv);
    vec3 tint = vec3(0.15 + 0.75 * part.x, 0.15 + 0.75 * part.y, 0.45);
    return tint * mix(0.35, 1.0, light);
}

#endif
