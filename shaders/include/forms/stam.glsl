// Exact patches of the limit surface beside an irregular vertex V: K coefficients in the eigenbasis of subdivision (report, section 4.2; Stam 1998).
// Derivation, layout of the table, twin: osculate_surface::stam.
#ifndef FORMS_STAM_GLSL
#define FORMS_STAM_GLSL
#include "forms/form.glsl"
#include "domains/quad.glsl"
#include "spokes.glsl"
#include "curvature.glsl"
#include "nets.glsl"

// Parts of a table: eigenvalues and coupling, then the eigenvalue of each mode over mu, padded to a multiple of four, then the functions.
#define STAM_LAMBDA 0u
#define STAM_MU 1u
#define STAM_MU_OVER_LAMBDA 2u
#define STAM_COUPLING 3u
#define STAM_RATIOS 4u

// First function of a table with so many modes.
uint stam_functions(uint table, uint modes) {
    return table + STAM_RATIOS + ((modes + 3u) & ~3u);
}

// Level, sub-patch and parameters in it of a point: after `level` steps and one more it lies in a regular sub-patch.
struct StamPlace {
    uint level;
    // 0: u >= 1/2 > v, 1: both >= 1/2, 2: v >= 1/2 > u, of the patch scaled by 2^level.
    uint sub_patch;
    vec2 uv;
    // 2^(level + 1): by how much derivatives over the patch are larger.
    float scale;
};

// False at V. Scaling by powers of two and subtracting 1 is exact.
bool stam_place(vec2 uv, out StamPlace place) {
    float largest = max(uv.x, uv.y);
    // The exponent of 1/2, biased, is 126; 1 belongs to level 0 too.
    uint level = 126u - min(floatBitsToUint(largest) >> 23u, 126u);
    float scale = uintBitsToFloat((level + 128u) << 23u);
    precise vec2 at = uv * scale;
    precise vec2 less = at - 1.0;
    bool right = at.x >= 1.0;
    bool above = at.y >= 1.0;
    place = StamPlace(level, above ? (right ? 1u : 2u) : 0u, vec2(above && !right ? at.x : less.x, above ? less.y : at.y), scale);
    return largest >= SMALLEST_NORMAL;
}

// x^m for m < 128; exact for m = 0, also at x = 0.
float stam_power(float x, uint m) {
    precise float result = 1.0;
    precise float square = x;
    for (uint bit = 0u; bit < 7u; ++bit) {
        result = ((m >> bit) & 1u) == 1u ? result * square : result;
        square = square * square;
    }
    return result;
}

// The coefficient `c` of a mode from 2 on, at a level, over mu^level. `coupled` is the coefficient of mode 3, which mode 2 may receive from.
vec3 stam_weighted(uint table, uint mode, uint level, vec3 c, vec3 coupled) {
    precise vec3 sum = c;
    if (mode == 2u) {
        sum = sum + (weight_at(table + STAM_COUPLING) * float(level)) * coupled;
    }
    precise vec3 r = stam_power(weight_at(table + STAM_RATIOS + mode), level) * sum;
    return r;
}

// Puts the parts together: p0 + lambda^m (value of mode 1) p1 + mu^m (the others).
vec3 stam_offset(uint table, uint level, vec4 at, vec3 dominant) {
    precise vec3 r =
        (stam_power(weight_at(table + STAM_LAMBDA), level) * at.w) * dominant + stam_power(weight_at(table + STAM_MU), level) * at.xyz;
    return r;
}

// Along the cross product of the derivatives du and dv of both parts: that of the dominant coefficient with itself, zero but for rounding, is left out.
vec3 stam_plane(uint table, uint level, vec4 du, vec4 dv, vec3 dominant) {
    precise vec3 mixed = cross_product(dominant, du.w * dv.xyz - dv.w * du.xyz);
    precise vec3 r = mixed + stam_power(weight_at(table + STAM_MU_OVER_LAMBDA), level) * cross_product(du.xyz, dv.xyz);
    return r;
}

vec4 stam_combine4(vec4 w, vec4 a, vec4 b, vec4 c, vec4 d) {
    precise vec4 r = ((w.x * a + w.y * b) + w.z * c) + w.w * d;
    return r;
}

vec4 stam_combine_differences(vec3 w, vec4 a, vec4 b, vec4 c, vec4 d) {
    precise vec4 r = (w.x * (b - a) + w.y * (c - b)) + w.z * (d - c);
    return r;
}

// Weights of this patch's eigenbasis: the table follows the projection, a square matrix.
uint stam_table(uint id) {
    uint modes = patch_basis(id).net_size;
    return patch_basis(id).basis + modes * modes;
}

