// Displacement: points move along their normal by a map of heights.
//
// What lies on an edge or a corner of patches is moved by what its edge record says alone: its texture coordinates, its tangents, and the level of the map, which
// follows from the record's tessellation factor. So both patches move it to the same bits, also where a seam of the texture coordinates runs between them. Heights
// are looked up by written-out arithmetic on texels, because the filters of devices round to a few bits.
//
// Heights are a biquadratic B-spline with the texels as coefficients, which has a continuous slope; normals follow from it as M. Niessner and C. Loop, Analytic
// displacement mapping using hardware tessellation, ACM Transactions on Graphics 32(3), 2013, leaving out, as J. Blinn, Simulation of wrinkled surfaces, 1978, what the
// height times the curvature of the surface adds.
#ifndef DISPLACEMENT_GLSL
#define DISPLACEMENT_GLSL
#include "attributes.glsl"
#include "edge_factor.glsl"
#include "forms/form.glsl"

layout(set = 0, binding = BINDING_HEIGHTS) uniform sampler2D heights;

// Height, and its derivatives by the map's coordinates.
struct Height {
    float value;
    vec2 slope;
};

// Tangents of the surface, and how texture coordinates change along them.
struct Chart {
    vec3 along;
    vec3 across;
    vec2 uv;
    vec2 uv_along;
    vec2 uv_across;
};

// From the domain: the reciprocals of the distances from the sides, zero for a side that is not there. For points inside.
vec4 side_nearness(vec2 uv);

uint wrap_of(uint axis) {
    return (mapping.height_wrap >> (WRAP_BITS * axis)) & ((1u << WRAP_BITS) - 1u);
}

// A coordinate of the map as one from 0 to 1, or to 2 where every second image is mirrored.
float wrapped_coordinate(float x, uint wrap) {
    precise float repeated = x - floor(x);
    precise float mirrored = x - 2.0 * floor(0.5 * x);
    return wrap == WRAP_REPEAT ? repeated : wrap == WRAP_MIRROR ? mirrored : clamp(x, 0.0, 1.0);
}

// The texel of a row of n that is seen at place i, which is at most two places beyond the image or its mirror image.
int wrapped_texel(int i, int n, uint wrap) {
    if (wrap == WRAP_REPEAT) {
        return (i + 2 * n) % n;
    }
    if (wrap == WRAP_MIRROR) {
        int place = (i + 4 * n) % (2 * n);
        return place < n ? place : 2 * n - 1 - place;
    }
    return clamp(i, 0, n - 1);
}

// The texel of a level at a place of it.
float texel_at(ivec2 place, ivec2 size, int level) {
    return texelFetch(heights, ivec2(wrapped_texel(place.x, size.x, wrap_of(0u)), wrapped_texel(place.y, size.y, wrap_of(1u))), level).r;
}

float combine3(vec3 w, float a, float b, float c) {
    precise float r = (w.x * a + w.y * b) + w.z * c;
    return r;
}

// What three texels in a row count for at a place in the middle one.
vec3 spline_weights(float f) {
    precise float g = 1.0 - f;
    precise vec3 r = vec3(0.5 * (g * g), 0.5 + f * g, 0.5 * (f * f));
    return r;
}

vec3 spline_slopes(float f) {
    precise vec3 r = vec3(f - 1.0, (1.0 - f) - f, f);
    return r;
}

// The spline of one level at a point of the map that is wrapped already.
Height height_in_level(vec2 at, int level) {
    // Not textureSize of the level: llvmpipe answers all lanes for the level of the first.
    ivec2 size = max(textureSize(heights, 0) >> level, ivec2(1));
    precise vec2 place = at * vec2(size);
    vec2 texel = floor(place);
    precise vec2 f = place - texel;
    vec3 weights_u = spline_weights(f.x);
    vec3 slopes_u = spline_slopes(f.x);
    vec3 sums;
    vec3 changes;
    for (int j = 0; j < 3; ++j) {
        ivec2 first = ivec2(texel) + ivec2(-1, j - 1);
        float a = texel_at(first, size, level);
        float b = texel_at(first + ivec2(1, 0), size, level);
        float c = texel_at(first + ivec2(2, 0), size, level);
        sums[j] = combine3(weights_u, a, b, c);
        changes[j] = combine3(slopes_u, a, b, c);
    }
    vec3 weights_v = spline_weights(f.y);
    float value = combine3(weights_v, sums.x, sums.y, sums.z);
    vec2 slope = vec2(combine3(weights_v, changes.x, changes.y, changes.z), combine3(spline_slopes(f.y), sums.x, sums.y, sums.z));
    precise vec2 scaled = slope * vec2(size);
    return Height(value, scaled);
}

