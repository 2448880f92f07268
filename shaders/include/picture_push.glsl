// Where a picture is shown.
#ifndef PICTURE_PUSH_GLSL
#define PICTURE_PUSH_GLSL

layout(push_constant) uniform PicturePush {
    // The target's texel under the picture's upper left one.
    uvec2 origin;
    // 1 if the target encodes colours itself.
    uint target_encodes;
} place;

#endif
