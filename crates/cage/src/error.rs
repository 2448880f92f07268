//! What can go wrong between a file and a cage.

use std::path::{Path, PathBuf};

use crate::listed::numbered;
use crate::progress::Cancelled;
use crate::{
    GltfError, LimitError, Listed, ObjError, OffError, PlyError, SequenceError, TagError, TopologyError, UsdError,
};

/// Why a [`CageDesc`](crate::CageDesc) is not a cage. Indices count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CageError {
    /// There is nothing to subdivide.
    #[error("no faces; a cage has at least one")]
    NoFaces,
    /// Coordinates that are infinite or not a number.
    #[error("{counted} with coordinates that are not finite: {0}", counted = .0.count("vertex"))]
    NotFinite(Listed<u32>),
    /// The box of the cage is so large that squared lengths leave 32-bit floats.
    #[error("the cage is {size:e} across, at most {limit:e} can be drawn; scale it down", limit = crate::Cage::MAX_SIZE)]
    TooLarge {
        /// The diagonal of the box.
        size: f64,
    },
    /// The faces are not a manifold mesh.
    #[error(transparent)]
    Topology(TopologyError),
    /// A tag names something that does not exist.
    #[error(transparent)]
    Tag(#[from] TagError),
    /// The uv do not have one index per face corner.
    #[error("{indices} uv indices for {corners} face corners; there must be one for each")]
    UvCount {
        /// The number of uv indices.
        indices: usize,
        /// The number of face corners.
        corners: usize,
    },
    /// Uv indices beyond the uv values.
    #[error("{} with a missing uv: {corners}; {}", .corners.count("face corner"), numbered(*.values, "uv"))]
    MissingUv {
        /// The corners.
        corners: Listed<u32>,
        /// How many uv values there are.
        values: usize,
    },
    /// Uv that are infinite or not a number.
    #[error("{counted} not finite: {0}", counted = .0.count("uv"))]
    UvNotFinite(Listed<u32>),
    /// Materials or texture coordinates that do not fit the faces.
    #[error("the appearance does not fit the cage: {0}")]
    Appearance(&'static str),
    /// A rig that does not fit the vertices.
    #[error("the rig does not fit the cage: {0}")]
    Rig(&'static str),
    /// The indices in the file are not one for each element, or those of faces do not rise.
    #[error("{sources} indices in the file for {}; there must be none, or one for each, rising for faces", crate::listed::plural(*.count, .noun))]
    Sources {
        /// `vertex` or `face`.
        noun: &'static str,
        /// How many indices there are.
        sources: usize,
        /// How many elements there are.
        count: usize,
    },
    /// The ranges of a face set are empty, do not rise, touch, or leave the faces there are.
    #[error("face set {name:?} has the range {range:?}; ranges must rise without touching within 0..{faces}")]
    FaceSet {
        /// The name of the set.
        name: String,
        /// The first range at fault.
        range: std::ops::Range<u32>,
        /// How many faces there are.
        faces: usize,
    },
    /// Nothing is wrong, but the observer has ended the work.
    #[error("reading was cancelled")]
    Cancelled,
}

impl From<TopologyError> for CageError {
    fn from(error: TopologyError) -> Self {
        match error {
            TopologyError::Cancelled => Self::Cancelled,
            error => Self::Topology(error),
        }
    }
}

impl From<Cancelled> for CageError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl ReadError {
    /// The limit that the file exceeds, if that is why it was not read.
    #[must_use]
    pub fn limit(&self) -> Option<&LimitError> {
        match self {
            Self::Limit { error, .. }
            | Self::Obj { error: ObjError::Limit(error), .. }
            | Self::Ply { error: PlyError::Limit(error), .. }
            | Self::Off { error: OffError::Limit(error), .. } => Some(error).filter(|e| **e != LimitError::Cancelled),
            _ => None,
        }
    }

    /// Turns what an observer's wish to end looks like, wherever it was heard, into [`ReadError::Cancelled`].
    pub(crate) fn or_cancelled(self, file: &Path) -> Self {
        let heard = match &self {
            Self::Limit { error, .. }
            | Self::Obj { error: ObjError::Limit(error), .. }
            | Self::Ply { error: PlyError::Limit(error), .. }
            | Self::Off { error: OffError::Limit(error), .. }
            | Self::Gltf { error: GltfError::Limit(error), .. } => *error == LimitError::Cancelled,
            Self::Refused { error, .. } => *error == CageError::Cancelled,
            _ => false,
        };
        if heard { Self::Cancelled { file: file.display().to_string() } } else { self }
    }
}

impl CageError {
    /// A reminder of how elements are numbered, for messages that name some.
    fn counting(&self) -> &'static str {
        match self {
            Self::Cancelled
            | Self::NoFaces
            | Self::TooLarge { .. }
            | Self::UvCount { .. }
            | Self::Appearance(_)
            | Self::Rig(_) => "",
            _ => " (elements count from 0)",
        }
    }
}

/// A line, from 1, as messages append it to the name of its file.
fn place(line: Option<u32>) -> String {
    line.map(|line| format!(":{line}")).unwrap_or_default()
}

/// Why a file could not be read as a cage. Messages are one line that starts with the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read at all.
    #[error("{}: {error}", .file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// The name of the file ends in nothing we know.
    #[error("{}: unknown kind of file; the name must end in .obj, .ply, .off, .gltf, .glb or .usd (.usda, .usdc, .usdz)", .file.display())]
    UnknownFormat {
        /// The file.
        file: PathBuf,
    },
    /// A line of an OBJ file is malformed.
    #[error("{file}:{line}: {error}")]
    Obj {
        /// The name of the file.
        file: String,
        /// The line, from 1.
        line: u32,
        /// What is wrong with it.
        error: ObjError,
    },
    /// A PLY file is malformed.
    #[error("{file}{}: {error}", place(.error.line()))]
    Ply {
        /// The name of the file.
        file: String,
        /// What is wrong with it.
        error: PlyError,
    },
    /// A line of an OFF file is malformed.
    #[error("{file}:{line}: {error}")]
    Off {
        /// The name of the file.
        file: String,
        /// The line, from 1.
        line: u32,
        /// What is wrong with it.
        error: OffError,
    },
    /// The file is beyond a limit of the reader.
    #[error("{file}: {error}")]
    Limit {
        /// The name of the file.
        file: String,
        /// The limit.
        error: LimitError,
    },
    /// A glTF file is malformed.
    #[error("{file}: {error}")]
    Gltf {
        /// The name of the file.
        file: String,
        /// What is wrong with it.
        error: GltfError,
    },
    /// A USD file is malformed, or needs others.
    #[error("{file}{}: {error}", place(.error.line()))]
    Usd {
        /// The name of the file.
        file: String,
        /// What is wrong with it.
        error: UsdError,
    },
    /// Files or time samples are not the frames of one cage.
    #[error("{file}: {error}")]
    Sequence {
        /// The file or pattern.
        file: String,
        /// What is wrong.
        error: SequenceError,
    },
    /// The file is well formed but what it holds is not a cage.
    #[error("{file}{}: {error}{}", place(*.line), .error.counting())]
    Refused {
        /// The name of the file.
        file: String,
        /// The line of the first element at fault, from 1, where one is known.
        line: Option<u32>,
        /// What is wrong.
        error: CageError,
    },
    /// The observer has ended the reading; nothing is known to be wrong with the file.
    #[error("{file}: reading was cancelled")]
    Cancelled {
        /// The name of the file.
        file: String,
    },
}
