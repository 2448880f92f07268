#version 460
#extension GL_GOOGLE_include_directive : require
// A fragment shader of a renderer that has never heard of subdivision: two lights, a fog, and paint by faces of the cage.
#include "material.glsl"

// The renderer's own descriptor set: what is the same for all it draws.
layout(set = 1, binding = 0) uniform Scene {
    // Towards the key light and the fill light, in the world.
    vec4 key;
    vec4 fill;
    // Eye in the world.
    vec4 eye;
    vec4 fog;
} scene;

// Of each instance.
layout(push_constant) uniform Paint { layout(offset = MATERIAL_PUSH_OFFSET) vec4 base; vec4 band; } paint;

// The face of the cage under each patch.
layout(set = 0, binding = BINDING_CALLER) readonly buffer Faces { uint face_of_patch[]; };

layout(location = 0) out vec4 color;

void main() {
    vec3 p = shade_world_position();
    vec3 n = gl_FrontFacing ? shade_world_normal() : -shade_world_normal();
    vec3 v = normalize(scene.eye.xyz - p);
    // Every third face wears the other colour, if any does.
    float worn = face_of_patch[patch_id] % 3u == 0u ? paint.band.a : 0.0;
    vec3 albedo = mix(paint.base.rgb, paint.band.rgb, worn);
    float key = max(dot(n, scene.key.xyz), 0.0);
    float fill = 0.5 + 0.5 * dot(n, scene.fill.xyz);
    float gloss = pow(max(dot(n, normalize(v + scene.key.xyz)), 0.0), 60.0);
    float rim = pow(1.0 - max(dot(n, v), 0.0), 4.0);
    vec3 lit = albedo * (1.1 * key + 0.28 * fill) + 0.5 * gloss * key + 0.18 * rim * scene.fog.rgb;
    float fog = 1.0 - exp(-scene.fog.w * length(scene.eye.xyz - p));
    color = vec4(mix(lit, scene.fog.rgb, fog), 1.0);
}
