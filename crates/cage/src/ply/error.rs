//! What can be wrong with a PLY file.

use crate::LimitError;
use crate::listed::{numbered, plural};

/// Why a PLY file is malformed. Elements count from 0, lines from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlyError {
    /// The first line is not `ply`.
    #[error("not a PLY file: its first line is not `ply`")]
    NotPly,
    /// The header has no end.
    #[error("the header does not end: there is no line `end_header`")]
    EndlessHeader,
    /// A line of the header that means nothing.
    #[error("{reason}")]
    Header {
        /// The line.
        line: u32,
        /// What is wrong with it.
        reason: String,
    },
    /// There is no vertex with coordinates.
    #[error("there are no vertices: the header needs `element vertex` with the properties x, y and z")]
    NoVertices,
    /// There is no face with corners.
    #[error(
        "there are no faces, only points or strips: export polygons, as `element face` with a list `vertex_indices`"
    )]
    NoFaces,
    /// A property whose type does not suit it.
    #[error("property {property} of {element} is {found}; it must be {expected}")]
    Type {
        /// The element.
        element: &'static str,
        /// The property.
        property: String,
        /// What it is.
        found: &'static str,
        /// What it should be.
        expected: &'static str,
    },
    /// The file ends too soon.
    #[error("the file ends in {element} {index} of {count}; it is cut short or its header announces too much")]
    Truncated {
        /// The kind of element.
        element: String,
        /// Its number.
        index: u64,
        /// How many are announced.
        count: u64,
    },
    /// A word that is not a number.
    #[error("{word:?} in {element} {index} is not {expected}")]
    Word {
        /// The line.
        line: u32,
        /// The word.
        word: String,
        /// The kind of element.
        element: String,
        /// Its number.
        index: u64,
        /// What should be there.
        expected: &'static str,
    },
    /// A list of less than no values.
    #[error("a list in {element} {index} has {length} values; the file is damaged")]
    ListLength {
        /// The kind of element.
        element: String,
        /// Its number.
        index: u64,
        /// The length.
        length: i64,
    },
    /// Coordinates that are infinite or not a number.
    #[error("{element} {index} has a coordinate that is not finite")]
    NotFinite {
        /// The kind of element.
        element: &'static str,
        /// Its number.
        index: u64,
    },
    /// A face with one or two corners.
    #[error("face {face} has {}; faces have at least 3", plural(*.corners, "corner"))]
    TooFewCorners {
        /// The face.
        face: u64,
        /// How many it has.
        corners: usize,
    },
    /// A corner that is no vertex.
    #[error("face {face} names vertex {index}, but {}", numbered(*.vertices, "vertex"))]
    Index {
        /// The face.
        face: u64,
        /// The index.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A face whose texture coordinates are not two for each corner.
    #[error("face {face} has {found} texture coordinates for {}; there must be two for each", plural(*.corners, "corner"))]
    Texcoords {
        /// The face.
        face: u64,
        /// How many numbers there are.
        found: usize,
        /// How many corners there are.
        corners: usize,
    },
    /// More elements than 32-bit indices can name.
    #[error("too many {0} for 32-bit indices; split the model")]
    TooMany(&'static str),
    /// A limit of the reader.
    #[error(transparent)]
    Limit(#[from] LimitError),
}

impl PlyError {
    /// The line at fault, from 1, where one is known; messages leave it to [`ReadError`](crate::ReadError).
    #[must_use]
    pub fn line(&self) -> Option<u32> {
        match self {
            Self::Header { line, .. } | Self::Word { line, .. } => Some(*line),
            _ => None,
        }
    }
}
