// Light for a clay-like surface: a key, a fill and a rim light fixed to the camera, over a sky and ground term. Linear RGB.
#ifndef LIGHTING_GLSL
#define LIGHTING_GLSL

// All vectors in view space: n the normal towards the eye, v the direction to the eye.
vec3 shade_lit(vec3 albedo, vec3 n, vec3 v) {
    const vec3 key = normalize(vec3(-0.45, 0.75, 0.60));
    const vec3 fill = normalize(vec3(0.85, 0.10, 0.45));
    const vec3 rim = normalize(vec3(0.30, 0.50, -0.80));
    vec3 sky = mix(vec3(0.10, 0.09, 0.085), vec3(0.22, 0.25, 0.30), 0.5 + 0.5 * n.y);
    vec3 light = sky + vec3(1.00, 0.95, 0.86) * 0.80 * max(dot(n, key), 0.0) + vec3(0.70, 0.80, 1.00) * 0.18 * max(dot(n, fill), 0.0);
    vec3 half_way = normalize(key + v);
    float gloss = 0.10 * pow(max(dot(n, half_way), 0.0), 42.0);
    float edge = pow(1.0 - max(dot(n, v), 0.0), 3.0);
    float back = 0.35 * edge * max(dot(n, rim) + 0.4, 0.0);
    return albedo * light + vec3(gloss) + vec3(0.85, 0.92, 1.00) * back * 0.5;
}

#endif
