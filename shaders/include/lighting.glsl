// Lights for a porcelain-like surface, fixed to the camera. Vectors in view space: n the normal on the side that is seen, v the direction to the eye.
// Linear RGB.
#ifndef LIGHTING_GLSL
#define LIGHTING_GLSL
#include "unit.glsl"

float shade_fourth_power(float x) {
    float squared = x * x;
    return squared * squared;
}

float shade_fifth_power(float x) {
    return x * shade_fourth_power(x);
}

// Diffuse light that reaches a little around the edge of shadow, as in a material that scatters: 1 towards the light, 0 where the cosine is -wrap.
float shade_wrapped(float cosine, float wrap) {
    float x = max((cosine + wrap) / (1.0 + wrap), 0.0);
    return x * x * (3.0 - wrap - (2.0 - wrap) * x);
}

// Highlight of a glossy coat of the given sharpness (Blinn 1977), with Schlick's rise towards grazing angles.
float shade_gloss(vec3 n, vec3 l, vec3 v, float sharpness) {
    vec3 h = shade_unit_or_zero(l + v);
    float fresnel = 0.04 + 0.96 * shade_fifth_power(1.0 - clamp(dot(h, v), 0.0, 1.0));
    return fresnel * (sharpness + 8.0) / 25.0 * pow(max(dot(n, h), 0.0), sharpness) * max(dot(n, l), 0.0);
}

// Three lights (a warm key from the upper left, a cool fill, a light from behind for the outline) over a sky and a ground.
vec3 shade_lit(vec3 albedo, vec3 n, vec3 v) {
    const vec3 key = normalize(vec3(-0.55, 0.70, 0.50));
    const vec3 fill = normalize(vec3(0.90, 0.05, 0.45));
    const vec3 behind = normalize(vec3(0.55, 0.45, -0.70));
    vec3 around = mix(vec3(0.120, 0.095, 0.080), vec3(0.215, 0.245, 0.300), smoothstep(-1.0, 1.0, n.y));
    vec3 diffuse = around
        + vec3(1.02, 0.95, 0.85) * 0.92 * shade_wrapped(dot(n, key), 0.25)
        + vec3(0.62, 0.76, 1.00) * 0.13 * shade_wrapped(dot(n, fill), 0.30);
    float grazing = shade_fourth_power(1.0 - clamp(dot(n, v), 0.0, 1.0));
    vec3 outline = vec3(0.80, 0.90, 1.00) * 0.42 * grazing * smoothstep(-0.35, 0.45, dot(n, behind));
    float gloss = shade_gloss(n, key, v, 60.0) + 0.35 * shade_gloss(n, fill, v, 30.0);
    return albedo * diffuse + outline + vec3(gloss);
}

// A soft headlight: colours that mean something are shown as they are where the surface faces the eye.
vec3 shade_flat(vec3 albedo, vec3 n, vec3 v) {
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float side = 0.08 * n.y * (1.0 - facing);
    return albedo * (0.30 + 0.70 * facing + side);
}

#endif
