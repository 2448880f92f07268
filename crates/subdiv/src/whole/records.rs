//! Records of vertices and edges of whole faces, each owned by the first patch in patch order that has it.

use rayon::prelude::*;

use super::faces::WholeMesh;
use super::fans::Fans;
use super::{GatheredEdge, GatheredPatch, Gathers, control_points};
use crate::rank::RankedSet;
use crate::records::RecordSources;
use crate::{Connectivity, NONE, PatchForm, PatchKind, PatchRecord};

/// What [`assign`] makes.
pub(super) struct WholeRecords {
    pub(super) patches: Vec<PatchRecord>,
    pub(super) vertices: RecordSources,
    pub(super) edges: RecordSources,
    pub(super) gathers: Gathers,
    /// Whether each edge record belongs to one drawn patch only.
    pub(super) boundary_edges: Vec<bool>,
    /// Vectors of the fans and control points.
    pub(super) vector_count: u32,
}

/// Gives every vertex and edge of drawn patches a record, and every stored patch its control points, which follow the vectors of the fans.
pub(super) fn assign<M: Connectivity>(whole: &WholeMesh<'_, M>, fans: &Fans, first_vector: u32) -> WholeRecords {
    let owned = Owned::new(whole);
    let first_irregular = 4 * whole.regular_count();
    let split = |mut slots: Vec<u32>| {
        let rest = slots.split_off(slots.partition_point(|&slot| slot < first_irregular));
        (slots, rest)
    };
    let ((regular, general), edge_slots) = (split(owned.vertices.members()), owned.edges.members());
    let origin = |&slot: &u32| whole.mesh.origin(whole.half_edge(slot));
    let general = general.iter().map(|slot| fans.vertices[fans.of(origin(slot)) as usize]).collect();
    let vertices = RecordSources { regular, general };
    let is_boundary = |&slot: &u32| whole.slot(whole.mesh.twin(whole.half_edge(slot))) == NONE;
    let boundary_edges = edge_slots.par_iter().map(is_boundary).collect();
    let (regular, gathered) = split(edge_slots);
    let edges = gathered.par_iter().map(|&slot| gathered_edge(whole, fans, whole.half_edge(slot))).collect();
    let (stored, vector_count) = gathered_patches(whole, fans, first_vector);
    WholeRecords {
        patches: owned.patch_records(&stored),
        vertices,
        edges: RecordSources { regular, general: Vec::new() },
        gathers: Gathers { fans: fans.records.clone(), edges, patches: stored, irregular: fans.irregular() },
        boundary_edges,
        vector_count,
    }
}

fn gathered_edge<M: Connectivity>(whole: &WholeMesh<'_, M>, fans: &Fans, h: u32) -> GatheredEdge {
    let mesh = whole.mesh;
    GatheredEdge {
        fan: [mesh.origin(h), mesh.target(h)].map(|v| fans.of(v)),
        edge: [fans.place(h), fans.place_at_target(mesh, h)],
    }
}

/// Sources of all stored patches, and the number of vectors after them.
fn gathered_patches<M: Connectivity>(
    whole: &WholeMesh<'_, M>,
    fans: &Fans,
    first_vector: u32,
) -> (Vec<GatheredPatch>, u32) {
    let mut first = first_vector;
    let source = |(patch, form): (u32, PatchForm)| {
        let sides = whole.sides(patch);
        let mut source = GatheredPatch { fan: [NONE; 4], edge: [0; 4], first, sides: sides.len() as u32 };
        for (corner, h) in sides.enumerate() {
            source.fan[corner] = fans.of(whole.mesh.origin(h));
            source.edge[corner] = fans.place(h);
        }
        first += control_points(form);
        source
    };
    let sources = whole.stored().map(source).collect();
    (sources, first)
}

/// The slots that own a record, in the order of the records.
struct Owned<'a, M> {
    whole: &'a WholeMesh<'a, M>,
    /// Lowest slot of each vertex.
    owners: Vec<u32>,
    vertices: RankedSet,
    edges: RankedSet,
}

