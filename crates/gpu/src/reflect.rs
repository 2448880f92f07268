//! What a SPIR-V module declares, read from the module itself.
//!
//! Layouts and barriers come from here, so they cannot disagree with the shaders. Terms are those of the SPIR-V specification.

mod attributes;
mod image;
mod reader;

use crate::{Format, Numbers};

/// A stage of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Vertex stage.
    Vertex,
    /// Tessellation control stage (hull).
    TessellationControl,
    /// Tessellation evaluation stage (domain).
    TessellationEvaluation,
    /// Fragment stage.
    Fragment,
    /// Compute stage.
    Compute,
}

impl Stage {
    /// All stages, in the order of a pipeline; compute last.
    pub(crate) const ALL: [Self; 5] =
        [Self::Vertex, Self::TessellationControl, Self::TessellationEvaluation, Self::Fragment, Self::Compute];
}

impl std::fmt::Display for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vertex => "vertex",
            Self::TessellationControl => "tessellation control",
            Self::TessellationEvaluation => "tessellation evaluation",
            Self::Fragment => "fragment",
            Self::Compute => "compute",
        })
    }
}

/// How a shader sees a buffer or an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ResourceKind {
    /// `buffer` in GLSL.
    StorageBuffer,
    /// `uniform` block in GLSL.
    UniformBuffer,
    /// An image with a sampler, `sampler2D` in GLSL, by what a look-up gives.
    Texture(Numbers),
    /// `image2D` in GLSL, by the format in its layout.
    StorageImage(Format),
    /// A buffer read as an array of vectors, `samplerBuffer` in GLSL, by what a vector is made of.
    TexelBuffer(Numbers),
}

impl ResourceKind {
    /// Whether it is a buffer.
    pub fn is_buffer(self) -> bool {
        matches!(self, Self::StorageBuffer | Self::UniformBuffer)
    }
}

impl std::fmt::Display for ResourceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::StorageBuffer => f.write_str("storage buffer"),
            Self::UniformBuffer => f.write_str("uniform buffer"),
            Self::Texture(Numbers::Float) => f.write_str("sampler2D"),
            Self::Texture(Numbers::Uint) => f.write_str("usampler2D"),
            Self::Texture(Numbers::Int) => f.write_str("isampler2D"),
            Self::StorageImage(format) => write!(f, "storage image of {format:?}"),
            Self::TexelBuffer(Numbers::Float) => f.write_str("samplerBuffer"),
            Self::TexelBuffer(Numbers::Uint) => f.write_str("usamplerBuffer"),
            Self::TexelBuffer(Numbers::Int) => f.write_str("isamplerBuffer"),
        }
    }
}

/// A buffer or image of descriptor set 0 that the shader uses.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ResourceBinding {
    /// Binding number.
    pub binding: u32,
    /// What it is.
    pub kind: ResourceKind,
    /// The shader may read it: it is not `writeonly`.
    pub reads: bool,
    /// The shader may write it: it is not `readonly`. Compute only.
    pub writes: bool,
    /// Name of the block, or of the image.
    pub name: String,
}

/// A specialization constant.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SpecConstant {
    /// `constant_id` in GLSL.
    pub id: u32,
    /// Bits of the default value; booleans are 0 and 1.
    pub default: u32,
    /// Name of the constant, empty if the module was stripped.
    pub name: String,
}

/// A number that a specialization constant may set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// A literal.
    Fixed(u32),
    /// The value of a specialization constant.
    Specialized {
        /// Its id.
        id: u32,
        /// Its value unless specialized.
        default: u32,
    },
}

impl Extent {
    /// The number under a specialization: pairs of id and bits.
    pub fn resolve(self, specialization: &[(u32, u32)]) -> u32 {
        match self {
            Self::Fixed(value) => value,
            Self::Specialized { id, default } => {
                specialization.iter().find(|(wanted, _)| *wanted == id).map_or(default, |(_, bits)| *bits)
            }
        }
    }
}

/// An attribute that a vertex shader reads from the vertex buffer of a draw: one to four numbers of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexInput {
    /// `location` in GLSL.
    pub location: u32,
    /// What it is made of.
    pub numbers: Numbers,
    /// How many there are, 1 to 4.
    pub components: u32,
}

