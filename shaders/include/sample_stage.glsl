// Surface points on request, by the forms of the evaluation stages, on a list of (patch, u, v) of one form. A kernel includes this, its basis and its form.
#ifndef SAMPLE_STAGE_GLSL
#define SAMPLE_STAGE_GLSL
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"
#include "coefficients.glsl"
#include "bases/net.glsl"
#define SIDES_DEFAULT SIDES_BY_TAG
#include "forms/form.glsl"

struct SampleRequest {
    uint patch_id;
    float u;
    float v;
};

layout(std430, set = 0, binding = BINDING_REQUESTS) readonly buffer Requests { SampleRequest requests[]; };
layout(std430, set = 0, binding = BINDING_SAMPLES) writeonly buffer Samples { float samples[]; };

// The patch at hand.
uint sampled_patch;

vec3 net_point_at(uint i) {
    return load_point(net_index(patch_basis(sampled_patch).net + i));
}

// From the basis.
vec3 change_basis(uint point, uint basis, uint net_size);

// As the control stage makes it, or stored.
vec3 control(uint i) {
    if ((patch_basis(sampled_patch).tag & TAG_STORED) != 0u) {
        return stored_vector(patch_basis(sampled_patch).net + i);
    }
    return change_basis(i, patch_basis(sampled_patch).basis, patch_basis(sampled_patch).net_size);
}

void store_vector(uint sample_id, uint i, vec3 v) {
    uint at = SAMPLE_FLOATS * sample_id + 3u * i;
    samples[at] = v.x;
    samples[at + 1u] = v.y;
    samples[at + 2u] = v.z;
}

void write_sample() {
    uint id = thread_index();
    if (id >= kernel.count) {
        return;
    }
    SampleRequest request = requests[id];
    sampled_patch = request.patch_id;
    vec2 uv = vec2(request.u, request.v);
    InnerPoint inner = inner_point(sampled_patch, uv);
    SurfacePoint point = surface_point(sampled_patch, uv, inner);
    store_vector(id, 0u, point.position);
    store_vector(id, 1u, inner.du);
    store_vector(id, 2u, inner.dv);
    store_vector(id, 3u, point.normal);
}

#endif
