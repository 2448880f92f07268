//! The topology of some faces of a mesh.

use super::Topology;
use super::build::{find_vertex_half_edges, number_edges};
use crate::NONE;
use crate::progress::Watch;

impl Topology {
    /// The topology of some faces, given rising; `numbers` gives for each face of this topology its place among them, [`NONE`] if it is not there. Also
    /// returns the vertex here of each vertex there: a vertex whose faces are left in several fans becomes one for each, so that the mesh is a manifold.
    ///
    /// Nothing is searched: twins are known.
    pub(crate) fn restricted(&self, faces: &[u32], numbers: &[u32]) -> (Self, Vec<u32>) {
        let mut face_offsets = Vec::with_capacity(faces.len() + 1);
        let mut end = 0;
        face_offsets.push(end);
        for &f in faces {
            end += self.face_half_edges(f).len() as u32;
            face_offsets.push(end);
        }
        let local = |h: u32| match h {
            NONE => NONE,
            h => match numbers[self.face(h) as usize] {
                NONE => NONE,
                f => face_offsets[f as usize] + (h - self.face_half_edges(self.face(h)).start),
            },
        };
        let half_edges = || faces.iter().flat_map(|&f| self.face_half_edges(f));
        let twins = half_edges().map(|h| local(self.twin(h))).collect();
        let mut topology = Self {
            faces: (0..).zip(faces).flat_map(|(i, &f)| std::iter::repeat_n(i, self.face_half_edges(f).len())).collect(),
            origins: vec![NONE; end as usize],
            twins,
            face_offsets,
            edges: Vec::new(),
            edge_half_edges: Vec::new(),
            vertex_half_edges: Vec::new(),
            face_valences: Vec::new(),
        };
        let mut vertices = Vec::new();
        for (h, whole) in (0..end).zip(half_edges()) {
            if topology.origins[h as usize] == NONE {
                topology.name_fan(h, vertices.len() as u32);
                vertices.push(self.origin(whole));
            }
        }
        let watch = Watch::nobody();
        // Nobody watches, so nobody cancels.
        let _uncancelled = number_edges(&mut topology, &watch)
            .and_then(|()| find_vertex_half_edges(&mut topology, vertices.len(), &watch));
        (topology, vertices)
    }

    /// Makes `vertex` the origin of all half-edges in the fan of one.
    fn name_fan(&mut self, h: u32, vertex: u32) {
        // Counter-clockwise, then, if that ends at a boundary, clockwise from the start.
        let mut at = h;
        while at != NONE {
            self.origins[at as usize] = vertex;
            at = self.twin(self.prev(at));
            if at == h {
                return;
            }
        }
        let clockwise = |topology: &Self, h: u32| match topology.twin(h) {
            NONE => NONE,
            twin => topology.next(twin),
        };
        at = clockwise(self, h);
        while at != NONE {
            self.origins[at as usize] = vertex;
            at = clockwise(self, at);
        }
    }
}
