//! Structs that host and shaders share, byte for byte.
//!
//! Each is declared once here and once in GLSL under the same name, with the same field names. `tests/layout.rs` compares their
//! offsets with the offset decorations of the compiled shaders, so a struct that drifts fails a test.

use bytemuck::{Pod, Zeroable};

/// How the host lays a shared struct out.
pub trait Layout {
    /// Name of the struct or block in GLSL.
    const NAME: &'static str;
    /// Name and byte offset of every field, in order. Names that start with `padding` need no counterpart in GLSL.
    const FIELDS: &'static [(&'static str, usize)];
    /// Size in bytes: the stride of an array of it.
    const SIZE: usize;
}

/// The constants of a [`Layout`], for iterating over all of them.
#[derive(Debug, Clone, Copy)]
pub struct StructLayout {
    /// [`Layout::NAME`]
    pub name: &'static str,
    /// [`Layout::FIELDS`]
    pub fields: &'static [(&'static str, usize)],
    /// [`Layout::SIZE`]
    pub size: usize,
}

impl StructLayout {
    /// The layout of `T`.
    pub const fn of<T: Layout>() -> Self {
        Self { name: T::NAME, fields: T::FIELDS, size: T::SIZE }
    }
}

/// Declares shared structs: each becomes `#[repr(C)]` and `Pod` (which rules out padding that the compiler would add), implements
/// [`Layout`], and is listed in [`LAYOUTS`] so that the test cannot miss it.
macro_rules! shared_structs {
    ($(
        $(#[$attribute:meta])*
        pub struct $name:ident {
            $($(#[$field_attribute:meta])* pub $field:ident: $type:ty,)*
        }
    )*) => {
        $(
            $(#[$attribute])*
            #[repr(C)]
            #[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
            pub struct $name {
                $($(#[$field_attribute])* pub $field: $type,)*
            }

            impl Layout for $name {
                const NAME: &'static str = stringify!($name);
                const FIELDS: &'static [(&'static str, usize)] =
                    &[$((stringify!($field), std::mem::offset_of!($name, $field)),)*];
                const SIZE: usize = size_of::<$name>();
            }
        )*

        /// Every shared struct.
        pub const LAYOUTS: &[StructLayout] = &[$(StructLayout::of::<$name>(),)*];
    };
}

shared_structs! {
    /// What changes from frame to frame: camera and tessellation (`shaders/include/frame.glsl`).
    pub struct Frame {
        /// Clip space from cage space, by columns.
        pub clip_from_cage: [[f32; 4]; 4],
        /// View space from cage space, by columns.
        pub view_from_cage: [[f32; 4]; 4],
        /// Eye in cage space; w unused.
        pub eye: [f32; 4],
        /// Eye that adaptive factors are chosen for, in cage space; w unused.
        pub factor_eye: [f32; 4],
        /// Uniform tessellation factor of a patch edge.
        pub level: f32,
        /// Adaptive factors: segments of an edge of unit length at unit distance.
        pub segments_per_length: f32,
        /// How factors are chosen: a `FACTORS_*` constant.
        pub factor_mode: u32,
        /// Half diagonal of the cage's box in cage space: the measure of curvatures and of what is mirrored.
        pub radius: f32,
        /// Smallest distance from the eye that adaptive factors tell apart.
        pub near: f32,
        /// Zero.
        pub padding: u32,
        /// Width and height of the picture in pixels.
        pub viewport: [f32; 2],
        /// Line colour of wireframe and cage overlay, linear RGBA.
        pub line_color: [f32; 4],
        /// The view that patches are culled for: clip space from cage space, by columns.
        pub cull_clip_from_cage: [[f32; 4]; 4],
        /// Its eye in cage space; w unused.
        pub cull_eye: [f32; 4],
        /// Width and height of its picture in pixels.
        pub cull_viewport: [f32; 2],
        /// Places per pixel along an axis where a sample can lie.
        pub cull_samples: f32,
        /// Which patches are left out: `CULL_*` bits.
        pub cull: u32,
        /// The caller's world from cage space, or the cage's own coordinates; by columns.
        pub world_from_cage: [[f32; 4]; 4],
    }

    /// The part of a patch list that one draw renders (`shaders/include/patch_push.glsl`).
    pub struct PatchPush {
        /// First index of the list's nets in the net buffer.
        pub net_offset: u32,
        /// Points of a net; 1 for lists that read coefficients.
        pub net_size: u32,
        /// Global id of the list's first patch.
        pub first_patch: u32,
        /// First weight of the list's change of basis.
        pub weights: u32,
        /// Sum of the negative weights of the control point with the largest one, for hulls of control points.
        pub overshoot: f32,
    }

    /// What a kernel over elements of one kind needs (`shaders/include/kernel_push.glsl`).
    pub struct KernelPush {
        /// Elements to compute.
        pub count: u32,
        /// Index of the first element written, in the buffer that the kernel writes.
        pub first: u32,
        /// Distance from an old point to its new point, for the vertex kernel.
        pub old_distance: u32,
    }

    /// What a kernel needs that writes the vertices along edges which are all divided alike (`shaders/include/edge_points_push.glsl`).
    pub struct EdgePointsPush {
        /// Edges to write.
        pub count: u32,
        /// Record of the first of them.
        pub first_record: u32,
        /// Vertex number of the first vertex of record 0.
        pub first_vertex: u32,
        /// How they are divided, as in [`GridPatch`].
        pub rate: u32,
    }

    /// How the compute evaluator divides one patch (`shaders/include/grid.glsl`). A rate is the number of segments and, from bit `GRID_SEGMENT_BITS` on,
    /// where its parameters begin.
    #[derive(Eq)]
    pub struct GridPatch {
        /// Global id of the patch.
        pub patch_id: u32,
        /// Bit k: this patch evaluates the vertex at corner k; bit `GRID_OWNED_SIDES` + k: those along side k.
        pub owned: u32,
        /// Its first inner vertex.
        pub first_inner: u32,
        /// Rates of the sides.
        pub side_rate: [u32; 4],
        /// Rates inside along u and along v.
        pub inner_rate: [u32; 2],
        /// Vertex at each corner.
        pub corner_vertex: [u32; 4],
        /// First vertex along each side, in the direction of the edge record.
        pub side_vertex: [u32; 4],
    }

    /// What moves a vertex of the cage (`shaders/animate/skin.comp`).
    pub struct SkinVertex {
        /// Position before anything moves it, in the bind frame of its joints.
        pub bind: [f32; 3],
        /// Its first influence.
        pub first_influence: u32,
        /// The end of its influences.
        pub influence_end: u32,
        /// Its first morph offset.
        pub first_offset: u32,
        /// The end of its morph offsets.
        pub offset_end: u32,
        /// Up to the alignment of `bind`.
        pub padding: u32,
    }

    /// A joint that moves a vertex (`shaders/animate/skin.comp`).
    pub struct SkinInfluence {
        /// The joint.
        pub joint: u32,
        /// Its share; those of a vertex have the sum 1.
        pub weight: f32,
    }

    /// What a morph target adds to a vertex (`shaders/animate/skin.comp`).
    pub struct MorphOffset {
        /// The offset at weight 1, in the bind frame of the vertex.
        pub offset: [f32; 3],
        /// The target, counted over all sets.
        pub morph_target: u32,
    }

    /// How texture coordinates are looked up (`shaders/include/attributes.glsl`).
    pub struct Mapping {
        /// From texture coordinates to those of the heights: the columns of a matrix.
        pub height_axes: [[f32; 2]; 2],
        /// The image of the origin.
        pub height_origin: [f32; 2],
        /// What a height of 1 moves, in cage space.
        pub height_scale: f32,
        /// What everything is moved, in cage space.
        pub height_bias: f32,
        /// From texture coordinates to those of the colours.
        pub color_axes: [[f32; 2]; 2],
        /// The image of the origin.
        pub color_origin: [f32; 2],
        /// What lies beyond the heights: a `WRAP_*` constant for u, and one for v from bit `WRAP_BITS`.
        pub height_wrap: u32,
        /// Levels of the heights.
        pub height_levels: u32,
        /// Linear; multiplied with the colours.
        pub base_color: [f32; 4],
    }

    /// What the stages of the interface need (`shaders/include/gui_push.glsl`).
    pub struct GuiPush {
        /// Width and height of the window in points.
        pub size: [f32; 2],
        /// 1 if the target encodes colours itself.
        pub target_encodes: u32,
    }

    /// Where a picture is shown (`shaders/include/picture_push.glsl`).
    pub struct PicturePush {
        /// The target's texel under the picture's upper left one.
        pub origin: [u32; 2],
        /// 1 if the target encodes colours itself.
        pub target_encodes: u32,
    }

    /// How marks on the surface look (`shaders/include/mark_push.glsl`).
    pub struct MarkPush {
        /// Linear, alpha not multiplied in.
        pub color: [f32; 4],
        /// Diameter of dots in pixels; length of normals in cage space.
        pub size: f32,
    }

    /// A point that `shaders/evaluate/sample.comp` is asked for.
    pub struct SampleRequest {
        /// Global id of the patch.
        pub patch_id: u32,
        /// First parameter.
        pub u: f32,
        /// Second parameter.
        pub v: f32,
    }
}
