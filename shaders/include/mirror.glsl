// What smooth surfaces are judged in: patterns with straight lines, mirrored. For shading alone: no bits are promised.
#ifndef MIRROR_GLSL
#define MIRROR_GLSL

// Share of white in a stretch of `width` around `x` of a wave with period 1 that is white from `black` to 1.
float shade_square_wave(float x, float width, float black) {
    float w = max(width, 1e-4);
    vec2 ends = vec2(x - 0.5 * w, x + 0.5 * w);
    vec2 integral = (1.0 - black) * floor(ends) + max(fract(ends) - black, 0.0);
    return (integral.y - integral.x) / w;
}

// Reflection lines: R. Klass, Correction of local surface irregularities using reflection lines, Computer-Aided Design 12(2), 1980; E. Kaufmann, R. Klass,
// Smoothing surfaces using reflection lines for families of splines, Computer-Aided Design 20(6), 1988. Their light lines lie in a plane; these lie on a
// cylinder about the cage, as the tubes of an inspection tunnel, so that every part of a surface mirrors some.
//
// Radius of the tunnel in half diagonals of the cage's box, tubes around it, share of it that they cover.
const float TUNNEL_RADIUS = 2.5;
const float TUBES = 18.0;
const float TUBE_SHARE = 0.13;
// Direction of the tubes and two across, orthonormal, in view space.
const vec3 TUNNEL_AXIS = vec3(0.8, 0.6, 0.0);
const vec3 TUNNEL_ACROSS = vec3(-0.6, 0.8, 0.0);
const vec3 TUNNEL_BACK = vec3(0.0, 0.0, 1.0);

// How much of a pixel the tubes cover that a mirror at `p` (from the middle of the tunnel, in half diagonals) shows along the unit vector `r`.
float shade_tubes(vec3 p, vec3 r) {
    vec2 from = vec2(dot(p, TUNNEL_ACROSS), dot(p, TUNNEL_BACK));
    vec2 along = vec2(dot(r, TUNNEL_ACROSS), dot(r, TUNNEL_BACK));
    // Where the ray leaves the cylinder: |from + t along| = radius.
    float a = max(dot(along, along), 1e-8);
    float b = dot(from, along);
    float c = dot(from, from) - TUNNEL_RADIUS * TUNNEL_RADIUS;
    vec2 hit = from + (sqrt(max(b * b - a * c, 0.0)) - b) / a * along;
    // The angle jumps once around, the wave does not; its change over a pixel comes from the point that was hit.
    const float tubes_per_angle = TUBES / 6.283185307;
    vec2 dx = dFdx(hit);
    vec2 dy = dFdy(hit);
    vec2 turn = vec2(hit.x * dx.y - hit.y * dx.x, hit.x * dy.y - hit.y * dy.x) / max(dot(hit, hit), 1e-8);
    return shade_square_wave(atan(hit.y, hit.x) * tubes_per_angle, length(turn) * tubes_per_angle, 1.0 - TUBE_SHARE);
}

#endif