// Bezier points of the sub-patch: the function of mode 1 (w), the sum of the others over mu^level (xyz).
void stam_grid(uint table, uint modes, StamPlace place, out vec4 grid[16]) {
    precise vec4 sum[16];
    for (int i = 0; i < 16; ++i) {
        sum[i] = vec4(0.0);
    }
    uint first = stam_functions(table, modes) + 16u * modes * place.sub_patch;
    vec3 coupled = control(3u);
    for (uint mode = modes; mode-- > 2u;) {
        vec4 c = vec4(stam_weighted(table, mode, place.level, control(mode), coupled), 0.0);
        for (uint i = 0u; i < 16u; ++i) {
            sum[i] = sum[i] + weight_at(first + 16u * mode + i) * c;
        }
    }
    for (uint i = 0u; i < 16u; ++i) {
        grid[i] = vec4(sum[i].xyz, weight_at(first + 16u + i));
    }
}

InnerPoint inner_point(uint id, vec2 uv) {
    uint modes = patch_basis(id).net_size;
    uint table = stam_table(id);
    StamPlace place;
    bool exists = stam_place(uv, place);
    vec4 grid[16];
    stam_grid(table, modes, place, grid);
    vec4 bu = bernstein3(place.uv.x);
    vec4 bv = bernstein3(place.uv.y);
    vec3 qu = bernstein2(place.uv.x);
    vec3 qv = bernstein2(place.uv.y);
    vec4 row[4];
    vec4 slope[4];
    for (int j = 0; j < 4; ++j) {
        row[j] = stam_combine4(bu, grid[4 * j], grid[4 * j + 1], grid[4 * j + 2], grid[4 * j + 3]);
        slope[j] = stam_combine_differences(qu, grid[4 * j], grid[4 * j + 1], grid[4 * j + 2], grid[4 * j + 3]);
    }
    vec4 du = stam_combine4(bv, slope[0], slope[1], slope[2], slope[3]);
    vec4 dv = stam_combine_differences(qv, row[0], row[1], row[2], row[3]);
    vec3 dominant = control(1u);
    precise InnerPoint r;
    r.position = control(0u) + stam_offset(table, place.level, stam_combine4(bv, row[0], row[1], row[2], row[3]), dominant);
    r.du = (3.0 * place.scale) * stam_offset(table, place.level, du, dominant);
    r.dv = (3.0 * place.scale) * stam_offset(table, place.level, dv, dominant);
    r.plane = stam_plane(table, place.level, du, dv, dominant);
    if (!exists) {
        r = InnerPoint(control(0u), vec3(0.0), vec3(0.0), vec3(0.0));
    }
    return r;
}

// Curvature does not depend on the parameters, so the sub-patch's own serve.
vec2 shade_curvature(uint id, vec2 uv) {
    uint table = stam_table(id);
    StamPlace place;
    if (!stam_place(uv, place)) {
        return vec2(0.0);
    }
    vec4 grid[16];
    stam_grid(table, patch_basis(id).net_size, place, grid);
    vec3 b[16];
    for (int i = 0; i < 16; ++i) {
        b[i] = stam_offset(table, place.level, grid[i], control(1u));
    }
    return shade_bicubic_curvature(b, place.uv);
}

// The point of a spoke at t.
SurfacePoint stam_spoke_point(SpokeRecord spoke, float t) {
    StamPlace place;
    if (!stam_place(vec2(t, 0.0), place)) {
        return SurfacePoint(stored_vector(spoke.vectors), vec3(0.0));
    }
    precise vec4 sum[8];
    for (int i = 0; i < 8; ++i) {
        sum[i] = vec4(0.0);
    }
    uint first = stam_functions(spoke.table, spoke.modes);
    vec3 coupled = stored_vector(spoke.vectors + 3u);
    for (uint mode = spoke.modes; mode-- > 2u;) {
        vec4 c = vec4(stam_weighted(spoke.table, mode, place.level, stored_vector(spoke.vectors + mode), coupled), 0.0);
        for (uint i = 0u; i < 8u; ++i) {
            sum[i] = sum[i] + weight_at(first + 8u * mode + i) * c;
        }
    }
    vec4 p[8];
    for (uint i = 0u; i < 8u; ++i) {
        p[i] = vec4(sum[i].xyz, weight_at(first + 8u + i));
    }
    vec4 b = bernstein3(place.uv.x);
    vec3 dominant = stored_vector(spoke.vectors + 1u);
    vec4 tangent = stam_combine_differences(bernstein2(place.uv.x), p[0], p[1], p[2], p[3]);
    vec4 across = stam_combine4(b, p[4], p[5], p[6], p[7]);
    vec3 offset = stam_offset(spoke.table, place.level, stam_combine4(b, p[0], p[1], p[2], p[3]), dominant);
    precise vec3 position = stored_vector(spoke.vectors) + offset;
    return SurfacePoint(position, unit_or_zero(stam_plane(spoke.table, place.level, tangent, across, dominant)));
}

SurfacePoint side_point(uint id, uint side, vec2 uv) {
    return is_spoke(side) ? stam_spoke_point(spoke_of(id, side), spoke_parameter(side, uv)) : cubic_side_point(id, side, uv);
}

#endif
