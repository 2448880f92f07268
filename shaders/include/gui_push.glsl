// What the stages of the interface need beside vertices and texture.
#ifndef GUI_PUSH_GLSL
#define GUI_PUSH_GLSL

layout(push_constant) uniform GuiPush {
    // Width and height of the window in points.
    vec2 size;
    // 1 if the target encodes colours itself.
    uint target_encodes;
} gui;

#endif
