// Writing vertex records.
#ifndef VERTEX_STORE_GLSL
#define VERTEX_STORE_GLSL
#include "bindings.glsl"
#include "constants.glsl"
#include "vector.glsl"

layout(std430, set = 0, binding = BINDING_VERTEX_RECORDS) writeonly buffer VertexRecords { float vertex_records[]; };

// Limit position and the unit normal of the plane of two tangents (zero where they span none).
void store_vertex(uint vertex, vec3 position, vec3 tangent1, vec3 tangent2) {
    vec3 normal = unit_or_zero(cross_product(tangent1, tangent2));
    uint at = VERTEX_RECORD_FLOATS * vertex;
    vertex_records[at] = position.x;
    vertex_records[at + 1u] = position.y;
    vertex_records[at + 2u] = position.z;
    vertex_records[at + 3u] = normal.x;
    vertex_records[at + 4u] = normal.y;
    vertex_records[at + 5u] = normal.z;
}

#endif
