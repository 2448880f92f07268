#version 460
#extension GL_GOOGLE_include_directive : require
// Colours the surface by Frame.shade. The normal is turned towards the eye, so open surfaces look the same from both sides.
#include "frame.glsl"
#include "records.glsl"
#include "palette.glsl"
#include "lighting.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 curvature;
layout(location = 3) in flat uint patch_id;

layout(location = 0) out vec4 color;

const vec3 CLAY = vec3(0.62, 0.58, 0.54);

// The shading of the peer's benchmark picture: one two-sided headlight, written without colour encoding.
vec3 shade_peer(vec3 n) {
    return vec3(0.80, 0.75, 0.70) * (0.15 + 0.85 * abs(dot(n, normalize(vec3(0.3, 0.4, 1.0)))));
}

// Stripes of a striped environment seen in the surface: breaks in the tangent plane break stripes, breaks in curvature kink them.
vec3 shade_zebra(vec3 n, vec3 v) {
    vec3 r = reflect(-v, n);
    float phase = 9.0 * atan(r.y, length(r.xz)) + 2.0 * atan(r.x, r.z + 1.5);
    float width = max(fwidth(phase), 1e-4);
    float stripe = clamp(0.5 + sin(phase * 2.0) / (2.0 * width), 0.0, 1.0);
    return mix(vec3(0.03), vec3(0.88), stripe) * (0.65 + 0.35 * max(dot(n, v), 0.0));
}

// Mean curvature: blue hollow, white flat, red bulging.
vec3 shade_curvature(float mean) {
    float x = mean * frame.curvature_length;
    x = x / sqrt(1.0 + x * x);
    vec3 hot = mix(vec3(0.82), vec3(0.70, 0.05, 0.04), max(x, 0.0));
    return mix(hot, vec3(0.03, 0.12, 0.60), max(-x, 0.0));
}

void main() {
    vec3 to_eye = frame.eye.xyz - position;
    bool away = dot(normal, to_eye) < 0.0;
    vec3 object_normal = normalize(away ? -normal : normal);
    vec3 n = mat3(frame.view_from_cage) * object_normal;
    n = normalize(n);
    vec3 v = normalize(mat3(frame.view_from_cage) * to_eye);
    uint tag = patches[patch_id].tag;
    vec3 rgb;
    switch (frame.shade) {
    case SHADE_NORMALS: rgb = pow(0.5 + 0.5 * normalize(normal), vec3(2.2)); break;
    case SHADE_PATCHES: rgb = shade_lit(shade_patch_color(tag), n, v); break;
    case SHADE_VALENCE: rgb = shade_lit(shade_valence_color(tag >> TAG_VALENCE_SHIFT), n, v); break;
    case SHADE_ZEBRA: rgb = shade_zebra(n, v); break;
    // Bending away from an outward normal is positive, as on a sphere.
    case SHADE_CURVATURE: rgb = shade_curvature(-curvature.x) * (0.45 + 0.55 * max(dot(n, v), 0.0)); break;
    case SHADE_PEER: rgb = shade_peer(n); break;
    default: rgb = shade_lit(CLAY, n, v); break;
    }
    color = vec4(rgb, 1.0);
}
