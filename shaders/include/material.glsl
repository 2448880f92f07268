// What a fragment shader from elsewhere gets of a surface: the interface of osculate::Material.
//
//   #version 460
//   #extension GL_GOOGLE_include_directive : require
//   #include "material.glsl"
//   layout(location = 0) out vec4 color;
//   void main() { color = vec4(0.5 + 0.5 * shade_world_normal(), 1.0); }
//
// Compile it with `glslc -I shaders/include --target-env=vulkan1.3`, or let a compiler's include callback ask osculate::shader_include. Its own resources:
// descriptor set 1 as it likes; set 0 from BINDING_CALLER on, given by InstanceDesc::bindings; push constants from byte MATERIAL_PUSH_OFFSET on, given by
// InstanceDesc::push; specialization constants from 16 on keep their defaults. Buffers and images of set 0 are readonly. The fields of `frame` are
// described where it is declared; the view is the instance's.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "frame.glsl"
#include "unit.glsl"

// In cage space: relative to the centre of the cage's box, scaled by a power of two.
layout(location = 0) in vec3 position;
// Interpolated, so not quite a unit vector; zero where the surface has no tangent plane. Points outwards.
layout(location = 1) in vec3 normal;
// As MaterialDesc::varying says: parameters in the patch, texture coordinates, curvature.
layout(location = 2) in vec2 measure;
// Number of the patch, counted as Surface::plan counts: Surface::patch_faces says which face of the cage it lies on.
layout(location = 3) in flat uint patch_id;

// A normal under a linear map: cofactors are the inverse transpose but for a factor.
vec3 shade_map_normal(mat3 m, vec3 n) {
    return cross(m[1], m[2]) * n.x + cross(m[2], m[0]) * n.y + cross(m[0], m[1]) * n.z;
}

// Position in the world.
vec3 shade_world_position() {
    return (frame.world_from_cage * vec4(position, 1.0)).xyz;
}

// Unit normal in the world, on the outside of the surface.
vec3 shade_world_normal() {
    return shade_unit_or_zero(shade_map_normal(mat3(frame.world_from_cage), normal));
}

// Position in view space.
vec3 shade_view_position() {
    return (frame.view_from_cage * vec4(position, 1.0)).xyz;
}

// Unit normal in view space, on the side that is seen.
vec3 shade_view_normal() {
    vec3 n = shade_unit_or_zero(shade_map_normal(mat3(frame.view_from_cage), normal));
    return gl_FrontFacing ? n : -n;
}

#endif
