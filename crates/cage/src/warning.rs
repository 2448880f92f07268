//! What was odd about a file but did not keep it from being read.

use crate::Listed;
use crate::listed::count;

/// Something the reader ignored, dropped or made up; the cage is valid all the same.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// Vertices without faces were dropped; the indices are those of the file, from 0.
    #[error("{} dropped: {vertices}{}", .vertices.count("unused vertex"), with_corners(*.corners))]
    UnusedVertices {
        /// The vertices.
        vertices: Listed<u32>,
        /// Corner tags that went with them.
        corners: usize,
    },
    /// Tags that are kept but change nothing yet.
    #[error("tags not evaluated yet are ignored: {}", .0.join(", "))]
    TagsNotEvaluated(Vec<String>),
    /// Statements of an OBJ file that mean nothing to a cage.
    #[error("{} ignored: {name} ({reason}), first in line {line}", count(*.statements, "statement"))]
    Statement {
        /// The first word of the statement.
        name: String,
        /// Why it is ignored.
        reason: &'static str,
        /// How often it occurs.
        statements: usize,
        /// The line of its first occurrence.
        line: u32,
    },
    /// Faces with corners without uv in a file where others have it; these corners got (0, 0).
    #[error("{} without uv, set to (0, 0)", count(*.0, "face"))]
    MissingUv(usize),
}

fn with_corners(corners: usize) -> String {
    if corners == 0 { String::new() } else { format!(" (and {} there)", count(corners, "corner tag")) }
}
