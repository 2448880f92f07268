//! What to do about a problem.

use serde::Serialize;

use super::Problem;

/// A problem in a form for programs, with advice; serializes with the field names as keys.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// What is wrong, in one word that does not change.
    pub kind: &'static str,
    /// The problem in words, as among the problems.
    pub message: String,
    /// What to do about it.
    pub hint: &'static str,
    /// How many elements are concerned.
    pub count: usize,
    /// Which: the first [`Elements::MOST`].
    #[serde(flatten)]
    pub elements: Elements,
}

/// Elements of a cage, by their index from 0.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Elements {
    /// Vertices.
    Vertices(Vec<u32>),
    /// Edges, by their ends.
    Edges(Vec<[u32; 2]>),
    /// Faces.
    Faces(Vec<u32>),
}

impl Elements {
    /// How many elements are listed.
    pub const MOST: usize = 1000;

    fn len(&self) -> usize {
        match self {
            Self::Vertices(v) | Self::Faces(v) => v.len(),
            Self::Edges(edges) => edges.len(),
        }
    }

    fn truncate(&mut self) {
        match self {
            Self::Vertices(v) | Self::Faces(v) => v.truncate(Self::MOST),
            Self::Edges(edges) => edges.truncate(Self::MOST),
        }
    }
}

impl Advice {
    /// Advice for a problem of these elements.
    pub(super) fn new(problem: &Problem, mut elements: Elements) -> Self {
        let count = elements.len();
        elements.truncate();
        Self { kind: problem.kind(), message: problem.to_string(), hint: problem.hint(), count, elements }
    }
}
