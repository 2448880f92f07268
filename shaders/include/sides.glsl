// What the sides of the patches of a list are, where faces of the cage are left unrefined (ARCHITECTURE.md, "Refinement where needed").
#ifndef SIDES_GLSL
#define SIDES_GLSL
#include "constants.glsl"

// Where nothing else is said: in kernels that evaluate patches of all lists anywhere.
#ifndef SIDES_DEFAULT
#define SIDES_DEFAULT SIDES_PLAIN
#endif

// SIDES_*, specialized for each list.
layout(constant_id = SPEC_SIDES) const uint SIDES = SIDES_DEFAULT;

#endif
