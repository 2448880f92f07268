//! Vertex and edge records: which patch each is computed from, and which records a patch names.

use bytemuck::{Pod, Zeroable};
use osculate_surface::NetKind;

use crate::weights::{Role, WeightTable};
use crate::{Connectivity, NONE, PatchRecord, QuadConnectivity};

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

    fn push(&mut self, is_regular: bool, patch: u32, slot: usize, general: impl FnOnce() -> MatrixSource) -> u32 {
        if is_regular {
            // Patches are visited regular ones first, so no general record precedes.
            debug_assert!(self.general.is_empty());
            self.regular.push(4 * patch + slot as u32);
        } else {
            self.general.push(general());
        }
        (self.count() - 1) as u32
    }
}

/// A patch with what records need of it.
pub(crate) struct PatchNet {
    pub(crate) quad: u32,
    pub(crate) net: NetKind,
}

/// Gives every vertex and edge of drawn patches a record, owned by the first patch in patch order that has it (so by a regular one if there is one),
/// and writes the records' numbers into the patches. One owner computes a record once; both sides read it.
pub(crate) fn assign(
    mesh: &QuadConnectivity,
    nets: &[PatchNet],
    patches: &mut [PatchRecord],
    weights: &mut WeightTable,
) -> (RecordSources, RecordSources) {
    let (mut vertices, mut edges) = (RecordSources::default(), RecordSources::default());
    let mut vertex_of = vec![NONE; mesh.vertex_count()];
    // The record of an edge and the half-edge it is walked along.
    let mut edge_of = vec![(NONE, NONE); mesh.edge_count()];
    for (id, (record, PatchNet { quad, net })) in patches.iter_mut().zip(nets).enumerate() {
        let is_regular = *net == NetKind::Regular;
        let (first_index, columns) = (record.net, record.net_size);
        for k in 0..4 {
            let h = 4 * quad + k as u32;
            let vertex = &mut vertex_of[mesh.origin(h) as usize];
            if *vertex == NONE {
                *vertex = vertices.push(is_regular, id as u32, k, || MatrixSource {
                    net: first_index,
                    weights: weights.offset(*net, Role::Vertex(k)),
                    columns,
                });
            }
            record.vertex[k] = *vertex;
            let edge = &mut edge_of[mesh.edge(h) as usize];
            if edge.0 == NONE {
                let number = edges.push(is_regular, id as u32, k, || MatrixSource {
                    net: first_index,
                    weights: weights.offset(*net, Role::Edge(k)),
                    columns,
                });
                *edge = (number, h);
            }
            record.edge[k] = 2 * edge.0 + u32::from(edge.1 != h);
        }
    }
    (vertices, edges)
}
