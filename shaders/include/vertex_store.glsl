// Writing vertex records.
#ifndef VERTEX_STORE_GLSL
#define VERTEX_STORE_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "bindings.glsl"
#include "constants.glsl"
#include "vector.glsl"

layout(scalar, set = 0, binding = BINDING_VERTEX_RECORDS) writeonly buffer VertexRecords { vec3 vertex_records[]; };

// Limit position and the unit normal of the plane of two tangents (zero where they span none).
void store_vertex(uint vertex, vec3 position, vec3 tangent1, vec3 tangent2) {
    vec3 normal = unit_or_zero(cross_product(tangent1, tangent2));
    vertex_records[2u * vertex] = position;
    vertex_records[2u * vertex + 1u] = normal;
}

#endif
