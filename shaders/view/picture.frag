#version 460
#extension GL_GOOGLE_include_directive : require
// A picture, texel by texel.
#include "bindings.glsl"
#include "encoding.glsl"
#include "picture_push.glsl"

layout(set = 0, binding = BINDING_TEXTURE) uniform sampler2D picture;

layout(location = 0) out vec4 color;

void main() {
    vec3 rgb = texelFetch(picture, ivec2(gl_FragCoord.xy) - ivec2(place.origin), 0).rgb;
    color = vec4(place.target_encodes == 1u ? rgb : srgb_encode(rgb), 1.0);
}
