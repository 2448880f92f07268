// Records that come from a regular patch: its 16-point net, and which corner or side of it.
#ifndef REGULAR_SOURCES_GLSL
#define REGULAR_SOURCES_GLSL
#include "bindings.glsl"
#include "nets.glsl"
#include "points.glsl"

// Patch number in the regular list, times 4, plus the corner or side. The regular list is the first, so its nets begin at 0.
layout(set = 0, binding = BINDING_REGULAR_SOURCES) uniform usamplerBuffer regular_sources;

uint regular_source(uint i) {
    return texelFetch(regular_sources, int(i)).x;
}

vec3 regular_net_point(uint patch_id, uint i) {
    return load_point(net_index(16u * patch_id + i));
}

#endif
