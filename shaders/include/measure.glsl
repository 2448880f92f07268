// What the evaluation stage measures for the shade of the picture. For shading alone: no bits are promised.
#ifndef MEASURE_GLSL
#define MEASURE_GLSL
#include "frame.glsl"
#include "palette.glsl"
#include "forms/form.glsl"
#ifdef MAPPED
#include "attributes.glsl"
#endif

// A step along `direction` from the point at `clip`, in pixels of the picture.
vec2 shade_pixels(vec4 clip, vec3 direction) {
    vec4 d = frame.clip_from_cage * vec4(direction, 0.0);
    return 0.5 * frame.viewport * (d.xy * clip.w - clip.xy * d.w) / (clip.w * clip.w);
}

// Width in pixels of a triangle with legs `du` and `dv`: its height over the longer one.
float shade_triangle_width(vec2 du, vec2 dv) {
    float longer = max(length(du), length(dv));
    return longer > 0.0 ? abs(du.x * dv.y - du.y * dv.x) / longer : 0.0;
}

// Where curvature is asked for: a fifth of a segment inside a corner, for at an irregular vertex it has no limit, or not the same from all sides.
vec2 shade_off_corner(vec2 uv, vec2 segments) {
    vec2 inside = 0.2 / max(segments, vec2(1.0));
    return corner_of(uv) != 4u ? clamp(uv, inside, 1.0 - inside) : uv;
}

// Whether the shade measures what follows from the whole patch, its formula or how it is divided, on its border too.
bool shade_measures_patch() {
    return SHADE == SHADE_CURVATURE || SHADE == SHADE_GAUSSIAN || SHADE == SHADE_WIREFRAME || SHADE == SHADE_FACTORS;
}

// What the other shades measure, which follows from the place alone. Textured: texture coordinates. None: (u,v). Others: what patches are outlined by.
vec2 shade_place(uint id, vec2 uv) {
#ifdef MAPPED
    if (SHADE == SHADE_TEXTURED || SHADE == SHADE_UV) {
        return patch_uv_at(id, uv);
    }
#endif
    return SHADE == SHADE_NONE ? uv : shade_outline(uv);
}

// Curvature: (mean, Gaussian). Wireframe: width of the triangles in pixels. Factors: what patches are outlined by, with the segments across the patch.
vec2 shade_measure(uint id, vec2 uv, InnerPoint p, vec2 segments) {
    if (SHADE == SHADE_CURVATURE || SHADE == SHADE_GAUSSIAN) {
        return shade_curvature(id, shade_off_corner(uv, segments));
    }
    if (SHADE == SHADE_WIREFRAME) {
        vec4 clip = clip_position(p.position);
        vec2 step = 1.0 / max(segments, vec2(1.0));
        return vec2(shade_triangle_width(shade_pixels(clip, p.du * step.x), shade_pixels(clip, p.dv * step.y)), 0.0);
    }
    if (SHADE == SHADE_FACTORS) {
        return shade_outline(uv) + vec2(shade_pack_factor(shade_segments(segments)), 0.0);
    }
    return shade_place(id, uv);
}

#endif
