//! The matrices that nets are multiplied with, each kept once in one table of f32.

use std::collections::HashMap;

use osculate_surface::{NetKind, gregory};

/// Which matrix of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Role {
    /// 20 Gregory points.
    Gregory,
    /// Limit position and two tangents at a corner.
    Vertex(usize),
    /// Edge record of a side.
    Edge(usize),
}

/// Matrices in row-major order one after the other, made when first asked for.
#[derive(Default)]
pub(crate) struct WeightTable {
    offsets: HashMap<(NetKind, Role), u32>,
    pub(crate) weights: Vec<f32>,
}

impl WeightTable {
    /// Offset of a matrix in the table.
    pub(crate) fn offset(&mut self, net: NetKind, role: Role) -> u32 {
        let weights = &mut self.weights;
        *self.offsets.entry((net, role)).or_insert_with(|| {
            let offset = weights.len() as u32;
            let matrix = match role {
                Role::Gregory => gregory::gregory2(net),
                Role::Vertex(corner) => gregory::vertex(net, corner),
                Role::Edge(side) => gregory::edge(net, side),
            };
            weights.extend(matrix.to_f32());
            offset
        })
    }
}
