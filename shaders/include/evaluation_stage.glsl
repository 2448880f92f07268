// Interface of the tessellation evaluation stages: a stage includes this, its form, and says where control points come from. SPACING is the layout's spacing, DOMAIN its domain if not quads; with CAPTURE the outputs go to transform feedback, else there are those that SEES_POSITION, SEES_PATCH name; with MAPPED the surface has texture coordinates.
#ifndef EVALUATION_STAGE_GLSL
#define EVALUATION_STAGE_GLSL
#define SIDES_IN_SEGMENTS
#include "frame.glsl"
#include "forms/form.glsl"
#include "measure.glsl"
#ifdef MAPPED
#include "displacement.glsl"
#endif

#ifndef DOMAIN
#define DOMAIN quads
#endif

// Vulkan looks at the domain with v pointing down, so what it calls clockwise is counter-clockwise in (u,v).
layout(DOMAIN, SPACING, cw) in;

layout(location = 1) patch in uint patch_id;

#ifdef CAPTURE
layout(location = 0, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 0) out vec3 out_position;
layout(location = 1, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 12) out vec3 out_normal;
layout(location = 2, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 24) out vec2 out_uv;
layout(location = 3, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 32) out flat uint out_patch;
#else
layout(location = 1) out vec3 out_normal;
#endif
#ifdef SEES_POSITION
layout(location = 0) out vec3 out_position;
#endif
#ifdef SEES_PATCH
layout(location = 2) out vec2 out_measure;
layout(location = 3) out flat uint out_patch;
#endif

uint refined_segments() {
    return uint(ceil(frame.level));
}

float whole_edge_parameter(uint i, uint segments) {
    precise float t = float(i) / float(segments);
    return t;
}

// Writes the vertex at the tessellation coordinates.
void write_vertex() {
    vec2 uv = gl_TessCoord.xy;
    InnerPoint inner = inner_point(patch_id, uv);
    SurfacePoint point = surface_point(patch_id, uv, inner);
#ifdef MAPPED
    point = displaced_point(patch_id, uv, inner, point);
#endif
    gl_Position = clip_position(point.position);
#ifdef CAPTURE
    out_normal = point.normal;
    out_position = point.position;
    out_uv = uv;
    out_patch = patch_id;
#else
    out_normal = shade_direction(point.normal);
#endif
#ifdef SEES_POSITION
    out_position = shade_place(point.position);
#endif
#ifdef SEES_PATCH
    if (shade_sees_measure()) {
        out_measure = shade_measure(patch_id, uv, inner, vec2(gl_TessLevelInner[0], gl_TessLevelInner[1]));
    }
    if (shade_sees_patch()) {
        out_patch = patch_id;
    }
#endif
}

#endif