impl<'a, M: Connectivity> Owned<'a, M> {
    fn new(whole: &'a WholeMesh<'a, M>) -> Self {
        let mesh = whole.mesh;
        let lowest = |v| match mesh.vertex_half_edge(v) {
            NONE => NONE,
            _ => mesh.ring(v).map(|h| whole.slot(h)).min().unwrap_or(NONE),
        };
        let owners: Vec<u32> = (0..mesh.vertex_count() as u32).into_par_iter().map(lowest).collect();
        let word = |i: usize| {
            let (mut vertices, mut edges) = (0, 0);
            for patch in 16 * i as u32..whole.faces.len().min(16 * i + 16) as u32 {
                for (k, h) in (0..).zip(whole.sides(patch)) {
                    let (slot, bit) = (4 * patch + k, 4 * (patch % 16) + k);
                    vertices |= u64::from(owners[mesh.origin(h) as usize] == slot) << bit;
                    edges |= u64::from(slot < whole.slot(mesh.twin(h))) << bit;
                }
            }
            (vertices, edges)
        };
        let (vertices, edges): (Vec<u64>, Vec<u64>) =
            (0..whole.faces.len().div_ceil(16)).into_par_iter().with_min_len(64).map(word).unzip();
        Self { whole, owners, vertices: RankedSet::new(vertices), edges: RankedSet::new(edges) }
    }

    /// Number of the record of a half-edge's edge, as in [`PatchRecord::edge`].
    fn edge_record(&self, h: u32) -> u32 {
        let (slot, twin) = (self.whole.slot(h), self.whole.slot(self.whole.mesh.twin(h)));
        if slot < twin { 2 * self.edges.rank(slot) } else { 2 * self.edges.rank(twin) + 1 }
    }

    fn patch_records(&self, stored: &[GatheredPatch]) -> Vec<PatchRecord> {
        let regular = self.whole.regular_count();
        let record = |patch: u32| {
            let mut record = PatchRecord { vertex: [NONE; 4], edge: [NONE; 4], ..self.shape(patch, regular, stored) };
            for (k, h) in self.whole.sides(patch).enumerate() {
                record.vertex[k] = self.vertices.rank(self.owners[self.whole.mesh.origin(h) as usize]);
                record.edge[k] = self.edge_record(h);
            }
            record
        };
        (0..self.whole.faces.len() as u32).into_par_iter().map(record).collect()
    }

    /// `net`, `net_size` and `tag` of a patch.
    fn shape(&self, patch: u32, regular: u32, stored: &[GatheredPatch]) -> PatchRecord {
        let tag = |kind| PatchRecord::tag_of(kind, self.touches_boundary(patch), self.most_irregular(patch));
        let Some(source) = patch.checked_sub(regular).map(|i| &stored[i as usize]) else {
            return PatchRecord {
                net: 16 * patch,
                net_size: 16,
                tag: tag(PatchKind::Regular),
                ..PatchRecord::default()
            };
        };
        let form = if source.sides == 3 { PatchForm::Triangle } else { PatchForm::Gregory };
        let tag = tag(PatchKind::Stored { form });
        PatchRecord { net: source.first, net_size: control_points(form), tag, ..PatchRecord::default() }
    }

    fn touches_boundary(&self, patch: u32) -> bool {
        self.whole.sides(patch).any(|h| self.whole.mesh.is_boundary_vertex(self.whole.mesh.origin(h)))
    }

    /// The number of edges of the corner that is furthest from regular.
    fn most_irregular(&self, patch: u32) -> u32 {
        let mesh = self.whole.mesh;
        let edges = |h| {
            let vertex = mesh.origin(h);
            let boundary = mesh.is_boundary_vertex(vertex);
            let (faces, regular) = (mesh.face_valence(vertex), if boundary { 2 } else { 4 });
            (faces.abs_diff(regular), faces + u32::from(boundary))
        };
        self.whole.sides(patch).map(edges).max().map_or(4, |(_, edges)| edges)
    }
}
