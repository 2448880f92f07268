//! Why a set of faces is not a manifold mesh.

use std::fmt;

use crate::Listed;
use crate::listed::numbered;
use crate::progress::Cancelled;

/// Why faces cannot be made into a [`Topology`](crate::Topology). Indices count from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TopologyError {
    /// More elements than 32-bit indices can name.
    #[error("{count} {what}, but indices have 32 bits: at most {} can be used; split the model", u32::MAX - 1)]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// The rows of the faces do not start at 0, go back, or do not end at the number of corners.
    #[error("face offsets must rise from 0 to {corners}, the number of corners, but entry {entry} does not")]
    Offsets {
        /// The first entry at fault; the number of entries if there is none at all.
        entry: usize,
        /// The number of face corners.
        corners: usize,
    },
    /// Faces with one or two corners.
    #[error("{counted} with fewer than three corners: {0}; delete them", counted = .0.count("face"))]
    TooFewCorners(Listed<u32>),
    /// Faces that name vertices that do not exist.
    #[error("{} without a vertex: {corners}; {}", .corners.count("face corner"), numbered(*.vertices, "vertex"))]
    MissingVertex {
        /// The corners and the indices they name.
        corners: Listed<FaceCorner>,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Faces that visit a vertex more than once.
    #[error("repeated vertices in a face, at {counted}: {0}; split the face or merge its corners", counted = .0.count("corner"))]
    RepeatedVertex(Listed<FaceCorner>),
    /// Edges with more than two faces.
    #[error("not manifold, {counted} with more than two faces: {0}; remove or separate the extra faces", counted = .0.count("edge"))]
    NonManifoldEdge(Listed<EdgeFaces>),
    /// Edges that two faces run in the same direction.
    #[error("inconsistent winding, {counted} along which both faces run the same way: {0}; flip the faces that are inside out, or delete one of two equal faces", counted = .0.count("edge"))]
    InconsistentWinding(Listed<EdgeFaces>),
    /// Vertices whose faces form several fans that only touch there.
    #[error("not manifold, {counted} where separate fans of faces touch: {0}; split these vertices", counted = .0.count("bow-tie vertex"))]
    BowTie(Listed<Fans>),
    /// Nothing is wrong, but an observer has ended the work. Never the result of [`Topology::build`](crate::Topology::build).
    #[error("reading was cancelled")]
    Cancelled,
}

impl From<Cancelled> for TopologyError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl TopologyError {
    /// The first face at fault, if the error is about faces.
    #[must_use]
    pub fn face(&self) -> Option<u32> {
        match self {
            Self::TooFewCorners(faces) => faces.first().first().copied(),
            Self::MissingVertex { corners, .. } | Self::RepeatedVertex(corners) => {
                corners.first().first().map(|c| c.face)
            }
            // The last face of the edge is the one that made it wrong.
            Self::NonManifoldEdge(edges) | Self::InconsistentWinding(edges) => {
                edges.first().first().and_then(|e| e.faces.first().last().copied())
            }
            Self::BowTie(fans) => fans.first().first().map(|fans| fans.face),
            Self::TooMany { .. } | Self::Offsets { .. } | Self::Cancelled => None,
        }
    }
}

/// A corner of a face and the vertex it names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceCorner {
    /// The face.
    pub face: u32,
    /// The vertex.
    pub vertex: u32,
}

impl fmt::Display for FaceCorner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "face {} vertex {}", self.face, self.vertex)
    }
}

/// An edge and its faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgeFaces {
    /// The end points, the lower index first.
    pub vertices: [u32; 2],
    /// The faces, in rising order.
    pub faces: Listed<u32>,
}

impl fmt::Display for EdgeFaces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{} (faces {})", self.vertices[0], self.vertices[1], self.faces)
    }
}

/// A vertex at which several fans of faces touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fans {
    /// The vertex.
    pub vertex: u32,
    /// How many fans there are.
    pub fans: usize,
    /// The first face of the last fan.
    pub face: u32,
}

impl fmt::Display for Fans {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({} fans)", self.vertex, self.fans)
    }
}
