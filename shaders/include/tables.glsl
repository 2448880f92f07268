// The tables of one refinement level (report, section 3.1): offset and valence pairs, and indices of points.
#ifndef TABLES_GLSL
#define TABLES_GLSL
#include "bindings.glsl"

layout(set = 0, binding = BINDING_SPANS) uniform usamplerBuffer spans;
layout(set = 0, binding = BINDING_INDICES) uniform usamplerBuffer indices;

uvec2 span_of(uint row) {
    return texelFetch(spans, int(row)).xy;
}

uint index_at(uint i) {
    return texelFetch(indices, int(i)).x;
}

#endif
