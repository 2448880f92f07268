//! The points of a refinement step that something is made of, where faces are left unrefined.

use rayon::prelude::*;

use crate::rank::RankedSet;
use crate::{Connectivity, RefineTables};

/// The elements of a mesh whose new points are computed. They are numbered in their order, the others left out.
pub(crate) struct NeededPoints {
    faces: RankedSet,
    edges: RankedSet,
    vertices: RankedSet,
}

impl NeededPoints {
    /// Those that patches of refined faces are made of: the corners of these faces, and whatever meets at such a corner. `is_refined` takes a half-edge of a face.
    pub(crate) fn new(mesh: &impl Connectivity, is_refined: impl Fn(u32) -> bool + Sync) -> Self {
        let vertices = RankedSet::of(mesh.vertex_count(), |v| mesh.ring(v).any(&is_refined));
        let edges = RankedSet::of(mesh.edge_count(), |e| {
            let h = mesh.edge_half_edge(e);
            vertices.contains(mesh.origin(h)) || vertices.contains(mesh.target(h))
        });
        let faces =
            RankedSet::of(mesh.face_count(), |f| mesh.face_half_edges(f).any(|h| vertices.contains(mesh.origin(h))));
        Self { faces, edges, vertices }
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.faces.len() + self.edges.len() + self.vertices.len()
    }

    /// The number of the new point of a face, among all that are computed.
    pub(crate) fn face(&self, face: u32) -> u32 {
        self.faces.rank(face)
    }

    /// The number of the new point of an edge.
    pub(crate) fn edge(&self, edge: u32) -> u32 {
        self.faces.len() as u32 + self.edges.rank(edge)
    }

    /// The number of the new point of a vertex.
    pub(crate) fn vertex(&self, vertex: u32) -> u32 {
        (self.faces.len() + self.edges.len()) as u32 + self.vertices.rank(vertex)
    }

    /// The tables of a step without the rows of points that are not computed. Distances from old points to new ones are no longer the same, so the rows of V end
    /// with the old point.
    pub(crate) fn tables(&self, all: &RefineTables) -> RefineTables {
        let first_new = all.first_new;
        let renumbered = |i: u32| if i < first_new { i } else { first_new + self.face(i - first_new) };
        let row = |[offset, length]: [u32; 2]| offset as usize..(offset + length) as usize;
        let (mut face_spans, mut face_indices) = (Vec::new(), Vec::new());
        for face in self.faces.members() {
            let span = all.face_spans[face as usize];
            face_spans.push([face_indices.len() as u32, span[1]]);
            face_indices.extend_from_slice(&all.face_indices[row(span)]);
        }
        let edges = self.edges.members();
        let edge_indices = edges.par_iter().map(|&edge| all.edge_indices[edge as usize].map(renumbered)).collect();
        let (mut vertex_spans, mut vertex_indices) = (Vec::new(), Vec::new());
        for vertex in self.vertices.members() {
            let [offset, valence] = all.vertex_spans[vertex as usize];
            vertex_spans.push([vertex_indices.len() as u32, valence]);
            vertex_indices.extend(all.vertex_indices[row([offset, 2 * valence])].iter().map(|&i| renumbered(i)));
            vertex_indices.push(all.first_old + vertex);
        }
        RefineTables { face_spans, face_indices, edge_indices, vertex_spans, vertex_indices, old_in_rows: true, ..*all }
    }
}
