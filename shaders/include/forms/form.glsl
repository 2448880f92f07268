// What every form of patch defines, for the stage that evaluates it, and what it asks of the stage. A form includes its domain.
#ifndef FORM_GLSL
#define FORM_GLSL
#include "records.glsl"
#include "side_parameter.glsl"

// A point of a patch away from its sides.
struct InnerPoint {
    vec3 position;
    // Partial derivatives.
    vec3 du;
    vec3 dv;
    // Along du x dv, of any length.
    vec3 plane;
};

// From the domain: the side and the corner at (u,v), 4 for none, the parameter on the record of a side, and what outlines are drawn by.
uint side_of(vec2 uv);
uint corner_of(vec2 uv);
float edge_parameter(uint side, uint flip, vec2 uv);
vec2 shade_outline(vec2 uv);
float shade_segments(vec2 inner);

// From the stage: control point i of the patch at hand, in the form's own basis.
vec3 control(uint i);

// From the form: its formula at (u,v) of patch `id`.
InnerPoint inner_point(uint id, vec2 uv);
// From the form: (mean, Gaussian) curvature there, zero where the patch has no tangent plane. For shading alone: no bits are promised.
vec2 shade_curvature(uint id, vec2 uv);
// From the form: the shared point at (u,v) on a side of the patch, corners excepted.
SurfacePoint side_point(uint id, uint side, vec2 uv);

// The shared point at (u,v) on a side of a patch, corners excepted, from the cubic record of the edge.
SurfacePoint cubic_side_point(uint id, uint side, vec2 uv) {
    uint edge = patch_edge(id, side);
    return edge_record_at(edge >> 1u, side_parameter(id, side, edge & 1u, uv));
}

// The point at a corner of a patch, at (u,v).
SurfacePoint corner_point(uint id, uint corner, vec2 uv) {
    uint half_side = half_side_to(id, corner);
    if (half_side != 4u) {
        return cubic_side_point(id, half_side, uv);
    }
    return vertex_record_point(patch_vertex(id, corner));
}

// The shared point at (u,v), if (u,v) is on an edge or a corner of the patch.
bool shared_point(uint id, vec2 uv, out SurfacePoint point) {
    uint side = side_of(uv);
    if (side == 4u) {
        return false;
    }
    uint corner = recorded_corner(id, uv, side);
    if (corner != 4u) {
        point = vertex_record_point(patch_vertex(id, corner));
    } else {
        point = side_point(id, side, uv);
    }
    return true;
}

// The point at (u,v): shared where it lies on an edge or corner, from the patch's own evaluation elsewhere.
SurfacePoint surface_point(uint id, vec2 uv, InnerPoint inner) {
    SurfacePoint point;
    if (!shared_point(id, uv, point)) {
        point = SurfacePoint(inner.position, unit_or_zero(inner.plane));
    }
    return point;
}

#endif
