// Writing vertices of the compute evaluator.
#ifndef GRID_STORE_GLSL
#define GRID_STORE_GLSL
#include "bindings.glsl"
#include "constants.glsl"
#include "forms/form.glsl"
#include "measure.glsl"
#ifdef MAPPED
#include "displacement.glsl"
#endif

layout(std430, set = 0, binding = BINDING_GRID_VERTICES) writeonly buffer GridVertices { uint grid_vertices[]; };

void store_grid_vector(uint at, vec3 v) {
    grid_vertices[at] = floatBitsToUint(v.x);
    grid_vertices[at + 1u] = floatBitsToUint(v.y);
    grid_vertices[at + 2u] = floatBitsToUint(v.z);
}

// Whether vertices hold more than places: what is not drawn does.
bool grid_stores_more() {
    return SHADE == SHADE_NONE || shade_sees_measure() || shade_sees_patch();
}

void store_grid_vertex(uint number, uint id, SurfacePoint point, vec2 measure) {
    uint at = (grid_stores_more() ? GRID_VERTEX_WORDS : GRID_PLACE_WORDS) * number;
    store_grid_vector(at, point.position);
    store_grid_vector(at + 3u, point.normal);
    if (grid_stores_more()) {
        grid_vertices[at + 6u] = floatBitsToUint(measure.x);
        grid_vertices[at + 7u] = floatBitsToUint(measure.y);
        grid_vertices[at + 8u] = id;
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
