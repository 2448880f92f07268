// One thread per element: the index of this thread in a dispatch of at most GROUPS_X workgroups along x, folded into y.
#ifndef THREAD_GLSL
#define THREAD_GLSL
#include "constants.glsl"

layout(local_size_x = GROUP_SIZE) in;

uint thread_index() {
    return gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (GROUPS_X * GROUP_SIZE);
}

#endif
