//! Vertex and edge records: which patch each is computed from, and which records a patch names.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use crate::gather::PatchNets;
use crate::lists::PatchOrder;
use crate::nets::FinalMesh;
use crate::projections::Projections;
use crate::rank::RankedSet;
use crate::spokes::{SpokeRecord, SpokeSide, spoke_records};
use crate::weights::{Role, WeightTable};
use crate::{Connectivity, NONE, PatchForm, PatchKind, PatchRecord};

/// A matrix of weights times a net (`MatrixSource` in shaders/include/sources.glsl).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct MatrixSource {
    /// First index of the net in the nets.
    pub net: u32,
    /// First weight, row-major, in the weights.
    pub weights: u32,
    /// Points of the net, columns of the matrix.
    pub columns: u32,
}

/// Where the records of one sort come from. Records are numbered regular ones first.
#[derive(Default)]
pub struct RecordSources {
    /// Records of regular nets: patch number times four, plus the corner or side.
    pub regular: Vec<u32>,
    /// The others: a matrix times a net.
    pub general: Vec<MatrixSource>,
}

impl RecordSources {
    /// Number of records.
    pub fn count(&self) -> usize {
        self.regular.len() + self.general.len()
    }
}

/// What [`assign`] makes.
pub(crate) struct Records {
    pub(crate) patches: Vec<PatchRecord>,
    pub(crate) vertices: RecordSources,
    pub(crate) edges: RecordSources,
    /// A spoke record for each general edge record.
    pub(crate) spokes: Vec<SpokeRecord>,
    /// Whether each edge record belongs to one drawn patch only.
    pub(crate) boundary_edges: Vec<bool>,
}

/// Gives every vertex and edge of drawn patches a record, owned by the first patch in patch order that has it (so by a regular one if there is one),
/// and the patches the records' numbers. One owner computes a record once; both sides read it. Vectors of spokes are added to `projections`.
pub(crate) fn assign<M: Connectivity>(
    mesh: &FinalMesh<'_, M>,
    order: &PatchOrder,
    nets: &PatchNets,
    weights: &mut WeightTable,
    projections: &mut Projections,
) -> Records {
    let slots = Slots { mesh, order };
    let owned = Owned::new(&slots);
    let patches = owned.patch_records(nets);
    let first_irregular = nets.regular_count();
    let (vertices, edges) = general_sources(&owned, nets, weights);
    let edge_slots = owned.edges.members();
    let first_general = edge_slots.partition_point(|&slot| slot < 4 * first_irregular);
    let sides: Vec<_> = edge_slots[first_general..].iter().map(|&slot| spoke_side(&slots, nets, slot)).collect();
    let spokes = spoke_records(&sides, weights, projections);
    let is_boundary = |&slot: &u32| slots.twin(slot) == NONE;
    let boundary_edges = edge_slots.par_iter().map(is_boundary).collect();
    let regular = |mut slots: Vec<u32>| {
        slots.truncate(slots.partition_point(|&slot| slot < 4 * first_irregular));
        slots
    };
    Records {
        patches,
        vertices: RecordSources { regular: regular(owned.vertices.members()), general: vertices },
        edges: RecordSources { regular: regular(edge_slots), general: edges },
        spokes,
        boundary_edges,
    }
}

/// Corners and sides of patches: a slot is four times the patch, plus the corner or side.
struct Slots<'a, M> {
    mesh: &'a FinalMesh<'a, M>,
    order: &'a PatchOrder,
}

