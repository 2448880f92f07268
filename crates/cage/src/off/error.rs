//! What can be wrong with a line of an OFF file.

use crate::LimitError;
use crate::listed::{numbered, plural};

/// Why a line of an OFF file is malformed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OffError {
    /// The first line is neither a keyword nor counts.
    #[error("not an OFF file: it starts with neither `OFF` nor the numbers of vertices and faces")]
    NotOff,
    /// A variant of the format that is not read.
    #[error("{0} is not read; export it as OFF in text with three coordinates, or as PLY or OBJ")]
    Variant(&'static str),
    /// The line of counts is missing or malformed.
    #[error("the numbers of vertices and faces are missing; after `OFF` comes a line like `8 6 12`")]
    Counts,
    /// The file ends too soon.
    #[error("the file ends after {found} of {}; it is cut short or its counts are wrong", plural(*.announced, .what))]
    Truncated {
        /// `vertex` or `face`.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many the counts announce.
        announced: usize,
    },
    /// A word that is not a number where one is due.
    #[error("{0:?} is not a number; numbers look like -1.5 or 2e-3")]
    Number(String),
    /// A number that is infinite or not a number.
    #[error("{0:?} is not finite; coordinates are finite numbers")]
    NotFinite(String),
    /// A vertex with fewer numbers than it needs.
    #[error("a vertex with {found} of the {needed} numbers it needs")]
    MissingNumbers {
        /// How many it needs.
        needed: usize,
        /// How many there are.
        found: usize,
    },
    /// A face without the number of its corners.
    #[error("{0:?} is not the number of corners of a face; a face looks like `4 0 1 2 3`")]
    CornerCount(String),
    /// A face with fewer indices than it announces.
    #[error("a face announces {announced} corners but has {found}")]
    MissingCorners {
        /// How many it announces.
        announced: i64,
        /// How many there are.
        found: usize,
    },
    /// A face with one or two corners.
    #[error("a face with {}; faces have at least 3", plural(*.0, "corner"))]
    TooFewCorners(usize),
    /// A corner that is no vertex.
    #[error("{word:?} is not a vertex; {}", numbered(*.vertices, "vertex"))]
    Index {
        /// The word.
        word: String,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More elements than 32-bit indices can name.
    #[error("too many {0} for 32-bit indices; split the model")]
    TooMany(&'static str),
    /// A limit of the reader.
    #[error(transparent)]
    Limit(#[from] LimitError),
}
