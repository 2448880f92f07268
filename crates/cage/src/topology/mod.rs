//! Half-edge topology of a polygon mesh.
//!
//! A half-edge is a face corner: half-edge `h` runs from the vertex of corner `h` to the vertex of the next corner of the same
//! face, with the face on its left. Corners are stored face after face, so the half-edges of a face are a range and everything
//! but the pairing of half-edges is arithmetic.

mod build;
mod error;
mod restrict;
mod ring;

use std::ops::Range;

pub(crate) use build::{STEPS, build, check_rows, repeats};
pub use error::{EdgeFaces, FaceCorner, Fans, TopologyError};
pub use ring::Ring;

use crate::NONE;
use crate::progress::Watch;

/// The adjacency of an oriented manifold mesh of polygons, with or without boundary.
///
/// Edges are numbered by their first occurrence in half-edge order, and every choice (the half-edge of an edge or vertex) is the
/// lowest possible index: equal meshes give equal topologies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    face_offsets: Vec<u32>,
    origins: Vec<u32>,
    faces: Vec<u32>,
    twins: Vec<u32>,
    edges: Vec<u32>,
    edge_half_edges: Vec<u32>,
    vertex_half_edges: Vec<u32>,
    face_valences: Vec<u32>,
}

impl Topology {
    /// Builds the adjacency of `vertex_count` vertices and the faces given as compressed rows: face `f` has the corners
    /// `face_offsets[f]..face_offsets[f + 1]` of `face_vertices`. Vertices without faces are allowed.
    ///
    /// # Errors
    /// Malformed rows, faces with fewer than three or repeated corners, vertices that do not exist, edges with more than two
    /// faces or run twice in the same direction, vertices whose faces are not one fan, and counts beyond 32 bits. The error names
    /// elements by their index.
    pub fn build(
        vertex_count: usize,
        face_offsets: impl Into<Vec<u32>>,
        face_vertices: impl Into<Vec<u32>>,
    ) -> Result<Self, TopologyError> {
        build::build(vertex_count, face_offsets.into(), face_vertices.into(), &Watch::nobody())
    }

    /// Number of half-edges, which is the number of face corners.
    #[must_use]
    pub fn half_edge_count(&self) -> usize {
        self.origins.len()
    }

