#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The coefficient buffer: control points of patches whose net does not go through a patch list (valence 2, above 12, extraordinary at a boundary), and spoke
// records. One thread per vector: a row of a matrix times the points of a net less its first point. Twin: osculate_subdiv::twin::coefficients.
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "bases/net.glsl"

struct ProjectionSource {
    // First index of the net in Nets.
    uint net;
    // First weight of the matrix in Weights, row-major.
    uint weights;
    // Points of the net, columns of the matrix.
    uint columns;
    // Rows that give points: the net's first point is added again.
    uint absolute_rows;
    // First vector; the vectors of a source end where those of the next begin.
    uint first;
};

layout(std430, set = 0, binding = BINDING_SOURCES) readonly buffer Sources { ProjectionSource sources[]; };
layout(scalar, set = 0, binding = BINDING_COEFFICIENTS) writeonly buffer Coefficients { vec3 coefficients[]; };

// First index of the net at hand.
uint net_at_hand;

vec3 net_point_at(uint i) {
    return load_point(net_index(net_at_hand + i));
}

// The last source whose first vector is not behind this one.
ProjectionSource source_of(uint vector) {
    uint low = 0u;
    uint high = uint(sources.length());
    while (high - low > 1u) {
        uint middle = (low + high) >> 1u;
        if (sources[middle].first <= vector) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return sources[low];
}

void main() {
    uint vector = thread_index();
    if (vector >= kernel.count) {
        return;
    }
    ProjectionSource source = source_of(vector);
    net_at_hand = source.net;
    uint row = vector - source.first;
    vec3 difference = projected_differences(source.weights + row * source.columns, source.columns);
    precise vec3 point = net_point_at(0u) + difference;
    coefficients[vector] = row < source.absolute_rows ? point : difference;
}
