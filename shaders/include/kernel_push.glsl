// What a kernel over elements 0 .. count-1 of one kind needs.
#ifndef KERNEL_PUSH_GLSL
#define KERNEL_PUSH_GLSL

layout(push_constant) uniform KernelPush {
    // Elements to compute.
    uint count;
    // Index of the first element written, in the buffer that the kernel writes.
    uint first;
    // vertex.comp: distance from an old point to its new point in Points, F + E + V of the report.
    uint old_distance;
} kernel;

#endif
