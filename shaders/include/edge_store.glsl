// Writing edge records.
#ifndef EDGE_STORE_GLSL
#define EDGE_STORE_GLSL
#include "bindings.glsl"
#include "constants.glsl"

layout(std430, set = 0, binding = BINDING_EDGE_RECORDS) writeonly buffer EdgeRecords { float edge_records[]; };

void store_edge_point(uint edge, uint i, vec3 p) {
    uint at = EDGE_RECORD_FLOATS * edge + 3u * i;
    edge_records[at] = p.x;
    edge_records[at + 1u] = p.y;
    edge_records[at + 2u] = p.z;
}

#endif
