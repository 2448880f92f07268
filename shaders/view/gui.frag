#version 460
#extension GL_GOOGLE_include_directive : require
// Colours of the interface: encoded for screens, alpha multiplied in, and blended so.
#include "bindings.glsl"
#include "encoding.glsl"
#include "gui_push.glsl"

layout(set = 0, binding = BINDING_TEXTURE) uniform sampler2D gui_texture;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 tint;

layout(location = 0) out vec4 color;

void main() {
    vec4 encoded = tint * texture(gui_texture, uv);
    color = gui.target_encodes == 1u ? vec4(srgb_decode(encoded.rgb), encoded.a) : encoded;
}
