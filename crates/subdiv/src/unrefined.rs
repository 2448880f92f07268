//! Faces that are left as they are where the rest of a cage is refined.
//!
//! A quad with four quads around each of its corners is a bicubic patch as it stands, so refining it makes four patches of one. Feature-adaptive subdivision
//! (Niessner, Loop, Meyer and DeRose, *Feature-adaptive GPU rendering of Catmull-Clark subdivision surfaces*, 2012) leaves such faces alone; where they meet
//! finer patches it needs patches of other patterns. Here records do: the curve and the cross field along an edge of such a face are cubics, so the whole edge
//! has one record, of which the two patches on its other side take a half each ([`crate::PatchRecord::is_half`]).

use rayon::prelude::*;

use crate::{Connectivity, NONE};

/// Which faces the refinement steps divide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Refinement {
    /// All of them, as in the report.
    #[default]
    Everywhere,
    /// Only those that must be: a quad with four quads around each of its corners, none of them at a boundary, stays one patch, with twice the segments of the
    /// others. Of a cage that takes two steps this holds for the second. It makes no difference to [`crate::Scheme::Gregory1`], which takes no step but for faces with
    /// more than four sides, and that one everywhere.
    WhereNeeded,
}

impl Refinement {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Everywhere, Self::WhereNeeded];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Everywhere => "everywhere",
            Self::WhereNeeded => "needed",
        }
    }
}

/// Where the points about each corner of a face lie in a 16-point net: the corner, then going around it the two edge neighbours that are not of the face, and
/// between them the vertex across.
const AROUND_CORNERS: [[usize; 4]; 4] = [[5, 4, 0, 1], [6, 2, 3, 7], [10, 11, 15, 14], [9, 13, 12, 8]];

/// Whether four quads surround a vertex.
pub(crate) fn is_regular_vertex(mesh: &impl Connectivity, vertex: u32) -> bool {
    mesh.vertex_half_edge(vertex) != NONE
        && !mesh.is_boundary_vertex(vertex)
        && mesh.face_valence(vertex) == 4
        && mesh.ring(vertex).all(|h| mesh.face_half_edges(mesh.face(h)).len() == 4)
}

/// The vertices of the 16-point net of a quad whose corners are all regular.
pub(crate) fn regular_face_net(mesh: &impl Connectivity, face: u32) -> [u32; 16] {
    // The next half-edge counter-clockwise around the same vertex.
    let rotated = |h: u32| mesh.twin(mesh.prev(h));
    let mut net = [0; 16];
    for (h, places) in mesh.face_half_edges(face).zip(AROUND_CORNERS) {
        let spoke = rotated(rotated(h));
        let across = mesh.target(mesh.next(spoke));
        let around = [mesh.origin(h), mesh.target(spoke), across, mesh.target(rotated(spoke))];
        for (place, vertex) in places.into_iter().zip(around) {
            net[place] = vertex;
        }
    }
    net
}

/// Whether each face is left unrefined: all its corners are regular, and it and the faces beyond its sides are drawn. `is_drawn` takes a half-edge of a face.
pub(crate) fn unrefined_faces(mesh: &impl Connectivity, is_drawn: impl Fn(u32) -> bool + Sync) -> Vec<bool> {
    let regular: Vec<bool> =
        (0..mesh.vertex_count() as u32).into_par_iter().map(|vertex| is_regular_vertex(mesh, vertex)).collect();
    let stays = |h: u32| regular[mesh.origin(h) as usize] && is_drawn(h) && is_drawn(mesh.twin(h));
    let is_quad = |face: u32| mesh.face_half_edges(face).len() == 4;
    let faces = 0..mesh.face_count() as u32;
    faces.into_par_iter().map(|face| is_quad(face) && mesh.face_half_edges(face).all(stays)).collect()
}
