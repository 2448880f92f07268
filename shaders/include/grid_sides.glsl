// How edges of unrefined faces are divided in the compute evaluator (side_parameter.glsl): by the table of parameters, so that kernels which follow the edge find
// the same ones as those which follow a patch.
#ifndef GRID_SIDES_GLSL
#define GRID_SIDES_GLSL
#include "frame.glsl"
#include "grid.glsl"

uint refined_segments() {
    return uint(ceil(frame.level));
}

float whole_edge_parameter(uint i, uint segments) {
    return texelFetch(grid_parameters, int(GRID_WHOLE_PARAMETERS + i)).x;
}

#endif
