//! The matrices that nets are multiplied with and the functions of eigenbases, each kept once in one table of f32.

use std::collections::{BTreeSet, HashMap};

use osculate_surface::stam::{Patch, Side, Table};
use osculate_surface::{NetKind, biseptic, gregory};
use rayon::prelude::*;

use crate::PatchForm;

/// What of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Role {
    /// The change of basis of a patch: as many rows as [`rows`] says; for stam the projection, then the functions of the modes.
    Patch(PatchForm),
    /// Limit position and two tangents at a corner.
    Vertex(usize),
    /// Cubic edge record of a side.
    Edge(usize),
    /// Spoke record of side 0 or 3, walked from V outwards: for stam the projection, then the functions of the modes.
    Spoke(PatchForm, usize),
}

/// Rows of a patch's change of basis: its control points or vectors.
pub(crate) fn rows(form: PatchForm, net_size: u32) -> u32 {
    match form {
        PatchForm::Bicubic => 16,
        PatchForm::Gregory => 20,
        PatchForm::Stam => net_size,
        PatchForm::Biseptic => 64,
        PatchForm::Triangle => 15,
    }
}

/// Blocks of weights one after the other, matrices in row-major order.
#[derive(Default)]
pub(crate) struct WeightTable {
    offsets: HashMap<(NetKind, Role), u32>,
    pub(crate) weights: Vec<f32>,
}

impl WeightTable {
    /// Makes the blocks that are missing, on all threads: eigenbases of high valences take a while.
    pub(crate) fn prepare(&mut self, needed: BTreeSet<(NetKind, Role)>) {
        let missing: Vec<_> = needed.into_iter().filter(|key| !self.offsets.contains_key(key)).collect();
        let blocks: Vec<Vec<f32>> = missing.par_iter().map(|&(net, role)| block(net, role)).collect();
        for (key, block) in missing.into_iter().zip(blocks) {
            self.offsets.insert(key, self.weights.len() as u32);
            self.weights.extend(block);
        }
    }

    /// Offset of a block in the table.
    pub(crate) fn offset(&mut self, net: NetKind, role: Role) -> u32 {
        let weights = &mut self.weights;
        *self.offsets.entry((net, role)).or_insert_with(|| {
            let offset = weights.len() as u32;
            weights.extend(block(net, role));
            offset
        })
    }
}

fn block(net: NetKind, role: Role) -> Vec<f32> {
    match role {
        Role::Patch(PatchForm::Gregory) => gregory::gregory2(net).to_f32(),
        Role::Patch(PatchForm::Biseptic) => biseptic::patch(valence(net)).to_f32(),
        Role::Patch(PatchForm::Stam) => eigenbasis(Patch::new(net).table()),
        Role::Spoke(PatchForm::Stam, side) => eigenbasis(Side::new(net, side).table()),
        Role::Spoke(_, side) => biseptic_spoke(valence(net), side),
        Role::Vertex(corner) => gregory::vertex(net, corner).to_f32(),
        Role::Edge(side) => gregory::edge(net, side).to_f32(),
        Role::Patch(PatchForm::Bicubic) => unreachable!("regular nets need no weights: their kernels know them"),
        Role::Patch(PatchForm::Triangle) => unreachable!("triangles are gathered from fans"),
    }
}

fn eigenbasis(table: Table) -> Vec<f32> {
    [table.projection, table.evaluation].concat()
}

/// The record of a spoke walked from V: side 3 of a patch runs towards V, so its curve is reversed, its cross derivative reversed and negated.
fn biseptic_spoke(valence: u32, side: usize) -> Vec<f32> {
    let record = biseptic::edge(valence, side);
    let outwards =
        |row: usize| if side == 0 { (row, 1.0) } else { (7 - row % 8 + 8 * (row / 8), 1.0 - 2.0 * (row / 8) as f64) };
    let rows = (0..16).map(outwards).map(|(row, sign)| record.row(row).iter().map(|w| sign * w).collect());
    osculate_surface::matrix::Matrix::from_rows(&rows.collect::<Vec<Vec<f64>>>()).to_f32()
}

fn valence(net: NetKind) -> u32 {
    match net {
        NetKind::Interior { valence } => valence,
        _ => unreachable!("biseptic patches lie about inner vertices"),
    }
}
