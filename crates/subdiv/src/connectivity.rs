//! Half-edges of a cage and of its refinements.
//!
//! One Catmull-Clark step needs no search: the children of a half-edge are numbered by it, so twins of the refined mesh follow from twins of the old one
//! (Dupuy and Vanhoey, *A Halfedge Refinement Rule for Parallel Catmull-Clark Subdivision*, 2021).

use std::ops::Range;

use osculate_cage::Topology;
use rayon::prelude::*;

use crate::NONE;

/// Half-edges of a mesh without regard to where they come from. A half-edge is a face corner: it runs from its origin to the origin of the next
/// corner, with its face on the left.
pub trait Connectivity: Sync {
    /// Number of faces.
    fn face_count(&self) -> usize;
    /// Number of edges.
    fn edge_count(&self) -> usize;
    /// Number of vertices.
    fn vertex_count(&self) -> usize;
    /// Number of half-edges.
    fn half_edge_count(&self) -> usize;
    /// Half-edges of a face, in order.
    fn face_half_edges(&self, face: u32) -> Range<u32>;
    /// Face on the left.
    fn face(&self, h: u32) -> u32;
    /// Vertex where the half-edge begins.
    fn origin(&self, h: u32) -> u32;
    /// The half-edge of the same edge in the other direction, [`NONE`] on the boundary.
    fn twin(&self, h: u32) -> u32;
    /// Number of the half-edge's edge.
    fn edge(&self, h: u32) -> u32;
    /// The first half-edge of an edge.
    fn edge_half_edge(&self, edge: u32) -> u32;
    /// A half-edge that leaves the vertex; at a boundary the one without a twin.
    fn vertex_half_edge(&self, vertex: u32) -> u32;
    /// Next half-edge of the face.
    fn next(&self, h: u32) -> u32;
    /// Previous half-edge of the face.
    fn prev(&self, h: u32) -> u32;

    /// Vertex where the half-edge ends.
    fn target(&self, h: u32) -> u32 {
        self.origin(self.next(h))
    }

    /// Whether the vertex lies on the boundary.
    fn is_boundary_vertex(&self, vertex: u32) -> bool {
        self.twin(self.vertex_half_edge(vertex)) == NONE
    }

    /// Number of faces around the vertex: its valence, or one less on the boundary.
    fn face_valence(&self, vertex: u32) -> u32 {
        self.ring(vertex).count() as u32
    }

    /// Half-edges that leave the vertex, counter-clockwise, one per face around it.
    fn ring(&self, vertex: u32) -> Ring<'_, Self> {
        self.ring_from(self.vertex_half_edge(vertex))
    }

    /// The ring of the origin of `start`, beginning there. At a boundary it ends at the last face.
    fn ring_from(&self, start: u32) -> Ring<'_, Self> {
        Ring { mesh: self, start, at: start }
    }
}

/// See [`Connectivity::ring`].
pub struct Ring<'a, M: ?Sized> {
    mesh: &'a M,
    start: u32,
    at: u32,
}

impl<M: Connectivity + ?Sized> Iterator for Ring<'_, M> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.at == NONE {
            return None;
        }
        let h = self.at;
        let rotated = self.mesh.twin(self.mesh.prev(h));
        self.at = if rotated == self.start { NONE } else { rotated };
        Some(h)
    }
}

impl Connectivity for Topology {
    fn face_count(&self) -> usize {
        Topology::face_count(self)
    }
    fn edge_count(&self) -> usize {
        Topology::edge_count(self)
    }
    fn vertex_count(&self) -> usize {
        Topology::vertex_count(self)
    }
    fn half_edge_count(&self) -> usize {
        Topology::half_edge_count(self)
    }
    fn face_half_edges(&self, face: u32) -> Range<u32> {
        Topology::face_half_edges(self, face)
    }
    fn face(&self, h: u32) -> u32 {
        Topology::face(self, h)
    }
    fn origin(&self, h: u32) -> u32 {
        Topology::origin(self, h)
    }
    fn twin(&self, h: u32) -> u32 {
        Topology::twin(self, h)
    }
    fn edge(&self, h: u32) -> u32 {
        Topology::edge(self, h)
    }
    fn edge_half_edge(&self, edge: u32) -> u32 {
        Topology::edge_half_edge(self, edge)
    }
    fn vertex_half_edge(&self, vertex: u32) -> u32 {
        Topology::vertex_half_edge(self, vertex)
    }
    fn next(&self, h: u32) -> u32 {
        Topology::next(self, h)
    }
    fn prev(&self, h: u32) -> u32 {
        Topology::prev(self, h)
    }
    fn face_valence(&self, vertex: u32) -> u32 {
        Topology::face_valence(self, vertex)
    }
}

