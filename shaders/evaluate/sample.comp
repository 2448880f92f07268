#version 460
#extension GL_GOOGLE_include_directive : require
// Surface points on request: the includes of the tessellation evaluation stages, on a list of (patch, u, v).
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "nets.glsl"
#include "records.glsl"
#include "regular_basis.glsl"
#include "gregory.glsl"
#include "coefficients.glsl"

struct SampleRequest {
    uint patch_id;
    float u;
    float v;
};

layout(std430, set = 0, binding = BINDING_REQUESTS) readonly buffer Requests { SampleRequest requests[]; };
layout(std430, set = 0, binding = BINDING_SAMPLES) writeonly buffer Samples { float samples[]; };

void store_vector(uint sample_id, uint i, vec3 v) {
    uint at = SAMPLE_FLOATS * sample_id + 3u * i;
    samples[at] = v.x;
    samples[at + 1u] = v.y;
    samples[at + 2u] = v.z;
}

// Bezier points of a regular patch, as patch/regular.tesc makes them.
void regular_bezier(PatchRecord p, out vec3 b[16]) {
    vec3 net[16];
    for (uint i = 0u; i < 16u; ++i) {
        net[i] = load_point(nets[p.net + i]);
    }
    for (uint i = 0u; i < 16u; ++i) {
        b[i] = regular_bezier_point(net, i);
    }
}

// Gregory points of an extraordinary patch, as patch/gregory2.tesc makes them.
void extraordinary_gregory(PatchRecord p, out vec3 g[GREGORY_POINTS]) {
    for (uint row = 0u; row < GREGORY_POINTS; ++row) {
        precise vec3 sum = vec3(0.0);
        for (uint i = p.net_size; i-- > 0u;) {
            sum = sum + weights[p.basis + row * p.net_size + i] * load_point(nets[p.net + i]);
        }
        g[row] = sum;
    }
}

// The bicubic form of a patch at (u,v).
void patch_bezier(PatchRecord p, vec2 uv, out vec3 b[16]) {
    uint kind = p.tag & KIND_MASK;
    if (kind == KIND_REGULAR) {
        regular_bezier(p, b);
        return;
    }
    vec3 g[GREGORY_POINTS];
    if (kind == KIND_EXTRAORDINARY) {
        extraordinary_gregory(p, g);
    } else {
        load_coefficients(p.basis, g);
    }
    gregory_bezier(g, uv, b);
}

void main() {
    uint id = thread_index();
    if (id >= kernel.count) {
        return;
    }
    SampleRequest request = requests[id];
    vec2 uv = vec2(request.u, request.v);
    vec3 b[16];
    patch_bezier(patches[request.patch_id], uv, b);
    PatchPoint inner = bicubic_point(b, uv);
    SurfacePoint point = surface_point(request.patch_id, uv, inner);
    store_vector(id, 0u, point.position);
    store_vector(id, 1u, inner.du);
    store_vector(id, 2u, inner.dv);
    store_vector(id, 3u, point.normal);
}
