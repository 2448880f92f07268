// Writing edge records.
#ifndef EDGE_STORE_GLSL
#define EDGE_STORE_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "bindings.glsl"
#include "constants.glsl"

layout(scalar, set = 0, binding = BINDING_EDGE_RECORDS) writeonly buffer EdgeRecords { vec3 edge_records[]; };

void store_edge_point(uint edge, uint i, vec3 p) {
    edge_records[EDGE_RECORD_POINTS * edge + i] = p;
}

#endif
