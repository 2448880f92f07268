//! What can be wrong with a line of an OBJ file.

use crate::listed::plural;

/// Why a line of an OBJ file is malformed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// Bytes that no text holds.
    #[error("not a text OBJ file: it holds zero bytes; export it as OBJ in ASCII or UTF-8")]
    NotText,
    /// Statements, but no faces among them.
    #[error(
        "no faces, but {}; export polygons, which are lines like `f 1 2 3 4`",
        what_there_is(*.ignored, .statement)
    )]
    NoFaces {
        /// How many statements were ignored.
        ignored: usize,
        /// The first of them.
        statement: String,
    },
    /// A word that is not a number where one is due.
    #[error("{0:?} is not a number; numbers look like -1.5 or 2e-3")]
    Number(String),
    /// A number that is infinite, not a number or too large for 64 bits.
    #[error("{0:?} is not finite; write a finite number")]
    NotFinite(String),
    /// A statement with fewer numbers than it needs.
    #[error("`{statement}` has {found} of the {needed} numbers it needs")]
    MissingNumbers {
        /// The first word of the line.
        statement: &'static str,
        /// How many it needs at least.
        needed: usize,
        /// How many there are.
        found: usize,
    },
    /// A word that is not the corner of a face.
    #[error("{0:?} is not a face corner; corners look like 1, 1/2, 1//3 or 1/2/3")]
    Corner(String),
    /// An index of 0.
    #[error("index 0 in {0:?}; indices count from 1, or from -1 backwards")]
    ZeroIndex(String),
    /// An index beyond the elements of the file, or before the first.
    #[error("{what} index {index} is out of range: {count} {}", if *.index < 0 { "so far" } else { "in the file" })]
    OutOfRange {
        /// `vertex` or `uv`.
        what: &'static str,
        /// The index as in the file.
        index: i64,
        /// How many there are.
        count: usize,
    },
    /// A face with one or two corners.
    #[error("a face with {}; faces have at least 3", plural(*.0, "corner"))]
    TooFewCorners(usize),
    /// A limit of the reader.
    #[error(transparent)]
    Limit(#[from] crate::LimitError),
    /// More elements than 32-bit indices can name.
    #[error("too many {0} for 32-bit indices; split the model")]
    TooMany(&'static str),
    /// A tag without a name or without its counts.
    #[error("a tag looks like `t NAME INTS/FLOATS/STRINGS ARGUMENTS`, for example `t crease 2/1/0 0 1 2.5`")]
    TagForm,
    /// A tag whose counts do not agree with what follows.
    #[error("tag {name} announces {} but has {found}", plural(*.announced, "argument"))]
    TagCount {
        /// The name of the tag.
        name: String,
        /// The sum of its counts.
        announced: usize,
        /// How many words follow.
        found: usize,
    },
    /// A tag with the wrong number or kind of arguments.
    #[error("tag {name} takes {expected}")]
    TagArguments {
        /// The name of the tag.
        name: &'static str,
        /// What it takes.
        expected: &'static str,
    },
    /// A word that is not an index of a tag.
    #[error("{0:?} is not an index; the indices of tags count from 0")]
    TagIndex(String),
}

/// What a file without faces has instead.
fn what_there_is(ignored: usize, first: &str) -> String {
    match ignored {
        1 => format!("a statement that means nothing to a cage: {first:?}"),
        _ => format!("{ignored} statements that mean nothing to a cage, here the first: {first:?}"),
    }
}