    /// Number of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.edge_half_edges.len()
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_half_edges.len()
    }

    /// Number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.face_offsets.len() - 1
    }

    /// The half-edges of face `f`, in order of its corners.
    #[must_use]
    pub fn face_half_edges(&self, f: u32) -> Range<u32> {
        self.face_offsets[f as usize]..self.face_offsets[f as usize + 1]
    }

    /// The vertices of face `f`, in order of its corners.
    #[must_use]
    pub fn face_vertices(&self, f: u32) -> &[u32] {
        let corners = self.face_half_edges(f);
        &self.origins[corners.start as usize..corners.end as usize]
    }

    /// The vertex that half-edge `h` starts from.
    #[must_use]
    pub fn origin(&self, h: u32) -> u32 {
        self.origins[h as usize]
    }

    /// The vertex that half-edge `h` runs to.
    #[must_use]
    pub fn target(&self, h: u32) -> u32 {
        self.origin(self.next(h))
    }

    /// The next half-edge of the same face, counter-clockwise.
    #[must_use]
    pub fn next(&self, h: u32) -> u32 {
        let corners = self.face_half_edges(self.face(h));
        if h + 1 == corners.end { corners.start } else { h + 1 }
    }

    /// The previous half-edge of the same face.
    #[must_use]
    pub fn prev(&self, h: u32) -> u32 {
        let corners = self.face_half_edges(self.face(h));
        if h == corners.start { corners.end - 1 } else { h - 1 }
    }

    /// The face on the left of half-edge `h`.
    #[must_use]
    pub fn face(&self, h: u32) -> u32 {
        self.faces[h as usize]
    }

    /// The half-edge of the neighbouring face that runs the other way, [`NONE`] at a boundary.
    #[must_use]
    pub fn twin(&self, h: u32) -> u32 {
        self.twins[h as usize]
    }

    /// The edge that half-edge `h` belongs to.
    #[must_use]
    pub fn edge(&self, h: u32) -> u32 {
        self.edges[h as usize]
    }

    /// The half-edge of edge `e` with the lower index.
    #[must_use]
    pub fn edge_half_edge(&self, e: u32) -> u32 {
        self.edge_half_edges[e as usize]
    }

    /// True if edge `e` has one face only.
    #[must_use]
    pub fn is_boundary_edge(&self, e: u32) -> bool {
        self.twin(self.edge_half_edge(e)) == NONE
    }

    /// An outgoing half-edge of vertex `v`: at a boundary the one without a twin, elsewhere the lowest, [`NONE`] for a vertex
    /// without faces.
    #[must_use]
    pub fn vertex_half_edge(&self, v: u32) -> u32 {
        self.vertex_half_edges[v as usize]
    }

    /// True if vertex `v` has a boundary edge.
    #[must_use]
    pub fn is_boundary_vertex(&self, v: u32) -> bool {
        let h = self.vertex_half_edge(v);
        h != NONE && self.twin(h) == NONE
    }

    /// Number of edges at vertex `v`.
    #[must_use]
    pub fn valence(&self, v: u32) -> u32 {
        self.face_valence(v) + u32::from(self.is_boundary_vertex(v))
    }

    /// Number of faces at vertex `v`.
    #[must_use]
    pub fn face_valence(&self, v: u32) -> u32 {
        self.face_valences[v as usize]
    }

    /// The outgoing half-edges of vertex `v` counter-clockwise, from [`Topology::vertex_half_edge`].
    ///
    /// At a boundary the last edge of the vertex has no outgoing half-edge: it is `prev` of the last one returned.
    #[must_use]
    pub fn ring(&self, v: u32) -> Ring<'_> {
        Ring::new(self, self.vertex_half_edge(v))
    }

    /// The half-edge from vertex `a` to vertex `b`, in time proportional to the valence of `a`.
    #[must_use]
    pub fn find_half_edge(&self, a: u32, b: u32) -> Option<u32> {
        self.ring(a).find(|&h| self.target(h) == b)
    }

    /// The edge between vertices `a` and `b`, in either direction.
    #[must_use]
    pub fn find_edge(&self, a: u32, b: u32) -> Option<u32> {
        let h = self.find_half_edge(a, b).or_else(|| self.find_half_edge(b, a))?;
        Some(self.edge(h))
    }

    /// First corner of each face, and the number of corners at the end.
    #[must_use]
    pub fn face_offsets(&self) -> &[u32] {
        &self.face_offsets
    }

    /// The origin of each half-edge.
    #[must_use]
    pub fn origins(&self) -> &[u32] {
        &self.origins
    }

    /// The face of each half-edge.
    #[must_use]
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// The twin of each half-edge, [`NONE`] at a boundary.
    #[must_use]
    pub fn twins(&self) -> &[u32] {
        &self.twins
    }

    /// The edge of each half-edge.
    #[must_use]
    pub fn edges(&self) -> &[u32] {
        &self.edges
    }

    /// The lower half-edge of each edge.
    #[must_use]
    pub fn edge_half_edges(&self) -> &[u32] {
        &self.edge_half_edges
    }

    /// The half-edge of each vertex, as in [`Topology::vertex_half_edge`].
    #[must_use]
    pub fn vertex_half_edges(&self) -> &[u32] {
        &self.vertex_half_edges
    }

    /// Takes out the vertices that no face uses. Returns, for each vertex that is left, the index it had.
    pub(crate) fn drop_unused_vertices(&mut self) -> Vec<u32> {
        let kept: Vec<u32> = (0..self.vertex_count() as u32).filter(|&v| self.vertex_half_edge(v) != NONE).collect();
        if kept.len() == self.vertex_count() {
            return kept;
        }
        let mut renumbered = vec![NONE; self.vertex_count()];
        for (new, &old) in kept.iter().enumerate() {
            renumbered[old as usize] = new as u32;
        }
        for v in &mut self.origins {
            *v = renumbered[*v as usize];
        }
        self.vertex_half_edges = kept.iter().map(|&v| self.vertex_half_edges[v as usize]).collect();
        self.face_valences = kept.iter().map(|&v| self.face_valences[v as usize]).collect();
        kept
    }
}

#[cfg(test)]
mod tests;
