#version 460
#extension GL_GOOGLE_include_directive : require
// A round dot with a dark rim.
#include "mark_push.glsl"

layout(location = 0) in vec2 place;

layout(location = 0) out vec4 color;

void main() {
    float radius = length(place);
    float pixel = fwidth(radius);
    float inside = 1.0 - smoothstep(1.0 - pixel, 1.0, radius);
    float core = 1.0 - smoothstep(0.62 - pixel, 0.62, radius);
    color = vec4(mix(vec3(0.012, 0.014, 0.020), mark.color.rgb, core), mark.color.a * inside);
}