impl<M: Connectivity> Slots<'_, M> {
    /// The quad whose corner or side a slot is.
    fn quad(&self, slot: u32) -> u32 {
        self.order.quads[(slot / 4) as usize]
    }

    /// [`NONE`] if the quad is not drawn, or is [`NONE`] itself.
    fn of(&self, quad: u32, k: u32) -> u32 {
        match self.order.patch_of_quad.get(quad as usize) {
            None | Some(&NONE) => NONE,
            Some(patch) => 4 * patch + k,
        }
    }

    fn is_unrefined(&self, patch: u32) -> bool {
        patch < self.order.unrefined
    }

    /// The slot of the side that an old half-edge is, if its face is left unrefined; of [`NONE`] there is none.
    fn unrefined(&self, h: u32) -> Option<u32> {
        let patch = *self.order.patch_of_quad.get(h as usize)?;
        self.is_unrefined(patch).then(|| 4 * patch + (h - self.order.quads[patch as usize]))
    }

    /// The slot on the other side of an edge of a patch, [`NONE`] where nothing is drawn there. Beyond an unrefined face that is the first half of the edge.
    fn twin(&self, slot: u32) -> u32 {
        let (old, quad, side) = (self.mesh.old, self.quad(slot), slot % 4);
        if self.is_unrefined(slot / 4) {
            let beyond = old.twin(quad + side);
            return self.unrefined(beyond).unwrap_or_else(|| self.of(beyond, 0));
        }
        match side {
            0 => match old.twin(quad) {
                NONE => NONE,
                twin => self.unrefined(twin).unwrap_or_else(|| self.of(old.next(twin), 3)),
            },
            1 => self.of(old.next(quad), 2),
            2 => self.of(old.prev(quad), 1),
            _ => {
                let twin = old.twin(old.prev(quad));
                self.unrefined(twin).unwrap_or_else(|| self.of(twin, 0))
            }
        }
    }

    fn twins(&self, patch: u32) -> [u32; 4] {
        [0, 1, 2, 3].map(|side| self.twin(4 * patch + side))
    }

    /// The tag of a patch.
    fn tag(&self, patch: u32) -> u32 {
        let (old, quad) = (self.mesh.old, self.order.quads[patch as usize]);
        if self.is_unrefined(patch) {
            return PatchRecord::tag_of(PatchKind::Unrefined, false, 4);
        }
        let flag = |h: u32, bit: u32| if self.unrefined(h).is_some() { bit } else { 0 };
        let halves = flag(old.twin(quad), PatchRecord::HALF_0) | flag(old.twin(old.prev(quad)), PatchRecord::HALF_3);
        self.mesh.tag(quad).0 | halves
    }
}

/// Which slot owns each point of the final mesh: the lowest of those that share it. Points on the sides of unrefined faces have none, but for the corners.
struct PointOwners {
    face_points: Vec<u32>,
    edge_points: Vec<u32>,
    vertex_points: Vec<u32>,
}

impl PointOwners {
    fn new<M: Connectivity>(slots: &Slots<'_, M>) -> Self {
        let old = slots.mesh.old;
        let at_face = |f| {
            let quads = old.face_half_edges(f);
            if slots.unrefined(quads.start).is_some() { None } else { quads.map(|h| slots.of(h, 2)).min() }
        };
        let at_edge = |e| {
            let h = old.edge_half_edge(e);
            let sides = [h, old.twin(h)];
            if sides.iter().any(|&side| slots.unrefined(side).is_some()) {
                return None;
            }
            let drawn = sides.into_iter().filter(|&side| side != NONE);
            drawn.map(|h| slots.of(h, 1).min(slots.of(old.next(h), 3))).min()
        };
        let at_vertex = |v| old.ring(v).map(|h| slots.unrefined(h).unwrap_or_else(|| slots.of(h, 0))).min();
        Self {
            face_points: owners(old.face_count(), at_face),
            edge_points: owners(old.edge_count(), at_edge),
            vertex_points: owners(old.vertex_count(), at_vertex),
        }
    }

    /// Owners of the four vertices of a patch.
    fn corners<M: Connectivity>(&self, slots: &Slots<'_, M>, patch: u32) -> [u32; 4] {
        let (old, quad) = (slots.mesh.old, slots.order.quads[patch as usize]);
        if slots.is_unrefined(patch) {
            return [0, 1, 2, 3].map(|corner| self.vertex_points[old.origin(quad + corner) as usize]);
        }
        [
            self.vertex_points[old.origin(quad) as usize],
            self.edge_points[old.edge(quad) as usize],
            self.face_points[old.face(quad) as usize],
            self.edge_points[old.edge(old.prev(quad)) as usize],
        ]
    }
}

fn owners(count: usize, lowest: impl Fn(u32) -> Option<u32> + Sync) -> Vec<u32> {
    (0..count as u32).into_par_iter().map(|element| lowest(element).unwrap_or(NONE)).collect()
}

/// The slots that own a record, in the order of the records.
struct Owned<'a, M> {
    slots: &'a Slots<'a, M>,
    points: PointOwners,
    vertices: RankedSet,
    edges: RankedSet,
}

