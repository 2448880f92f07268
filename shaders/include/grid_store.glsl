// Writing vertices of the compute evaluator.
#ifndef GRID_STORE_GLSL
#define GRID_STORE_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "bindings.glsl"
#include "constants.glsl"
#include "forms/form.glsl"
#include "measure.glsl"
#ifdef MAPPED
#include "displacement.glsl"
#endif

layout(scalar, set = 0, binding = BINDING_GRID_VERTICES) writeonly buffer GridVertices { vec3 grid_vertices[]; };

// Whether vertices hold more than places: what is not drawn does.
bool grid_stores_more() {
    return SHADE == SHADE_NONE || shade_sees_measure() || shade_sees_patch();
}

void store_grid_vertex(uint number, uint id, SurfacePoint point, vec2 measure) {
    uint at = (grid_stores_more() ? GRID_VERTEX_VECTORS : GRID_PLACE_VECTORS) * number;
    grid_vertices[at] = point.position;
    grid_vertices[at + 1u] = point.normal;
    if (grid_stores_more()) {
        grid_vertices[at + 2u] = vec3(measure, uintBitsToFloat(id));
    }
}

// The point of patch `id` at (u,v), displaced if the surface is.
SurfacePoint grid_point(uint id, vec2 uv, InnerPoint inner, SurfacePoint point) {
#ifdef MAPPED
    return displaced_point(id, uv, inner, point);
#else
    return point;
#endif
}

#endif
