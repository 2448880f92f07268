#version 460
#extension GL_GOOGLE_include_directive : require
// Patches with continuous curvature: Bezier evaluation of bidegree 7 (report, section 4.3). One stage for all valences.
#include "evaluation_stage.glsl"
#include "forms/biseptic.glsl"

layout(location = 0) in vec3 control_point[];
layout(location = 2) in vec3 second_point[];
layout(location = 3) patch in vec3 origin;

vec3 control(uint i) {
    return (i & 1u) == 0u ? control_point[i >> 1u] : second_point[i >> 1u];
}

vec3 control_origin() {
    return origin;
}

void main() {
    write_vertex();
}
