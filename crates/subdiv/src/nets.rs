//! Gathering the nets of final quads by walking half-edges. The letters V, E, F, O are those of ARCHITECTURE.md, "Conventions".

use std::collections::HashMap;
use std::iter::once;

use osculate_surface::NetKind;

use crate::needed::NeededPoints;
use crate::patches::{PatchKind, Tag};
use crate::unrefined::regular_face_net;
use crate::{Connectivity, NONE};

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

/// The final mesh: the quads of a mesh after one more step, with their points at `first_point` in the point buffer.
///
/// Final quads are numbered by the half-edges of that mesh, and all that a net needs lies in the faces about the half-edge.
pub(crate) struct FinalMesh<'a, M> {
    /// The mesh before the last step, all quads but for a first step.
    pub(crate) old: &'a M,
    pub(crate) first_point: u32,
    /// Index of the first old point in the point buffer.
    pub(crate) first_old: u32,
    /// What each old vertex makes of the final quads about it.
    pub(crate) tags: Vec<Tag>,
    /// The points that are computed, if not all are.
    pub(crate) needed: Option<NeededPoints>,
}

impl<M: Connectivity> FinalMesh<'_, M> {
    /// Number of final quads.
    pub(crate) fn quad_count(&self) -> usize {
        self.old.half_edge_count()
    }

    /// Number of points.
    pub(crate) fn point_count(&self) -> usize {
        let all = || self.old.face_count() + self.old.edge_count() + self.old.vertex_count();
        self.needed.as_ref().map_or_else(all, NeededPoints::len)
    }

    /// What the quad is, by its corner 0.
    pub(crate) fn tag(&self, quad: u32) -> Tag {
        self.tags[self.old.origin(quad) as usize]
    }

    /// Face point of the old face on the left of a half-edge.
    fn face(&self, h: u32) -> u32 {
        let face = self.old.face(h);
        self.first_point + self.needed.as_ref().map_or(face, |needed| needed.face(face))
    }

    /// Edge point of a half-edge.
    fn edge(&self, h: u32) -> u32 {
        let edge = self.old.edge(h);
        let number = || self.old.face_count() as u32 + edge;
        self.first_point + self.needed.as_ref().map_or_else(number, |needed| needed.edge(edge))
    }

    /// Vertex point of the origin of a half-edge.
    fn vertex(&self, h: u32) -> u32 {
        let vertex = self.old.origin(h);
        let number = || (self.old.face_count() + self.old.edge_count()) as u32 + vertex;
        self.first_point + self.needed.as_ref().map_or_else(number, |needed| needed.vertex(vertex))
    }

    /// Corners V, E, F, E' of a quad.
    fn corners(&self, quad: u32) -> [u32; 4] {
        [self.vertex(quad), self.edge(quad), self.face(quad), self.edge(self.old.prev(quad))]
    }

    /// Whether side 0 or side 3, the two that meet at corner 0, is a boundary edge. The other two are inside the face they came from.
    fn boundary_sides(&self, quad: u32) -> (bool, bool) {
        (self.old.twin(quad) == NONE, self.old.twin(self.old.prev(quad)) == NONE)
    }

    /// O1..O5: the points beyond sides 1 and 2, which belong to the rest of the old face.
    fn beyond(&self, quad: u32) -> [u32; 5] {
        let next = self.old.next(quad);
        let (across, prev) = (self.old.next(next), self.old.prev(quad));
        [self.vertex(next), self.edge(next), self.vertex(across), self.edge(across), self.vertex(prev)]
    }

    /// O0: the point at (2,-1). Side 0 must not be on the boundary.
    fn beyond_right(&self, quad: u32) -> u32 {
        self.edge(self.old.prev(self.old.twin(quad)))
    }

    /// O6: the point at (-1,2). Side 3 must not be on the boundary.
    fn beyond_above(&self, quad: u32) -> u32 {
        self.edge(self.old.next(self.old.twin(self.old.prev(quad))))
    }

    /// The points at (0,-1), (1,-1), (2,-1). Side 0 must not be on the boundary.
    fn below(&self, quad: u32) -> [u32; 3] {
        let below = self.old.twin(quad);
        [self.edge(self.old.next(below)), self.face(below), self.beyond_right(quad)]
    }

    /// The points at (-1,0), (-1,1), (-1,2). Side 3 must not be on the boundary.
    fn left(&self, quad: u32) -> [u32; 3] {
        let left = self.old.twin(self.old.prev(quad));
        [self.edge(self.old.prev(left)), self.face(left), self.beyond_above(quad)]
    }

    /// The 16 points of a regular quad away from the boundary.
    pub(crate) fn regular_net(&self, quad: u32) -> [u32; 16] {
        let [v, e0, f, e1] = self.corners(quad);
        let [o1, o2, o3, o4, o5] = self.beyond(quad);
        let [below_v, below_e0, below_o1] = self.below(quad);
        let [left_v, left_e1, left_o5] = self.left(quad);
        let corner = self.face(self.old.twin(self.old.next(self.old.twin(quad))));
        [corner, below_v, below_e0, below_o1, left_v, v, e0, o1, left_e1, e1, f, o2, left_o5, o5, o4, o3]
    }

    /// The 16 points of the face that a quad is a child of, if all corners of that are regular.
    pub(crate) fn unrefined_net(&self, quad: u32) -> [u32; 16] {
        regular_face_net(self.old, self.old.face(quad)).map(|vertex| self.first_old + vertex)
    }

    /// The 16 points of a regular quad with side 0 or side 3 or both on the boundary: points beyond it are phantoms.
    pub(crate) fn boundary_net(&self, quad: u32, phantoms: &mut Phantoms) -> [u32; 16] {
        let (below_open, left_open) = self.boundary_sides(quad);
        let [v, e0, f, e1] = self.corners(quad);
        let [o1, o2, o3, o4, o5] = self.beyond(quad);
        let [below_v, below_e0, below_o1] = if below_open {
            [phantoms.reflect(v, e1), phantoms.reflect(e0, f), phantoms.reflect(o1, o2)]
        } else {
            self.below(quad)
        };
        let [left_v, left_e1, left_o5] = if left_open {
            [phantoms.reflect(v, e0), phantoms.reflect(e1, f), phantoms.reflect(o5, o4)]
        } else {
            self.left(quad)
        };
        let corner = match (below_open, left_open) {
            (true, true) => phantoms.reflect_twice([v, e0, e1, f]),
            (true, false) => phantoms.reflect(left_v, left_e1),
            _ => phantoms.reflect(below_v, below_e0),
        };
        [corner, below_v, below_e0, below_o1, left_v, v, e0, o1, left_e1, e1, f, o2, left_o5, o5, o4, o3]
    }

    /// The 2n+8 points of a quad whose corner 0 is an inner vertex of valence n.
    pub(crate) fn interior_net(&self, quad: u32) -> impl Iterator<Item = u32> {
        once(self.vertex(quad))
            .chain(self.old.ring_from(quad).flat_map(|h| [self.edge(h), self.face(h)]))
            .chain(once(self.beyond_right(quad)))
            .chain(self.beyond(quad))
            .chain(once(self.beyond_above(quad)))
    }

    /// The sector net of a quad whose corner 0 lies on the boundary.
    pub(crate) fn sector_net(&self, quad: u32) -> Vec<u32> {
        let spokes: Vec<u32> = self.old.ring(self.old.origin(quad)).collect();
        let (below_open, left_open) = self.boundary_sides(quad);
        let mut net = vec![self.vertex(quad)];
        net.extend(spokes.iter().flat_map(|&h| [self.edge(h), self.face(h)]));
        net.extend(spokes.last().map(|&h| self.edge(self.old.prev(h))));
        if !below_open {
            net.push(self.beyond_right(quad));
        }
        net.extend(self.beyond(quad));
        if !left_open {
            net.push(self.beyond_above(quad));
        }
        net
    }

    /// The net of a quad.
    pub(crate) fn net_kind(&self, quad: u32) -> NetKind {
        let tag = self.tag(quad);
        if tag.kind() == PatchKind::Regular {
            NetKind::Regular
        } else if tag.is_boundary() {
            let vertex = self.old.origin(quad);
            let place = self.old.ring(vertex).position(|h| h == quad).unwrap_or(0) as u32;
            NetKind::Crease { faces: tag.valence() - 1, quad: place }
        } else {
            NetKind::Interior { valence: tag.valence() }
        }
    }
}
