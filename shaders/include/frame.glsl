// What changes from frame to frame: camera and tessellation. And the shade, which does not: devices without branches per pixel, llvmpipe among them, would
// compute all shades and keep one.
#ifndef FRAME_GLSL
#define FRAME_GLSL
#include "bindings.glsl"
#include "constants.glsl"

layout(std140, set = 0, binding = BINDING_FRAME) uniform Frame {
    // Clip space from cage space (the cage's own frame: centred and scaled by a power of two).
    mat4 clip_from_cage;
    // View space from cage space.
    mat4 view_from_cage;
    // Eye in cage space; w unused.
    vec4 eye;
    // Eye that adaptive factors are chosen for, in cage space; w unused.
    vec4 factor_eye;
    // Uniform tessellation factor of a patch edge.
    float level;
    // Adaptive factors: segments of an edge of unit length at unit distance.
    float segments_per_length;
    // FACTORS_*
    uint factor_mode;
    // Half diagonal of the cage's box in cage space: the measure of curvatures and of what is mirrored.
    float radius;
    // Smallest distance from the eye that adaptive factors tell apart.
    float near;
    // Width and height of the picture in pixels.
    vec2 viewport;
    // Line colour of wireframe and cage overlay.
    vec4 line_color;
    // The view that patches are culled for: clip space from cage space, eye in cage space (w unused), picture in pixels.
    mat4 cull_clip_from_cage;
    vec4 cull_eye;
    vec2 cull_viewport;
    // Places per pixel along an axis where a sample can lie.
    float cull_samples;
    // CULL_*
    uint cull;
    // The caller's world from cage space, or the cage's own coordinates.
    mat4 world_from_cage;
} frame;

// SHADE_*
layout(constant_id = SPEC_SHADE) const uint SHADE = SHADE_NONE;

// 1 where fragments come from elsewhere (material.glsl), which may look at everything that the shade does not say.
layout(constant_id = SPEC_MATERIAL) const uint MATERIAL = 0;

// What fragments in this shade look at beside places. Stages before write nothing else: on devices that keep vertices in memory each output has its price.
bool shade_sees_measure() {
    return SHADE == SHADE_PATCHES || SHADE == SHADE_VALENCE || SHADE == SHADE_WIREFRAME || SHADE == SHADE_CURVATURE || SHADE == SHADE_GAUSSIAN
        || SHADE == SHADE_FACTORS || SHADE == SHADE_DIFFERENCE || SHADE == SHADE_TEXTURED || SHADE == SHADE_UV;
}

bool shade_sees_patch() {
    return MATERIAL != 0u || SHADE == SHADE_PATCHES || SHADE == SHADE_VALENCE;
}

// Whether fragments want places and normals in view space, where lights are. Stages before them give them so: a fragment would read every number of the matrix
// anew, and llvmpipe reads a uniform buffer lane by lane wherever lanes may be off, as in every fragment stage.
bool shade_is_in_view() {
    return MATERIAL == 0u && SHADE != SHADE_NONE && SHADE != SHADE_NORMALS;
}

// What fragments get of a position.
vec3 shade_place(vec3 position) {
    return shade_is_in_view() ? (frame.view_from_cage * vec4(position, 1.0)).xyz : position;
}

// What fragments get of a normal.
vec3 shade_direction(vec3 normal) {
    return shade_is_in_view() ? mat3(frame.view_from_cage) * normal : normal;
}

// The one clip-space transform: positions equal bit for bit stay equal.
vec4 clip_position(vec3 p) {
    mat4 m = frame.clip_from_cage;
    precise vec4 r = ((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3];
    return r;
}

#endif
