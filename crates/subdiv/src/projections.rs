//! Vectors that are computed before the draw and stored: matrices times nets.

use bytemuck::{Pod, Zeroable};

/// Where consecutive vectors in the coefficient buffer come from (`ProjectionSource` in shaders/records/coefficients.comp): the rows of a matrix times the
/// points of a net less its first point.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct ProjectionSource {
    /// First index of the net in the nets.
    pub net: u32,
    /// First weight, row-major, in the weights.
    pub weights: u32,
    /// Points of the net, columns of the matrix.
    pub columns: u32,
    /// Rows that give points: the net's first point is added again.
    pub absolute_rows: u32,
    /// First vector; it has as many as the matrix has rows, up to the first of the next source.
    pub first: u32,
}

/// Sources with consecutive vectors.
#[derive(Clone, Default)]
pub(crate) struct Projections {
    pub(crate) sources: Vec<ProjectionSource>,
    /// Vectors of all of them.
    pub(crate) count: u32,
}

impl Projections {
    /// Adds a matrix of `rows` rows times a net, given by first index and size; returns its first vector.
    pub(crate) fn push(&mut self, (net, columns): (u32, u32), weights: u32, rows: u32, absolute_rows: u32) -> u32 {
        let first = self.count;
        self.sources.push(ProjectionSource { net, weights, columns, absolute_rows, first });
        self.count += rows;
        first
    }
}