// The height at a point of the map where so many texels of the finest level lie between vertices. Levels are blended by the linear part of the logarithm, which
// floats have at hand without rounding.
Height height_at(vec2 at, float texels) {
    vec2 wrapped = vec2(wrapped_coordinate(at.x, wrap_of(0u)), wrapped_coordinate(at.y, wrap_of(1u)));
    uint bits = floatBitsToUint(texels > 1.0 ? min(texels, 65536.0) : 1.0);
    int level = int(bits >> 23u) - 127;
    precise float blend = uintBitsToFloat((bits & 0x7fffffu) | 0x3f800000u) - 1.0;
    int last = int(mapping.height_levels) - 1;
    if (level >= last) {
        return height_in_level(wrapped, last);
    }
    Height fine = height_in_level(wrapped, level);
    if (blend == 0.0) {
        return fine;
    }
    Height coarse = height_in_level(wrapped, level + 1);
    precise float value = fine.value + blend * (coarse.value - fine.value);
    precise vec2 slope = fine.slope + blend * (coarse.slope - fine.slope);
    return Height(value, slope);
}

// A change of texture coordinates as one of the map's.
vec2 height_vector(vec2 v) {
    precise vec2 r = mapping.height_axes.xy * v.x + mapping.height_axes.zw * v.y;
    return r;
}

// Texels between vertices on an edge record.
float texels_of_edge(uint edge) {
    precise vec2 along = edge_uv[4u * edge + 1u] - edge_uv[4u * edge];
    precise vec2 d = height_vector(along) * vec2(textureSize(heights, 0));
    precise float texels = sqrt(d.x * d.x + d.y * d.y) / max(edge_factor(edge), 1.0);
    return texels;
}

// The same inside a patch: that of each side counts by its nearness, so that there is no step at the border.
float texels_inside(uint id, vec2 uv) {
    vec4 nearness = side_nearness(uv);
    precise float sum = 0.0;
    precise float total = 0.0;
    for (uint side = 0u; side < 4u; ++side) {
        if (nearness[side] > 0.0) {
            sum = sum + nearness[side] * texels_of_edge(patch_edge(id, side) >> 1u);
            total = total + nearness[side];
        }
    }
    precise float mean = sum / total;
    return mean;
}

// The point moved by its height. Flat maps leave the normal; others bend it by their slope along both tangents.
SurfacePoint displaced(SurfacePoint base, Chart chart, float texels) {
    precise vec2 at = height_vector(chart.uv) + mapping.height_origin;
    Height height = height_at(at, texels);
    vec2 map_along = height_vector(chart.uv_along);
    vec2 map_across = height_vector(chart.uv_across);
    precise float slope_along = mapping.height_scale * (height.slope.x * map_along.x + height.slope.y * map_along.y);
    precise float slope_across = mapping.height_scale * (height.slope.x * map_across.x + height.slope.y * map_across.y);
    precise vec3 position = base.position + (mapping.height_scale * height.value + mapping.height_bias) * base.normal;
    float area = sqrt(squared_length(cross_product(chart.along, chart.across)));
    precise vec3 bent = area * base.normal
        + (slope_across * cross_product(chart.along, base.normal) + slope_along * cross_product(base.normal, chart.across));
    return SurfacePoint(position, area > 0.0 ? unit_or_zero(bent) : base.normal);
}

// A point on an edge record, whichever formula it came from.
SurfacePoint displaced_on_edge(SurfacePoint base, uint edge, float t) {
    vec3 c0 = edge_record_point(edge, 0u);
    vec3 c1 = edge_record_point(edge, 1u);
    vec3 c2 = edge_record_point(edge, 2u);
    vec3 c3 = edge_record_point(edge, 3u);
    precise vec3 tangent = 3.0 * combine_differences(bernstein2(t), c0, c1, c2, c3);
    vec3 cross_field = combine4(bernstein3(t), edge_record_point(edge, 4u), edge_record_point(edge, 5u), edge_record_point(edge, 6u), edge_record_point(edge, 7u));
    vec2 from = edge_uv[4u * edge];
    vec2 to = edge_uv[4u * edge + 1u];
    precise float s = 1.0 - t;
    precise vec2 uv = s * from + t * to;
    precise vec2 along = to - from;
    precise vec2 across = s * edge_uv[4u * edge + 2u] + t * edge_uv[4u * edge + 3u];
    return displaced(base, Chart(tangent, cross_field, uv, along, across), texels_of_edge(edge));
}

// The point of a patch at (u,v), moved.
SurfacePoint displaced_point(uint id, vec2 uv, InnerPoint inner, SurfacePoint base) {
    if (mapping.height_scale == 0.0 && mapping.height_bias == 0.0) {
        return base;
    }
    uint side = side_of(uv);
    if (side == 4u) {
        vec2 along = patch_uv_sum(id, corner_weights_du(uv));
        vec2 across = patch_uv_sum(id, corner_weights_dv(uv));
        return displaced(base, Chart(inner.du, inner.dv, patch_uv_at(id, uv), along, across), texels_inside(id, uv));
    }
    uint corner = corner_of(uv);
    if (corner != 4u) {
        uint end = vertex_uv[patch_vertex(id, corner)];
        return displaced_on_edge(base, end >> 1u, float(end & 1u));
    }
    uint edge = patch_edge(id, side);
    return displaced_on_edge(base, edge >> 1u, edge_parameter(side, edge & 1u, uv));
}

#endif
