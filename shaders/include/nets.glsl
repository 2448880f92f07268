// Nets (indices of points) and weights of changes of basis.
#ifndef NETS_GLSL
#define NETS_GLSL
#include "bindings.glsl"

layout(set = 0, binding = BINDING_NETS) uniform usamplerBuffer nets;
layout(set = 0, binding = BINDING_WEIGHTS) uniform samplerBuffer weights;

uint net_index(uint i) {
    return texelFetch(nets, int(i)).x;
}

float weight_at(uint i) {
    return texelFetch(weights, int(i)).x;
}

#endif
