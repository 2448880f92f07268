//! Gathering the nets of final quads by walking half-edges. The letters V, E, F, O are those of ARCHITECTURE.md, "Conventions".

use std::collections::HashMap;

use crate::{Connectivity, NONE, QuadConnectivity};

/// Points beyond the boundary that regular nets ask for, each once.
///
/// A phantom is the reflection 2a - b of an inner point b in a boundary point a, or beyond a one-face corner the reflection of a reflection,
/// 2 (2a - b) - (2c - d). A plain reflection is written (a, b, a, b), which the second form computes exactly.
pub(crate) struct Phantoms {
    first: u32,
    ids: HashMap<[u32; 4], u32>,
    /// Indices (a, b, c, d) in the point buffer.
    pub(crate) reflections: Vec<[u32; 4]>,
}

impl Phantoms {
    /// Phantom points are numbered from `first` in the point buffer.
    pub(crate) fn new(first: u32) -> Self {
        Self { first, ids: HashMap::new(), reflections: Vec::new() }
    }

    fn reflect(&mut self, a: u32, b: u32) -> u32 {
        self.reflect_twice([a, b, a, b])
    }

    fn reflect_twice(&mut self, reflection: [u32; 4]) -> u32 {
        *self.ids.entry(reflection).or_insert_with(|| {
            self.reflections.push(reflection);
            self.first + (self.reflections.len() - 1) as u32
        })
    }
}

/// The final mesh, with its points at `first_point` in the point buffer.
pub(crate) struct FinalMesh<'a> {
    pub(crate) mesh: &'a QuadConnectivity,
    pub(crate) first_point: u32,
}

impl FinalMesh<'_> {
    fn origin(&self, h: u32) -> u32 {
        self.first_point + self.mesh.origin(h)
    }

    fn target(&self, h: u32) -> u32 {
        self.origin(self.mesh.next(h))
    }

    /// Half-edge two after `h`.
    fn across(&self, h: u32) -> u32 {
        self.mesh.next(self.mesh.next(h))
    }

    /// Corners V, E, F, E' of a quad.
    fn corners(&self, quad: u32) -> [u32; 4] {
        [0, 1, 2, 3].map(|k| self.origin(4 * quad + k))
    }

    /// Whether side 0 or side 3, the two that meet at corner 0, is a boundary edge. The other two are inside the face they came from.
    pub(crate) fn boundary_sides(&self, quad: u32) -> (bool, bool) {
        (self.mesh.twin(4 * quad) == NONE, self.mesh.twin(4 * quad + 3) == NONE)
    }

    /// O1..O5: the points beyond sides 1 and 2.
    fn beyond(&self, quad: u32) -> [u32; 5] {
        let right = self.mesh.twin(4 * quad + 1);
        let above = self.mesh.twin(4 * quad + 2);
        let beside = self.mesh.twin(self.mesh.prev(right));
        [
            self.target(self.mesh.next(right)),
            self.target(self.across(right)),
            self.target(self.mesh.next(beside)),
            self.target(self.mesh.next(above)),
            self.target(self.across(above)),
        ]
    }

    /// O0: the point at (2,-1). Side 0 must not be on the boundary.
    fn beyond_right(&self, quad: u32) -> u32 {
        let right = self.mesh.twin(4 * quad + 1);
        self.target(self.across(self.mesh.twin(self.mesh.next(right))))
    }

    /// O6: the point at (-1,2). Side 3 must not be on the boundary.
    fn beyond_above(&self, quad: u32) -> u32 {
        let above = self.mesh.twin(4 * quad + 2);
        self.target(self.mesh.next(self.mesh.twin(self.mesh.prev(above))))
    }

    /// The 16 points of a regular quad away from the boundary.
    pub(crate) fn regular_net(&self, quad: u32) -> [u32; 16] {
        let [v, e0, f, e1] = self.corners(quad);
        let [o1, o2, o3, o4, o5] = self.beyond(quad);
        let below = self.mesh.next(self.mesh.twin(4 * quad));
        let left = self.mesh.next(self.mesh.twin(4 * quad + 3));
        let corner = self.origin(self.mesh.prev(self.mesh.twin(below)));
        [
            corner,
            self.target(below),
            self.target(self.mesh.next(below)),
            self.beyond_right(quad),
            self.target(self.mesh.next(left)),
            v,
            e0,
            o1,
            self.target(left),
            e1,
            f,
            o2,
            self.beyond_above(quad),
            o5,
            o4,
            o3,
        ]
    }

    /// The 16 points of a regular quad with side 0 or side 3 or both on the boundary: points beyond it are phantoms.
    pub(crate) fn boundary_net(&self, quad: u32, phantoms: &mut Phantoms) -> [u32; 16] {
        let (below_open, left_open) = self.boundary_sides(quad);
        let [v, e0, f, e1] = self.corners(quad);
        let [o1, o2, o3, o4, o5] = self.beyond(quad);
        let [below_v, below_e0, below_o1] = if below_open {
            [phantoms.reflect(v, e1), phantoms.reflect(e0, f), phantoms.reflect(o1, o2)]
        } else {
            let below = self.mesh.next(self.mesh.twin(4 * quad));
            [self.target(below), self.target(self.mesh.next(below)), self.beyond_right(quad)]
        };
        let [left_v, left_e1, left_o5] = if left_open {
            [phantoms.reflect(v, e0), phantoms.reflect(e1, f), phantoms.reflect(o5, o4)]
        } else {
            let left = self.mesh.next(self.mesh.twin(4 * quad + 3));
            [self.target(self.mesh.next(left)), self.target(left), self.beyond_above(quad)]
        };
        let corner = match (below_open, left_open) {
            (true, true) => phantoms.reflect_twice([v, e0, e1, f]),
            (true, false) => phantoms.reflect(left_v, left_e1),
            _ => phantoms.reflect(below_v, below_e0),
        };
        [corner, below_v, below_e0, below_o1, left_v, v, e0, o1, left_e1, e1, f, o2, left_o5, o5, o4, o3]
    }

    /// The 2n+8 points of a quad whose corner 0 is an inner vertex of valence n.
    pub(crate) fn interior_net(&self, quad: u32) -> Vec<u32> {
        let mut net = vec![self.origin(4 * quad)];
        net.extend(self.mesh.ring_from(4 * quad).flat_map(|h| [self.target(h), self.target(self.mesh.next(h))]));
        net.push(self.beyond_right(quad));
        net.extend(self.beyond(quad));
        net.push(self.beyond_above(quad));
        net
    }

    /// The sector net of a quad whose corner 0 lies on the boundary.
    pub(crate) fn sector_net(&self, quad: u32) -> Vec<u32> {
        let vertex = self.mesh.origin(4 * quad);
        let spokes: Vec<u32> = self.mesh.ring(vertex).collect();
        let place = spokes.iter().position(|&h| h == 4 * quad).unwrap_or(0);
        let mut net = vec![self.origin(4 * quad)];
        net.extend(spokes.iter().flat_map(|&h| [self.target(h), self.target(self.mesh.next(h))]));
        net.extend(spokes.last().map(|&h| self.origin(self.mesh.prev(h))));
        if place > 0 {
            net.push(self.beyond_right(quad));
        }
        net.extend(self.beyond(quad));
        if place + 1 < spokes.len() {
            net.push(self.beyond_above(quad));
        }
        net
    }
}
