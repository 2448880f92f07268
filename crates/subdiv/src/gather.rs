//! Gathering the nets of all patches, list by list.

use osculate_surface::NetKind;
use rayon::prelude::*;

use crate::lists::PatchOrder;
use crate::nets::{FinalMesh, Phantoms};
use crate::weights::{Role, WeightTable};
use crate::{Connectivity, MatrixSource, PatchKind, PatchList};

/// The patch lists with their nets.
pub(crate) struct PatchNets {
    pub(crate) lists: Vec<PatchList>,
    /// Nets of all patches, in list order.
    pub(crate) nets: Vec<u32>,
    /// Nets and changes of basis of coefficient patches.
    pub(crate) coefficients: Vec<MatrixSource>,
    pub(crate) phantoms: Phantoms,
}

impl PatchNets {
    pub(crate) fn gather<M: Connectivity>(
        mesh: &FinalMesh<'_, M>,
        order: &PatchOrder,
        weights: &mut WeightTable,
    ) -> Self {
        let (lists, coefficients, size) = lay_out(mesh, order, weights);
        let mut nets = vec![0; size as usize];
        let mut phantoms = Phantoms::new(mesh.first_point + mesh.point_count() as u32);
        for list in &lists {
            let (quads, nets) = (&order.quads[list.patches()], &mut nets[list.first_index as usize..]);
            match list.kind {
                PatchKind::Regular => regular_nets(mesh, quads, nets, &mut phantoms),
                PatchKind::Extraordinary { valence } => extraordinary_nets(mesh, valence, quads, nets),
                PatchKind::Coefficients => coefficient_nets(mesh, quads, nets),
            }
        }
        Self { lists, nets, coefficients, phantoms }
    }

    /// How many patches are regular; they come first.
    pub(crate) fn regular_count(&self) -> u32 {
        self.lists.first().filter(|list| list.kind == PatchKind::Regular).map_or(0, |list| list.count)
    }

    /// Net, basis (see [`crate::PatchRecord::basis`]) and net size of the patches of a list, by their number in it.
    pub(crate) fn shape(&self, list: &PatchList, i: u32) -> (u32, u32, u32) {
        match list.kind.net_size() {
            Some(size) => (list.first_index + size * i, list.weights, size),
            None => {
                let MatrixSource { net, columns, .. } = self.coefficients[i as usize];
                (net, i, columns)
            }
        }
    }
}

/// The lists, the sources of the coefficient patches, and the number of points in all nets.
fn lay_out<M: Connectivity>(
    mesh: &FinalMesh<'_, M>,
    order: &PatchOrder,
    weights: &mut WeightTable,
) -> (Vec<PatchList>, Vec<MatrixSource>, u32) {
    let (mut lists, mut coefficients, mut end) = (Vec::new(), Vec::new(), 0);
    for &(kind, ref patches) in &order.runs {
        let (first_patch, count, first_index) = (patches.start, patches.len() as u32, end);
        let mut list = PatchList { kind, first_patch, count, first_index, weights: 0 };
        if let PatchKind::Extraordinary { valence } = kind {
            list.weights = weights.offset(NetKind::Interior { valence }, Role::Gregory);
        }
        match kind.net_size() {
            Some(size) => end += size * count,
            None => {
                coefficients = coefficient_sources(mesh, &order.quads[list.patches()], end, weights);
                end = coefficients.last().map_or(end, |last| last.net + last.columns);
            }
        }
        lists.push(list);
    }
    (lists, coefficients, end)
}

fn coefficient_sources<M: Connectivity>(
    mesh: &FinalMesh<'_, M>,
    quads: &[u32],
    first_index: u32,
    weights: &mut WeightTable,
) -> Vec<MatrixSource> {
    let source = |end: &mut u32, &quad: &u32| {
        let (net, kind) = (*end, mesh.net_kind(quad));
        let columns = kind.net_size() as u32;
        *end += columns;
        Some(MatrixSource { net, weights: weights.offset(kind, Role::Gregory), columns })
    };
    quads.iter().scan(first_index, source).collect()
}

/// Nets of the regular list: inner ones in parallel, those at the boundary one by one because they share phantom points.
fn regular_nets<M: Connectivity>(mesh: &FinalMesh<'_, M>, quads: &[u32], nets: &mut [u32], phantoms: &mut Phantoms) {
    let is_boundary = |quad: u32| mesh.tag(quad).is_boundary();
    nets.par_chunks_exact_mut(16).zip(quads).with_min_len(1024).for_each(|(net, &quad)| {
        if !is_boundary(quad) {
            net.copy_from_slice(&mesh.regular_net(quad));
        }
    });
    let boundary: Vec<usize> = (0..quads.len()).into_par_iter().filter(|&i| is_boundary(quads[i])).collect();
    for i in boundary {
        nets[16 * i..][..16].copy_from_slice(&mesh.boundary_net(quads[i], phantoms));
    }
}

fn extraordinary_nets<M: Connectivity>(mesh: &FinalMesh<'_, M>, valence: u32, quads: &[u32], nets: &mut [u32]) {
    let size = NetKind::Interior { valence }.net_size();
    nets.par_chunks_exact_mut(size).zip(quads).with_min_len(1024).for_each(|(net, &quad)| {
        net.iter_mut().zip(mesh.interior_net(quad)).for_each(|(slot, point)| *slot = point);
    });
}

fn coefficient_nets<M: Connectivity>(mesh: &FinalMesh<'_, M>, quads: &[u32], nets: &mut [u32]) {
    let points = quads.iter().flat_map(|&quad| {
        if mesh.tag(quad).is_boundary() { mesh.sector_net(quad) } else { mesh.interior_net(quad).collect() }
    });
    nets.iter_mut().zip(points).for_each(|(slot, point)| *slot = point);
}
