// The part of a patch list that one draw renders; the same block in all stages of the patch pipelines.
#ifndef PATCH_PUSH_GLSL
#define PATCH_PUSH_GLSL

layout(push_constant) uniform PatchPush {
    // First index of the list's nets in Nets.
    uint net_offset;
    // Points of a net; 1 for lists that read coefficients.
    uint net_size;
    // Global id of the list's first patch.
    uint first_patch;
    // First weight of the list's change of basis in Weights.
    uint weights;
    // Sum of the negative weights of the control point with the largest one.
    float overshoot;
} list;

#endif