/// What a module with one entry point declares.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Reflection {
    /// The stage it is for.
    pub stage: Stage,
    /// Name of the entry point.
    pub entry_point: String,
    /// The buffers and images that its code refers to, ascending by binding; declared but unused ones are left out.
    pub resources: Vec<ResourceBinding>,
    /// Attributes, ascending by location; vertex shaders only. A vertex in a buffer is all of them in that order, without gaps.
    pub inputs: Vec<VertexInput>,
    /// Bytes of push constants, a multiple of 4; 0 if there are none.
    pub push_constant_size: u32,
    /// Specialization constants, ascending by id.
    pub specialization: Vec<SpecConstant>,
    /// Size of the work group; compute only.
    pub local_size: Option<[Extent; 3]>,
    /// Points of the output patch; tessellation control only.
    pub output_vertices: Option<u32>,
    /// Bytes per vertex written by transform feedback into buffer 0, if the shader declares capture.
    pub capture_stride: Option<u32>,
    /// It uses descriptor set 1, which is the caller's; [`Device::caller_shader`](crate::Device::caller_shader) only.
    pub uses_caller_set: bool,
}

impl Reflection {
    /// Bytes of a vertex in a vertex buffer; 0 if the shader reads none.
    pub fn vertex_stride(&self) -> u32 {
        self.inputs.iter().map(|input| 4 * input.components).sum()
    }
}

/// Why a module cannot be used.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReflectError {
    /// The words are not SPIR-V.
    #[error("not a SPIR-V module: {reason}")]
    Parse {
        /// What the parser said.
        reason: String,
    },
    /// There must be exactly one entry point.
    #[error("{count} entry points, wanted one")]
    EntryPoints {
        /// How many there are.
        count: usize,
    },
    /// The entry point is for a stage that is not supported.
    #[error("stage {stage} is not supported")]
    Stage {
        /// The stage, in SPIR-V's words.
        stage: String,
    },
    /// The module needs a feature that [`Device`](crate::Device) never switches on.
    #[error("capability {capability} is not supported: write the shader without what needs it")]
    Capability {
        /// The capability, in SPIR-V's words.
        capability: String,
    },
    /// A graphics stage may write a buffer or an image.
    #[error("{name:?} can be written, which only compute shaders may do: declare it readonly in this {stage} shader")]
    Write {
        /// Name of the buffer or image.
        name: String,
        /// The stage.
        stage: Stage,
    },
    /// A resource is not in descriptor set 0.
    #[error("{name:?} is in descriptor set {set}, only set 0 is supported")]
    Set {
        /// Name of the resource.
        name: String,
        /// Its set.
        set: u32,
    },
    /// A resource is of a kind that is not supported.
    #[error("{name:?} is {found}, only single buffers, sampler2D and image2D are supported")]
    Resource {
        /// Name of the resource.
        name: String,
        /// What it is.
        found: &'static str,
    },
    /// A vertex shader reads an attribute of a kind that is not supported.
    #[error(
        "vertex attribute {name:?} is {found}, only numbers of 32 bits and vectors of them at locations 0 to 15 are supported"
    )]
    Input {
        /// Name of the input.
        name: String,
        /// What it is.
        found: &'static str,
    },
    /// Two resources have one binding number.
    #[error("{first:?} and {second:?} are both at binding {binding}")]
    Duplicate {
        /// The binding number.
        binding: u32,
        /// Name of one resource.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// The module refers to something it does not define or decorate.
    #[error("malformed module: {reason}")]
    Malformed {
        /// What is missing.
        reason: String,
    },
}

/// Reads what a module declares.
pub fn reflect(words: &[u32]) -> Result<Reflection, ReflectError> {
    read(words, false)
}

/// Reads what a module declares that may need any capability, and use a descriptor set 1, which is left out.
pub(crate) fn reflect_of_caller(words: &[u32]) -> Result<Reflection, ReflectError> {
    read(words, true)
}

fn read(words: &[u32], of_caller: bool) -> Result<Reflection, ReflectError> {
    // rspirv 0.13 panics on some malformed modules. It works on a copy of its own, which is lost then.
    let parsed = std::panic::catch_unwind(|| rspirv::dr::load_words(words).map_err(|state| state.to_string()));
    let module = parsed.unwrap_or_else(|_| Err("the parser gave up".to_owned()));
    let module = module.map_err(|reason| ReflectError::Parse { reason })?;
    reader::Reader::new(&module, of_caller).read()
}