/// The half-edges of a quad mesh that came out of a Catmull-Clark step: face `f` has the half-edges `4 f .. 4 f + 4`, and its vertices are, in order, a
/// vertex point, an edge point, a face point and an edge point. Vertices are numbered face points, edge points, vertex points.
pub struct QuadConnectivity {
    vertex_count: usize,
    origin: Vec<u32>,
    twin: Vec<u32>,
    edge: Vec<u32>,
    edge_half_edge: Vec<u32>,
    vertex_half_edge: Vec<u32>,
}

impl QuadConnectivity {
    /// The mesh after one step on `old`. The caller makes sure that four half-edges per old half-edge fit 32 bits.
    pub fn refine(old: &impl Connectivity) -> Self {
        let (faces, edges) = (old.face_count() as u32, old.edge_count() as u32);
        let corners = old.half_edge_count();
        let mut origin = vec![0u32; 4 * corners];
        let mut twin = vec![0u32; 4 * corners];
        origin.par_chunks_exact_mut(4).zip(twin.par_chunks_exact_mut(4)).enumerate().with_min_len(4096).for_each(
            |(c, (origin, twin))| {
                let c = c as u32;
                let (prev, next) = (old.prev(c), old.next(c));
                origin.copy_from_slice(&[
                    faces + edges + old.origin(c),
                    faces + old.edge(c),
                    old.face(c),
                    faces + old.edge(prev),
                ]);
                let (t, t_prev) = (old.twin(c), old.twin(prev));
                twin[0] = if t == NONE { NONE } else { 4 * old.next(t) + 3 };
                twin[1] = 4 * next + 2;
                twin[2] = 4 * prev + 1;
                twin[3] = if t_prev == NONE { NONE } else { 4 * t_prev };
            },
        );
        let (edge, edge_half_edge) = number_edges(&twin);
        Self {
            vertex_count: (faces + edges) as usize + old.vertex_count(),
            origin,
            vertex_half_edge: vertex_half_edges(old),
            twin,
            edge,
            edge_half_edge,
        }
    }
}

/// Numbers edges by first occurrence in half-edge order: the edge of every half-edge, and the first half-edge of every edge.
fn number_edges(twin: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut edge = vec![0u32; twin.len()];
    let mut first = Vec::with_capacity(twin.len() / 2 + twin.len() / 16);
    for (h, &t) in twin.iter().enumerate() {
        // NONE is the largest number, so a boundary half-edge is first, too.
        if t > h as u32 {
            edge[h] = first.len() as u32;
            first.push(h as u32);
        } else {
            edge[h] = edge[t as usize];
        }
    }
    (edge, first)
}

/// An outgoing half-edge of every refined vertex, at a boundary the one without a twin.
fn vertex_half_edges(old: &impl Connectivity) -> Vec<u32> {
    let face_points = (0..old.face_count() as u32).into_par_iter().map(|f| 4 * old.face_half_edges(f).start + 2);
    let edge_points = (0..old.edge_count() as u32).into_par_iter().map(|e| {
        let h = old.edge_half_edge(e);
        if old.twin(h) == NONE { 4 * old.next(h) + 3 } else { 4 * h + 1 }
    });
    let vertex_points = (0..old.vertex_count() as u32).into_par_iter().map(|v| 4 * old.vertex_half_edge(v));
    face_points.chain(edge_points).chain(vertex_points).collect()
}

impl Connectivity for QuadConnectivity {
    fn face_count(&self) -> usize {
        self.origin.len() / 4
    }
    fn edge_count(&self) -> usize {
        self.edge_half_edge.len()
    }
    fn vertex_count(&self) -> usize {
        self.vertex_count
    }
    fn half_edge_count(&self) -> usize {
        self.origin.len()
    }
    fn face_half_edges(&self, face: u32) -> Range<u32> {
        4 * face..4 * face + 4
    }
    fn face(&self, h: u32) -> u32 {
        h / 4
    }
    fn origin(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }
    fn twin(&self, h: u32) -> u32 {
        self.twin[h as usize]
    }
    fn edge(&self, h: u32) -> u32 {
        self.edge[h as usize]
    }
    fn edge_half_edge(&self, edge: u32) -> u32 {
        self.edge_half_edge[edge as usize]
    }
    fn vertex_half_edge(&self, vertex: u32) -> u32 {
        self.vertex_half_edge[vertex as usize]
    }
    fn next(&self, h: u32) -> u32 {
        (h & !3) | ((h + 1) & 3)
    }
    fn prev(&self, h: u32) -> u32 {
        (h & !3) | ((h + 3) & 3)
    }
}
