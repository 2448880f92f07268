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

// Row `row` of the source's matrix times its net, summed in net order.
vec3 matrix_row(MatrixSource source, uint row) {
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < source.columns; ++i) {
        sum = sum + weights[source.weights + row * source.columns + i] * load_point(nets[source.net + i]);
    }
    return sum;
}

#endif
