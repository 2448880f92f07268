// Where a general record or a coefficient patch comes from: a matrix of weights times a net.
#ifndef SOURCES_GLSL
#define SOURCES_GLSL
#include "bindings.glsl"
#include "nets.glsl"
#include "points.glsl"

struct MatrixSource {
    // First index of the net in Nets.
    uint net;
    // First weight of the matrix in Weights, row-major.
    uint weights;
    // Points of the net, columns of the matrix.
    uint columns;
};

layout(std430, set = 0, binding = BINDING_SOURCES) readonly buffer Sources { MatrixSource sources[]; };

// Row `row` of the source's matrix times its net, summed from the last point to the first: the vertex in the middle comes first in a net and weighs
// most, and the many light points of a high valence would lose bits if they were added to it one by one.
vec3 matrix_row(MatrixSource source, uint row) {
    precise vec3 sum = vec3(0.0);
    for (uint i = source.columns; i-- > 0u;) {
        sum = sum + weight_at(source.weights + row * source.columns + i) * load_point(net_index(source.net + i));
    }
    return sum;
}

#endif
