//! What can be wrong with a glTF file.

use std::fmt;
use std::path::PathBuf;

use crate::LimitError;
use crate::text::excerpt;

/// Why a glTF file cannot be read. Indices are those of the file's arrays, from 0.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The JSON or the binary container is malformed.
    #[error("not readable as glTF 2.0: {0}")]
    Format(String),
    /// The file cannot be understood without an extension that is not known.
    #[error("the file requires the extension {0}, which is not read; export it again without that extension")]
    Extension(String),
    /// Meshes are compressed.
    #[error("the meshes are compressed with {0}, which is not read; export them again without compression")]
    Compressed(&'static str),
    /// The file asks for more than is allowed.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// The scene has no triangles.
    #[error("no triangles in the scene; export meshes, not points, lines or an empty scene")]
    NoTriangles,
    /// More triangles than a control cage can have.
    #[error("more than {0} triangle corners in the scene; that is no control cage")]
    TooMany(usize),
    /// More data than the bytes of the file can be meant for.
    #[error("more than {0} numbers in joints, morph targets, uv sets and animations; that is no control cage")]
    TooMuch(usize),
    /// The nodes are not a tree.
    #[error("node {0} is reached twice; the nodes of a scene must form a tree")]
    NodeTwice(usize),
    /// A transform with numbers that 32-bit floats cannot hold.
    #[error("node {0} has a transform with infinite numbers")]
    NodeTransform(usize),
    /// A joint outside of all trees of nodes.
    #[error("skin {skin} joint {joint} is node {node}, which is in no tree of nodes")]
    SkinNode {
        /// The skin.
        skin: usize,
        /// The joint.
        joint: usize,
        /// Its node.
        node: usize,
    },
    /// A skin without joints, or with more joints than inverse bind matrices.
    #[error("skin {skin} has {joints} joints and {matrices} inverse bind matrices; it needs a matrix for each joint")]
    SkinMatrices {
        /// The skin.
        skin: usize,
        /// The number of joints.
        joints: usize,
        /// The number of matrices.
        matrices: usize,
    },
    /// Primitives of one mesh with different numbers of morph targets.
    #[error("mesh {mesh} primitive {primitive} has {found} morph targets, but those before it have {due}")]
    Targets {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// How many targets it has.
        found: usize,
        /// How many it should have.
        due: usize,
    },
    /// An animation that cannot be played.
    #[error("animation {animation} channel {channel} {fault}")]
    Channel {
        /// The animation.
        animation: usize,
        /// The channel.
        channel: usize,
        /// What is wrong with it.
        fault: String,
    },
    /// A buffer without a place to read it from.
    #[error("buffer {0} has no uri, and the file has no binary part for it")]
    BufferMissing(usize),
    /// A buffer at a place that is not read.
    #[error(
        "buffer {buffer} is at {uri:?}; only base64 `data:` and relative paths inside the folder of the file are read"
    )]
    BufferUri {
        /// The buffer.
        buffer: usize,
        /// Its uri, cut if long.
        uri: String,
    },
    /// A buffer with malformed base64.
    #[error("buffer {0} has malformed base64 data")]
    BufferBase64(usize),
    /// A buffer whose file cannot be read.
    #[error("buffer {buffer}: {}: {error}", excerpt(&.file.to_string_lossy(), 300))]
    BufferFile {
        /// The buffer.
        buffer: usize,
        /// Its file.
        file: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// A buffer with fewer bytes than announced.
    #[error("buffer {buffer} has {found} of the {announced} bytes it announces")]
    BufferShort {
        /// The buffer.
        buffer: usize,
        /// How long it should be.
        announced: usize,
        /// How long it is.
        found: usize,
    },
    /// A primitive without positions, or with an accessor for them that does not exist.
    #[error("mesh {mesh} primitive {primitive} has no accessor for POSITION")]
    NoPositions {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
    },
    /// Data that cannot be read.
    #[error("{place}, {attribute}: accessor {accessor} {error}")]
    Accessor {
        /// What uses the accessor.
        place: GltfPlace,
        /// What for: `POSITION`, `indices`, `inverseBindMatrices`, `input`.
        attribute: String,
        /// The accessor.
        accessor: usize,
        /// What is wrong with it.
        error: AccessorError,
    },
    /// A triangle list whose length is not a multiple of three.
    #[error("mesh {mesh} primitive {primitive} has {corners} corners, which are no whole triangles")]
    Triangles {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// How many corners there are.
        corners: usize,
    },
}

/// What uses an accessor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GltfPlace {
    /// A primitive of a mesh.
    Primitive {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
    },
    /// A skin.
    Skin(usize),
    /// A sampler of an animation.
    Sampler {
        /// The animation.
        animation: usize,
        /// The sampler.
        sampler: usize,
    },
}

impl fmt::Display for GltfPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Primitive { mesh, primitive } => write!(f, "mesh {mesh} primitive {primitive}"),
            Self::Skin(skin) => write!(f, "skin {skin}"),
            Self::Sampler { animation, sampler } => write!(f, "animation {animation} sampler {sampler}"),
        }
    }
}

/// What is wrong with an accessor; to be read after its name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AccessorError {
    /// The elements are of the wrong type.
    #[error("holds {found}, but {expected} is due")]
    Type {
        /// What it holds.
        found: String,
        /// What is due.
        expected: &'static str,
    },
    /// Integers where only the extension for them allows them.
    #[error("holds {found}, which the file may do only if it lists KHR_mesh_quantization in extensionsRequired")]
    NotQuantized {
        /// What it holds.
        found: String,
    },
    /// The elements end beyond the buffer or its view.
    #[error("needs {needed} bytes of a view with {available}")]
    OutOfRange {
        /// The bytes it needs, from the start of the view.
        needed: u64,
        /// The bytes there are.
        available: u64,
    },
    /// The view ends beyond its buffer.
    #[error("uses view {view}, which leaves its buffer")]
    View {
        /// The view.
        view: usize,
    },
    /// Elements that overlap.
    #[error("has elements of {size} bytes at a stride of {stride}")]
    Stride {
        /// The size of an element.
        size: usize,
        /// The distance of elements.
        stride: usize,
    },
    /// Elements at odd places, which a damaged offset is the likely reason for.
    #[error("starts at byte {offset} of its buffer with a stride of {stride}; both must be multiples of {alignment}")]
    Alignment {
        /// The first byte, from the start of the buffer.
        offset: u64,
        /// The distance of elements.
        stride: usize,
        /// The size of a component.
        alignment: usize,
    },
    /// An element is asked for that does not exist.
    #[error("has {count} elements, but element {index} is used")]
    Index {
        /// How many elements there are.
        count: usize,
        /// The element.
        index: u32,
    },
    /// Replaced elements whose indices do not rise within the accessor.
    #[error("has sparse indices that do not rise below {count}, first the one of number {position}")]
    Sparse {
        /// How many elements there are.
        count: usize,
        /// The first sparse value at fault.
        position: usize,
    },
    /// An element with a value that makes no sense.
    #[error("has the element {index}, which {fault}")]
    Value {
        /// The element.
        index: u32,
        /// What is wrong with it.
        fault: String,
    },
    /// Another number of elements than what uses them needs.
    #[error("has {found} elements, but {due} are due")]
    Count {
        /// How many there are.
        found: usize,
        /// How many there should be.
        due: usize,
    },
}
