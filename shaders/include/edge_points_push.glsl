// What a kernel needs that writes the vertices along edges which are all divided alike.
#ifndef EDGE_POINTS_PUSH_GLSL
#define EDGE_POINTS_PUSH_GLSL

layout(push_constant) uniform EdgePointsPush {
    // Edges to write.
    uint count;
    // Record of the first of them.
    uint first_record;
    // Vertex number of the first vertex of record 0.
    uint first_vertex;
    // How they are divided (grid.glsl).
    uint rate;
} edges;

#endif
