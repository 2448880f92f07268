//! What can be wrong with a glTF file.

use std::path::PathBuf;

/// Why a glTF file cannot be read. Indices are those of the file's arrays, from 0.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The JSON or the binary container is malformed, or an extension is required that is not known.
    #[error("not readable as glTF 2.0: {0}")]
    Format(String),
    /// The scene has no triangles.
    #[error("no triangles in the scene")]
    NoTriangles,
    /// More triangles than a control cage can have.
    #[error("more than {0} triangle corners in the scene; that is no control cage")]
    TooMany(usize),
    /// The nodes are not a tree.
    #[error("node {0} is reached twice; the nodes of a scene must form a tree")]
    NodeTwice(usize),
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
    #[error("buffer {buffer}: {}: {error}", .file.display())]
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
    #[error("mesh {mesh} primitive {primitive} has no POSITION")]
    NoPositions {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
    },
    /// A primitive whose data cannot be read.
    #[error("mesh {mesh} primitive {primitive}, {attribute}: accessor {accessor} {error}")]
    Accessor {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// `POSITION`, `TEXCOORD_0` or `indices`.
        attribute: &'static str,
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
    /// An element is asked for that does not exist.
    #[error("has {count} elements, but element {index} is used")]
    Index {
        /// How many elements there are.
        count: usize,
        /// The element.
        index: u32,
    },
}
