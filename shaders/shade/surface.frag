#version 460
#extension GL_GOOGLE_include_directive : require
// Colours the surface by SHADE. With SEES_POSITION, SEES_PATCH its shade looks at more than normals: devices that keep triangles in memory, llvmpipe among
// them, put every input that a shader declares into each of them, whether it is read or not.
#include "frame.glsl"
#include "records.glsl"
#include "palette.glsl"
#include "lighting.glsl"
#include "mirror.glsl"
#ifdef MAPPED
#include "texture.glsl"
#endif

// In view space, but for normals that are shown as they are (shade_is_in_view).
layout(location = 1) in vec3 normal;
#ifdef SEES_POSITION
layout(location = 0) in vec3 position;
#else
const vec3 position = vec3(0.0);
#endif
#ifdef SEES_PATCH
// By shade: curvature, texture coordinates, segments, or (u,v) in the patch (shade_measure).
layout(location = 2) in vec2 measure;
layout(location = 3) in flat uint patch_id;
#else
const vec2 measure = vec2(0.0);
const uint patch_id = 0u;
#endif

layout(location = 0) out vec4 color;

// Outside and inside of the surface: only open surfaces show the inside.
const vec3 PORCELAIN = vec3(0.640, 0.605, 0.560);
const vec3 INSIDE = vec3(0.400, 0.500, 0.590);
// What is behind a hole: nothing else is as bright.
const vec3 LEAK = vec3(1.0, 0.0, 1.0);

// The unit normal on the side of the triangle that is seen. Interpolated normals of a coarse outline may look away from the eye: those are bent until they
// graze it. Where there is no tangent plane the surface faces the eye.
vec3 shade_normal(vec3 v) {
    vec3 n = gl_FrontFacing ? normal : -normal;
    n -= min(dot(n, v), 0.0) * v;
    return shade_unit_or(n, v);
}

// The shading of the peer's benchmark picture: one two-sided headlight, written without colour encoding.
vec3 shade_peer() {
    vec3 n = shade_unit_or_zero(normal);
    return vec3(0.80, 0.75, 0.70) * (0.15 + 0.85 * abs(dot(n, normalize(vec3(0.3, 0.4, 1.0)))));
}

// Thin dark lines where patches meet, a pixel wide on either side; none where patches are a few pixels large. `uv` is 0 or 1 there.
vec3 shade_outlined(vec3 rgb, vec2 uv) {
    vec2 pixel = fwidth(uv);
    vec2 line = 1.0 - smoothstep(0.35 * pixel, 1.35 * pixel, min(uv, 1.0 - uv));
    vec2 shown = line * (1.0 - smoothstep(0.07, 0.22, pixel));
    return rgb * (1.0 - 0.55 * max(shown.x, shown.y));
}

// A room striped by height and a little by side, mirrored in the surface: breaks of the tangent plane break stripes, breaks of curvature kink them.
vec3 shade_zebra(vec3 n, vec3 v) {
    vec3 r = reflect(-v, n);
    float phase = 2.1 * r.y + 0.7 * r.x;
    float stripe = shade_square_wave(phase, fwidth(phase), 0.5);
    vec3 rgb = mix(vec3(0.012, 0.014, 0.018), vec3(0.86, 0.86, 0.84), stripe);
    float grazing = shade_fourth_power(1.0 - clamp(dot(n, v), 0.0, 1.0));
    return rgb * (0.55 + 0.45 * dot(n, v)) + 0.06 * grazing;
}

// A tunnel of thin light tubes mirrored in dark lacquer.
vec3 shade_reflection(vec3 n, vec3 v) {
    vec3 lacquer = shade_lit(vec3(0.022, 0.050, 0.078), n, v);
    float light = shade_tubes((position - frame.view_from_cage[3].xyz) / frame.radius, reflect(-v, n));
    float fresnel = 0.55 + 0.45 * shade_fifth_power(1.0 - clamp(dot(n, v), 0.0, 1.0));
    return lacquer + vec3(0.96, 0.93, 0.86) * (light * fresnel);
}

// The factor, outlined by what is left of the sum.
vec3 shade_factors(vec3 n, vec3 v) {
    float factor = shade_packed_factor(measure.x);
    return shade_outlined(shade_flat(shade_factor_color(factor), n, v), measure - vec2(factor, 0.0));
}

void main() {
    vec3 v = shade_unit_or_zero(-position);
    vec3 n = shade_normal(v);
#ifdef SEES_PATCH
    uint tag = patch_basis(patch_id).tag;
#else
    const uint tag = 0u;
#endif
    vec3 rgb;
    switch (SHADE) {
    case SHADE_NORMALS: rgb = shade_decode(0.5 + 0.5 * shade_unit_or_zero(normal)); break;
    case SHADE_PATCHES: rgb = shade_outlined(shade_flat(shade_patch_color(tag), n, v), measure); break;
    case SHADE_VALENCE: rgb = shade_outlined(shade_flat(shade_valence_color(tag), n, v), measure); break;
    case SHADE_ZEBRA: rgb = shade_zebra(n, v); break;
    case SHADE_REFLECTION: rgb = shade_reflection(n, v); break;
    // The derivatives bend towards the normal where the surface is hollow, so a sphere has negative mean curvature.
    case SHADE_CURVATURE: rgb = shade_flat(shade_mean_color(-measure.x * frame.radius), n, v); break;
    case SHADE_GAUSSIAN: rgb = shade_flat(shade_gaussian_color(measure.y * frame.radius * frame.radius), n, v); break;
    case SHADE_DIFFERENCE: rgb = shade_flat(shade_difference_color(measure.x), n, v); break;
    case SHADE_FACTORS: rgb = shade_factors(n, v); break;
    case SHADE_PEER: rgb = shade_peer(); break;
#ifdef MAPPED
    case SHADE_TEXTURED: rgb = shade_lit(shade_texture(measure), n, v); break;
    case SHADE_UV: rgb = shade_flat(shade_checker(measure), n, v); break;
#endif
    case SHADE_LEAKS: rgb = gl_FrontFacing ? 0.5 * shade_lit(PORCELAIN, n, v) : LEAK; break;
    default: rgb = shade_lit(gl_FrontFacing ? PORCELAIN : INSIDE, n, v); break;
    }
    color = vec4(rgb, 1.0);
}
