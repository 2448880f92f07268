#version 460
#extension GL_GOOGLE_include_directive : require
// The cage's points in a pose: morph targets, then linear blend skinning (glTF 2.0 specification, section 3.7.3). One thread per vertex, which gathers what
// moves it in a fixed order. Reference: osculate_cage::Rig::positions, in f64.
#define POINTS_WRITABLE
#include "thread.glsl"
#include "kernel_push.glsl"
#include "points.glsl"

struct SkinVertex {
    // Position before anything moves it, in the bind frame of its joints.
    vec3 bind;
    // Its influences are first_influence .. influence_end.
    uint first_influence;
    uint influence_end;
    // Its offsets are first_offset .. offset_end.
    uint first_offset;
    uint offset_end;
};

struct SkinInfluence {
    uint joint;
    // The weights of a vertex have the sum 1.
    float weight;
};

struct MorphOffset {
    // What the target adds at weight 1, in the bind frame of the vertex.
    vec3 offset;
    // The target, an index of morph_weights.
    uint morph_target;
};

layout(std430, set = 0, binding = BINDING_SKIN_VERTICES) readonly buffer SkinVertices { SkinVertex vertices[]; };
layout(std430, set = 0, binding = BINDING_SKIN_INFLUENCES) readonly buffer SkinInfluences { SkinInfluence influences[]; };
layout(std430, set = 0, binding = BINDING_MORPH_OFFSETS) readonly buffer MorphOffsets { MorphOffset offsets[]; };
// Three rows for each joint, from its bind frame to cage space.
layout(std430, set = 0, binding = BINDING_JOINTS) readonly buffer Joints { vec4 joint_rows[]; };
layout(std430, set = 0, binding = BINDING_MORPH_WEIGHTS) readonly buffer MorphWeights { float morph_weights[]; };

vec3 morphed(SkinVertex vertex) {
    precise vec3 p = vertex.bind;
    for (uint i = vertex.first_offset; i < vertex.offset_end; ++i) {
        MorphOffset morph = offsets[i];
        p = p + morph_weights[morph.morph_target] * morph.offset;
    }
    return p;
}

float along(vec4 row, vec3 p) {
    precise float r = ((row.x * p.x + row.y * p.y) + row.z * p.z) + row.w;
    return r;
}

vec3 moved_by(uint joint, vec3 p) {
    uint row = 3u * joint;
    return vec3(along(joint_rows[row], p), along(joint_rows[row + 1u], p), along(joint_rows[row + 2u], p));
}

void main() {
    uint index = thread_index();
    if (index >= kernel.count) {
        return;
    }
    SkinVertex vertex = vertices[index];
    vec3 p = morphed(vertex);
    precise vec3 sum = vec3(0.0);
    for (uint i = vertex.first_influence; i < vertex.influence_end; ++i) {
        sum = sum + influences[i].weight * moved_by(influences[i].joint, p);
    }
    store_point(kernel.first + index, sum);
}