impl<'a, M: Connectivity> Owned<'a, M> {
    fn new(slots: &'a Slots<'a, M>) -> Self {
        let points = PointOwners::new(slots);
        let count = slots.order.quads.len() as u32;
        let word = |i: u32| {
            let (mut vertices, mut edges) = (0, 0);
            for (bit, patch) in (0..64).step_by(4).zip(16 * i..count.min(16 * i + 16)) {
                let (corners, twins) = (points.corners(slots, patch), slots.twins(patch));
                for k in 0..4 {
                    let slot = 64 * i + bit + k;
                    vertices |= u64::from(corners[k as usize] == slot) << (bit + k);
                    edges |= u64::from(slot < twins[k as usize]) << (bit + k);
                }
            }
            (vertices, edges)
        };
        let (vertices, edges): (Vec<u64>, Vec<u64>) =
            (0..count.div_ceil(16)).into_par_iter().with_min_len(64).map(word).unzip();
        Self { slots, points, vertices: RankedSet::new(vertices), edges: RankedSet::new(edges) }
    }

    /// Number of the record of an edge with slots on both sides, as in [`PatchRecord::edge`].
    fn edge_record(&self, slot: u32, twin: u32) -> u32 {
        if slot < twin { 2 * self.edges.rank(slot) } else { 2 * self.edges.rank(twin) + 1 }
    }

    /// Number of the record of a vertex with an owner.
    fn vertex_record(&self, owner: u32) -> u32 {
        if owner == NONE { NONE } else { self.vertices.rank(owner) }
    }

    fn patch_records(&self, nets: &PatchNets) -> Vec<PatchRecord> {
        let mut patches = Vec::with_capacity(self.slots.order.quads.len());
        for list in &nets.lists {
            patches.par_extend((0..list.count).into_par_iter().map(|i| {
                let patch = list.first_patch + i;
                let twins = self.slots.twins(patch);
                let (net, basis, net_size) = nets.shape(list, i);
                PatchRecord {
                    vertex: self.points.corners(self.slots, patch).map(|owner| self.vertex_record(owner)),
                    edge: [0, 1, 2, 3].map(|k| self.edge_record(4 * patch + k, twins[k as usize])),
                    net,
                    basis,
                    net_size,
                    tag: self.slots.tag(patch),
                }
            }));
        }
        patches
    }
}

/// Sources of the vertex and edge records that irregular patches own.
fn general_sources<M: Connectivity>(
    owned: &Owned<'_, M>,
    nets: &PatchNets,
    weights: &mut WeightTable,
) -> (Vec<MatrixSource>, Vec<MatrixSource>) {
    let Slots { mesh, order } = owned.slots;
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    for list in nets.lists.iter().filter(|list| list.kind.form() != PatchForm::Bicubic) {
        for i in 0..list.count {
            let patch = list.first_patch + i;
            let (net, columns) = nets.net(list, i);
            let kind = mesh.net_kind(order.quads[patch as usize]);
            let mut source = |role| MatrixSource { net, weights: weights.offset(kind, role), columns };
            for k in 0..4 {
                if owned.vertices.contains(4 * patch + k) {
                    vertices.push(source(Role::Vertex(k as usize)));
                }
                if owned.edges.contains(4 * patch + k) {
                    edges.push(source(Role::Edge(k as usize)));
                }
            }
        }
    }
    (vertices, edges)
}

/// The side that a spoke record is made from, if the edge with that slot is a spoke: side 0 of the patch on its left, or side 3 of the other where that is not
/// drawn.
fn spoke_side<M: Connectivity>(slots: &Slots<'_, M>, nets: &PatchNets, slot: u32) -> Option<SpokeSide> {
    let side_of = |slot: u32| -> Option<SpokeSide> {
        let (patch, side) = (slot / 4, (slot % 4) as usize);
        let list = nets.list_of(patch);
        let kind = slots.mesh.net_kind(slots.quad(slot));
        let spoke = (side == 0 || side == 3) && list.kind.form().has_spokes();
        spoke.then(|| SpokeSide { kind, form: list.kind.form(), side, net: nets.net(list, patch - list.first_patch) })
    };
    let own = side_of(slot)?;
    match slots.twin(slot) {
        twin if own.side == 3 && twin != NONE => side_of(twin),
        _ => Some(own),
    }
}
