// A patch's net, and rows of weights times it. The stage defines net_point_at. Sums run from the last point to the first: the vertex in the middle comes
// first in a net and weighs most, and the many light points of a high valence would lose bits if they were added to it one by one.
#ifndef BASES_NET_GLSL
#define BASES_NET_GLSL
#include "nets.glsl"

// Point i of the net.
vec3 net_point_at(uint i);

// A row that gives a point.
vec3 weighted_row(uint row, uint net_size) {
    precise vec3 sum = vec3(0.0);
    for (uint i = net_size; i-- > 0u;) {
        sum = sum + weight_at(row + i) * net_point_at(i);
    }
    return sum;
}

// A row times the points less the first one, V.
vec3 weighted_differences(uint row, uint net_size) {
    vec3 origin = net_point_at(0u);
    precise vec3 sum = vec3(0.0);
    for (uint i = net_size; i-- > 1u;) {
        sum = sum + weight_at(row + i) * (net_point_at(i) - origin);
    }
    return sum;
}

// The same with compensation (Kahan 1965): high valences need it.
vec3 projected_differences(uint row, uint net_size) {
    vec3 origin = net_point_at(0u);
    precise vec3 sum = vec3(0.0);
    precise vec3 lost = vec3(0.0);
    for (uint i = net_size; i-- > 1u;) {
        precise vec3 term = weight_at(row + i) * (net_point_at(i) - origin) - lost;
        precise vec3 next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    return sum;
}

#endif
