// The tables of one refinement level (report, section 3.1): offset and valence pairs, and indices of points.
#ifndef TABLES_GLSL
#define TABLES_GLSL
#include "bindings.glsl"

layout(std430, set = 0, binding = BINDING_SPANS) readonly buffer Spans { uvec2 spans[]; };
layout(std430, set = 0, binding = BINDING_INDICES) readonly buffer Indices { uint indices[]; };

#endif
