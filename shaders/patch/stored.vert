#version 460
#extension GL_GOOGLE_include_directive : require
// One vertex per patch for lists whose evaluation stage reads the coefficient buffer: it carries the patch id alone.
#include "patch_push.glsl"

layout(location = 1) out flat uint patch_id;

void main() {
    patch_id = list.first_patch + uint(gl_VertexIndex);
}
