//! Faces as patches: which are drawn, which are bicubic, and the nets of those.

use osculate_cage::BoundaryRule;
use osculate_surface::gregory::Fan;
use rayon::prelude::*;

use crate::tables::is_corner;
use crate::unrefined::{is_regular_vertex, regular_face_net};
use crate::{Connectivity, NONE, PatchForm, PatchKind, PatchList};

/// A mesh of quads and triangles with its patches.
pub(super) struct WholeMesh<'a, M> {
    pub(super) mesh: &'a M,
    rule: BoundaryRule,
    /// Number of the first vertex in the point buffer.
    first_point: u32,
    /// Lists by kind: regular, quads, triangles; empty ones are left out.
    pub(super) lists: Vec<PatchList>,
    /// Face of each patch.
    pub(super) faces: Vec<u32>,
    /// Patch of each face, [`NONE`] if it is not drawn.
    pub(super) patch_of_face: Vec<u32>,
    /// Nets of the regular list.
    pub(super) nets: Vec<u32>,
}

/// Kinds in the order of their lists.
const KINDS: [PatchKind; 3] = [
    PatchKind::Regular,
    PatchKind::Stored { form: PatchForm::Gregory },
    PatchKind::Stored { form: PatchForm::Triangle },
];

impl<'a, M: Connectivity> WholeMesh<'a, M> {
    pub(super) fn new(
        mesh: &'a M,
        first_point: u32,
        rule: BoundaryRule,
        is_drawn: impl Fn(u32) -> bool + Sync,
    ) -> Self {
        let regular: Vec<bool> =
            (0..mesh.vertex_count() as u32).into_par_iter().map(|v| is_regular_vertex(mesh, v)).collect();
        let kind = |face| is_drawn(face).then(|| kind_of(mesh, &regular, face));
        let kinds: Vec<Option<PatchKind>> = (0..mesh.face_count() as u32).into_par_iter().map(kind).collect();
        let mut whole = Self {
            mesh,
            rule,
            first_point,
            lists: Vec::new(),
            faces: Vec::new(),
            patch_of_face: vec![NONE; kinds.len()],
            nets: Vec::new(),
        };
        for kind in KINDS {
            let first_patch = whole.faces.len() as u32;
            whole.faces.extend((0..kinds.len() as u32).filter(|&face| kinds[face as usize] == Some(kind)));
            let count = whole.faces.len() as u32 - first_patch;
            if count > 0 {
                let first_index = if first_patch == 0 { 0 } else { 16 * whole.regular_count() };
                whole.lists.push(PatchList { kind, first_patch, count, drawn: count, first_index, weights: 0 });
            }
        }
        for (patch, &face) in whole.faces.iter().enumerate() {
            whole.patch_of_face[face as usize] = patch as u32;
        }
        let regular_faces = &whole.faces[..whole.regular_count() as usize];
        whole.nets = regular_faces.par_iter().flat_map_iter(|&face| whole.regular_net(face)).collect();
        whole
    }

    /// How many patches are regular; they come first.
    pub(super) fn regular_count(&self) -> u32 {
        self.lists.first().filter(|list| list.kind == PatchKind::Regular).map_or(0, |list| list.count)
    }

    /// Patches whose control points are stored, with their formula.
    pub(super) fn stored(&self) -> impl Iterator<Item = (u32, PatchForm)> {
        let lists = self.lists.iter().filter(|list| list.kind.is_stored());
        lists.flat_map(|list| (list.first_patch..list.first_patch + list.count).map(|patch| (patch, list.kind.form())))
    }

    /// The half-edges of a patch's face.
    pub(super) fn sides(&self, patch: u32) -> std::ops::Range<u32> {
        self.mesh.face_half_edges(self.faces[patch as usize])
    }

    /// Four times the patch on the left of a half-edge, plus the half-edge's number in its face; [`NONE`] where nothing is drawn.
    pub(super) fn slot(&self, h: u32) -> u32 {
        if h == NONE {
            return NONE;
        }
        let face = self.mesh.face(h);
        match self.patch_of_face[face as usize] {
            NONE => NONE,
            patch => 4 * patch + (h - self.mesh.face_half_edges(face).start),
        }
    }

    /// The half-edge of a slot.
    pub(super) fn half_edge(&self, slot: u32) -> u32 {
        self.sides(slot / 4).start + slot % 4
    }

    /// A vertex in the point buffer.
    pub(super) fn point(&self, vertex: u32) -> u32 {
        self.first_point + vertex
    }

    /// The centroid of a face in the point buffer.
    pub(super) fn centroid(&self, face: u32) -> u32 {
        self.first_centroid() + face
    }

    /// Number of the first centroid in the point buffer: they follow the vertices.
    pub(super) fn first_centroid(&self) -> u32 {
        self.first_point + self.mesh.vertex_count() as u32
    }

    /// What the faces about a vertex are.
    pub(super) fn fan(&self, vertex: u32) -> Fan {
        let faces = self.mesh.face_valence(vertex);
        if !self.mesh.is_boundary_vertex(vertex) {
            Fan::Interior { valence: faces }
        } else if is_corner(self.mesh, self.rule, vertex) {
            Fan::Corner
        } else {
            Fan::Crease { faces }
        }
    }

    fn regular_net(&self, face: u32) -> [u32; 16] {
        regular_face_net(self.mesh, face).map(|vertex| self.point(vertex))
    }
}

fn sides(mesh: &impl Connectivity, face: u32) -> usize {
    mesh.face_half_edges(face).len()
}

fn kind_of(mesh: &impl Connectivity, regular: &[bool], face: u32) -> PatchKind {
    match sides(mesh, face) {
        3 => PatchKind::Stored { form: PatchForm::Triangle },
        _ if mesh.face_half_edges(face).all(|h| regular[mesh.origin(h) as usize]) => PatchKind::Regular,
        _ => PatchKind::Stored { form: PatchForm::Gregory },
    }
}
