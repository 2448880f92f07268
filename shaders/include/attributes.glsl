// Texture coordinates: of patches, for what is inside them and for shading; of edge records, for what patches share. Made by osculate_subdiv::UvTables.
#ifndef ATTRIBUTES_GLSL
#define ATTRIBUTES_GLSL
#include "bindings.glsl"
#include "constants.glsl"

// Of the corners of each patch, four each.
layout(std430, set = 0, binding = BINDING_PATCH_UV) readonly buffer PatchUv { vec2 patch_uv[]; };
// Of each edge record: where it begins, where it ends, and their change per unit of the cross field, there and there.
layout(std430, set = 0, binding = BINDING_EDGE_UV) readonly buffer EdgeUv { vec2 edge_uv[]; };
// For each vertex record twice the number of an edge record with that end, plus one if it ends there.
layout(std430, set = 0, binding = BINDING_VERTEX_UV) readonly buffer VertexUv { uint vertex_uv[]; };

// How texture coordinates are looked up.
layout(std140, set = 0, binding = BINDING_MAPPING) uniform Mapping {
    // From texture coordinates to those of the heights: the columns of a matrix, and the image of the origin.
    vec4 height_axes;
    vec2 height_origin;
    // Displacement in cage space: scale * height + bias.
    float height_scale;
    float height_bias;
    // From texture coordinates to those of the colours.
    vec4 color_axes;
    vec2 color_origin;
    // WRAP_*: in u, and in v from bit WRAP_BITS.
    uint height_wrap;
    // Levels of the heights.
    uint height_levels;
    // Linear; multiplied with the colours.
    vec4 base_color;
} mapping;

// From the domain: what a patch's corners count for at (u,v), and the derivatives of that.
vec4 corner_weights(vec2 uv);
vec4 corner_weights_du(vec2 uv);
vec4 corner_weights_dv(vec2 uv);

// The sum of the texture coordinates of a patch's corners with these weights.
vec2 patch_uv_sum(uint id, vec4 weights) {
    uint at = 4u * id;
    precise vec2 r = ((weights.x * patch_uv[at] + weights.y * patch_uv[at + 1u]) + weights.z * patch_uv[at + 2u]) + weights.w * patch_uv[at + 3u];
    return r;
}

// The patch's own texture coordinates at (u,v).
vec2 patch_uv_at(uint id, vec2 uv) {
    return patch_uv_sum(id, corner_weights(uv));
}

#endif
