//! What can be wrong with a USD file.

use crate::LimitError;
use crate::listed::numbered;

/// Why a USD file could not be read. Prims are named by their paths, elements of their attributes count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UsdError {
    /// The text form is malformed.
    #[error("{problem}")]
    Syntax {
        /// The line, from 1.
        line: u32,
        /// What is wrong there.
        problem: String,
    },
    /// A file that is named as USD but starts like none of its forms.
    #[error("not a USD file: it starts with none of `#usda`, `PXR-USDC` and the mark of a zip file")]
    NotUsd,
    /// The binary form is malformed.
    #[error("the binary file is damaged: {0}")]
    Crate(String),
    /// A version of the text form that is not read, or what stands where one is due.
    #[error("version {0:?} of the text form is not read, only 1.0 and later ones of 1: the first line is `#usda 1.0`")]
    TextVersion(String),
    /// A version of the binary form that is not read.
    #[error("version {0}.{1}.{2} of the binary form is not read; write the file as text: usdcat FILE -o text.usda")]
    Version(u8, u8, u8),
    /// A package is malformed or holds something else.
    #[error("the package is not readable: {0}; unpack it, or flatten it: usdcat --flatten FILE -o flat.usda")]
    Package(&'static str),
    /// Prims that are nested too deeply.
    #[error("prims are nested more than {0} levels deep")]
    TooDeep(u32),
    /// A prim with too many attributes.
    #[error("a prim with more than {0} attributes")]
    TooManyAttributes(usize),
    /// The file is laid over others.
    #[error("the file has sub-layers, and other files are not read; flatten it: usdcat --flatten FILE -o flat.usda")]
    SubLayers,
    /// A prim gets its content from elsewhere.
    #[error("{prim} has {arc}, which are not followed; flatten the file: usdcat --flatten FILE -o flat.usda")]
    Arc {
        /// The prim.
        prim: String,
        /// What it has.
        arc: &'static str,
    },
    /// There is nothing to subdivide.
    #[error("no mesh that is drawn; a cage is made of prims of the type Mesh")]
    NoMeshes,
    /// An attribute that a mesh needs.
    #[error("{prim} has no {attribute}; a mesh needs points, faceVertexCounts and faceVertexIndices")]
    Missing {
        /// The prim.
        prim: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// A value that cannot be read.
    #[error("{prim}.{attribute}: {error}")]
    Value {
        /// The prim.
        prim: String,
        /// The attribute.
        attribute: String,
        /// What is wrong with it.
        error: Box<UsdError>,
    },
    /// A value of another type than the attribute has.
    #[error("a value of another type where {0} are due")]
    Type(&'static str),
    /// A value that means nothing.
    #[error("{prim}.{attribute}: {problem}")]
    Attribute {
        /// The prim.
        prim: String,
        /// The attribute.
        attribute: String,
        /// What is wrong with it.
        problem: String,
    },
    /// Attributes that do not have as many values as they must.
    #[error("{prim}.{attribute} has {found} values, but {due} are due, {why}")]
    Count {
        /// The prim.
        prim: String,
        /// The attribute.
        attribute: String,
        /// How many values there are.
        found: usize,
        /// How many there must be.
        due: usize,
        /// What decides that.
        why: &'static str,
    },
    /// An index beyond the elements of its mesh.
    #[error("{prim}.{attribute}[{index}] is {value}, but {}", numbered(*.count, .noun))]
    Index {
        /// The prim.
        prim: String,
        /// The attribute.
        attribute: String,
        /// Where in the attribute.
        index: usize,
        /// The index that is there.
        value: i64,
        /// What it names.
        noun: &'static str,
        /// How many there are.
        count: usize,
    },
    /// More elements than 32-bit indices can name.
    #[error("too many {0} for 32-bit indices; split the model")]
    TooMany(&'static str),
    /// The file cannot be read a second time.
    #[error("{0}")]
    Io(String),
    /// A limit of the reader.
    #[error(transparent)]
    Limit(#[from] LimitError),
}

impl UsdError {
    /// The line at fault, from 1, if that is known; messages leave it to [`ReadError`](crate::ReadError).
    #[must_use]
    pub fn line(&self) -> Option<u32> {
        match self {
            Self::Syntax { line, .. } => Some(*line),
            Self::TextVersion(_) => Some(1),
            Self::Value { error, .. } => error.line(),
            _ => None,
        }
    }
}
