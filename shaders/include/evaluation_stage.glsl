// Interface of the tessellation evaluation stages. SPACING is the layout's spacing; with CAPTURE the outputs go to transform feedback.
#ifndef EVALUATION_STAGE_GLSL
#define EVALUATION_STAGE_GLSL
#include "frame.glsl"
#include "records.glsl"
#include "measure.glsl"

// Vulkan looks at the domain with v pointing down, so what it calls clockwise is counter-clockwise in (u,v).
layout(quads, SPACING, cw) in;

layout(location = 1) patch in uint patch_id;

#ifdef CAPTURE
layout(location = 0, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 0) out vec3 out_position;
layout(location = 1, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 12) out vec3 out_normal;
layout(location = 2, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 24) out vec2 out_uv;
layout(location = 3, xfb_buffer = 0, xfb_stride = 36, xfb_offset = 32) out flat uint out_patch;
#else
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_measure;
layout(location = 3) out flat uint out_patch;
#endif

// Writes the vertex at (u,v) of the patch whose bicubic form there is `b`.
void write_vertex(vec3 b[16]) {
    vec2 uv = gl_TessCoord.xy;
    PatchPoint inner = bicubic_point(b, uv);
    SurfacePoint point = surface_point(patch_id, uv, inner);
    gl_Position = clip_position(point.position);
    out_position = point.position;
    out_normal = point.normal;
    out_patch = patch_id;
#ifdef CAPTURE
    out_uv = uv;
#else
    out_measure = shade_measure(b, uv, inner, vec2(gl_TessLevelInner[0], gl_TessLevelInner[1]));
#endif
}

#endif
