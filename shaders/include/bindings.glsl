// Every binding of descriptor set 0, for all shaders and the host: one number has one meaning everywhere.
#ifndef BINDINGS_GLSL
#define BINDINGS_GLSL

#define BINDING_FRAME 0
#define BINDING_POINTS 1
#define BINDING_NETS 2
#define BINDING_PATCHES 3
#define BINDING_VERTEX_RECORDS 4
#define BINDING_EDGE_RECORDS 5
#define BINDING_COEFFICIENTS 6
#define BINDING_WEIGHTS 7
#define BINDING_SPANS 8
#define BINDING_INDICES 9
#define BINDING_SOURCES 10
#define BINDING_REQUESTS 11
#define BINDING_SAMPLES 12
#define BINDING_SPOKES 13
#define BINDING_FANS 14
#define BINDING_GRID_PATCHES 15
#define BINDING_GRID_PARAMETERS 16
#define BINDING_GRID_VERTICES 17
#define BINDING_EDGE_FACTORS 18

#endif
