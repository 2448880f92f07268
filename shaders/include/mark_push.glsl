// How marks on the surface look.
#ifndef MARK_PUSH_GLSL
#define MARK_PUSH_GLSL

layout(push_constant) uniform MarkPush {
    // Linear, alpha not multiplied in.
    vec4 color;
    // Diameter of dots in pixels; length of normals in cage space.
    float size;
} mark;

#endif
