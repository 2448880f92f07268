// Nets (indices of points) and weights of changes of basis.
#ifndef NETS_GLSL
#define NETS_GLSL
#include "bindings.glsl"

layout(std430, set = 0, binding = BINDING_NETS) readonly buffer Nets { uint nets[]; };
layout(std430, set = 0, binding = BINDING_WEIGHTS) readonly buffer Weights { float weights[]; };

#endif
