// Numbers shared with the host (crates/shaders reads the #define lines).
#ifndef CONSTANTS_GLSL
#define CONSTANTS_GLSL

// Threads of a compute workgroup, and workgroups along x before a dispatch folds into y.
#define GROUP_SIZE 64
#define GROUPS_X 32768

// Floats of a record in its buffer.
#define POINT_FLOATS 3
#define VERTEX_RECORD_FLOATS 6
#define EDGE_RECORD_POINTS 8
#define EDGE_RECORD_FLOATS 24
#define GREGORY_POINTS 20
#define TRIANGLE_POINTS 15
#define SAMPLE_FLOATS 12

// Threads of a workgroup of the compute evaluator, which evaluates one patch; specialized where another number is better.
#define GRID_GROUP_SIZE 32
// Vectors of three words of a vertex that it makes: position, normal, (measure, patch); or position and normal, if nothing looks at the others.
#define GRID_VERTEX_VECTORS 3
#define GRID_PLACE_VECTORS 2
// Bits of a rate that hold the number of segments; the others say where the parameters begin.
#define GRID_SEGMENT_BITS 7
// Where the parameters of edges of unrefined faces begin in GridParameters, if there are such faces.
#define GRID_WHOLE_PARAMETERS 3
// The first bit of GridPatch.owned that stands for a side.
#define GRID_OWNED_SIDES 4

// PatchRecord.tag: the formula (bits 0..2), whether control points are stored (bit 3), boundary flag (bit 4), whether side 0 is the first half of an edge
// (bit 5), side 3 the second (bit 6), the patch an unrefined face (bit 7), valence of corner 0 (from bit 8).
#define FORM_BICUBIC 0
#define FORM_GREGORY 1
#define FORM_STAM 2
#define FORM_BISEPTIC 3
#define FORM_TRIANGLE 4
#define FORM_MASK 7
#define TAG_STORED 8
#define TAG_BOUNDARY 16
#define TAG_HALF_0 32
#define TAG_HALF_3 64
#define TAG_UNREFINED 128
#define TAG_VALENCE_SHIFT 8

// Values of SIDES: each side is an edge with a record of its own; some are halves of an edge; each is the edge of an unrefined face;
// what the patch's tag says.
#define SIDES_PLAIN 0
#define SIDES_HALVES 1
#define SIDES_UNREFINED 2
#define SIDES_BY_TAG 3

// FanRecord.cross_end (osculate_surface::gregory::CrossEnd)
#define CROSS_END_PLAIN 0
#define CROSS_END_VANISHING 1
#define CROSS_END_OPPOSED 2

// Frame.factor_mode
#define FACTORS_UNIFORM 0
#define FACTORS_ADAPTIVE 1

// Frame.cull: which patches are left out before they are tessellated. Those beyond a plane of the view, those that fall between samples, regular ones that
// show their backs.
#define CULL_FRUSTUM 1
#define CULL_SMALL 2
#define CULL_BACK 4

// Values of SHADE: what the colours of a picture mean; SHADE_NONE where nothing is drawn and vertices keep their (u,v).
#define SHADE_NONE 255
#define SHADE_LIT 0
#define SHADE_NORMALS 1
#define SHADE_PATCHES 2
#define SHADE_VALENCE 3
#define SHADE_WIREFRAME 4
#define SHADE_ZEBRA 5
#define SHADE_CURVATURE 6
#define SHADE_PEER 7
#define SHADE_REFLECTION 8
#define SHADE_GAUSSIAN 9
#define SHADE_DIFFERENCE 10
#define SHADE_LEAKS 11
#define SHADE_TEXTURED 12
#define SHADE_UV 13
#define SHADE_FACTORS 14

// Mapping.height_wrap: what lies beyond the map, WRAP_BITS for each axis.
#define WRAP_CLAMP 0
#define WRAP_REPEAT 1
#define WRAP_MIRROR 2
#define WRAP_BITS 2

// Where push constants of fragment shaders from elsewhere begin (material.glsl), in bytes.
#define MATERIAL_PUSH_OFFSET 32

// Specialization constants; those of fragment shaders from elsewhere are 16 and above.
#define SPEC_NET_SIZE 0
#define SPEC_SHADE 1
#define SPEC_GRID_GROUP 2
#define SPEC_ADAPTIVE 3
#define SPEC_CULLS 4
#define SPEC_MATERIAL 5
#define SPEC_SIDES 6

#endif
