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
#define BINDING_SKIN_VERTICES 19
#define BINDING_SKIN_INFLUENCES 20
#define BINDING_MORPH_OFFSETS 21
#define BINDING_JOINTS 22
#define BINDING_MORPH_WEIGHTS 23
#define BINDING_GUI_VERTICES 24
#define BINDING_TEXTURE 25
#define BINDING_PATCH_UV 26
#define BINDING_EDGE_UV 27
#define BINDING_VERTEX_UV 28
#define BINDING_MAPPING 29
#define BINDING_HEIGHTS 30
#define BINDING_COLORS 31
#define BINDING_REGULAR_SOURCES 32
#define BINDING_QUADRUPLES 37

// The same buffers for those that read them, as arrays of vectors: what writes them has the numbers above.
#define BINDING_POINT_TEXELS 33
#define BINDING_VERTEX_RECORD_TEXELS 34
#define BINDING_EDGE_RECORD_TEXELS 35
#define BINDING_COEFFICIENT_TEXELS 36

// Where buffers and images of fragment shaders from elsewhere begin (material.glsl).
#define BINDING_CALLER 64

#endif
