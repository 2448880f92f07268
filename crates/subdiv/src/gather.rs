//! Gathering the nets of all patches, list by list.

use osculate_surface::NetKind;
use rayon::prelude::*;

use crate::lists::PatchOrder;
use crate::nets::{FinalMesh, Phantoms};
use crate::projections::Projections;
use crate::weights::{Role, WeightTable, rows};
use crate::{Connectivity, PatchForm, PatchKind, PatchList};

/// The patch lists with their nets.
pub(crate) struct PatchNets {
    pub(crate) lists: Vec<PatchList>,
    /// Nets of all patches, in list order.
    pub(crate) nets: Vec<u32>,
    /// First index and size of the nets of stored patches.
    stored: Vec<(u32, u32)>,
    /// The changes of basis of stored patches, in order.
    pub(crate) projections: Projections,
    pub(crate) phantoms: Phantoms,
}

impl PatchNets {
    pub(crate) fn gather<M: Connectivity>(
        mesh: &FinalMesh<'_, M>,
        order: &PatchOrder,
        weights: &mut WeightTable,
    ) -> Self {
        let Layout { lists, stored, projections, size } = Layout::new(mesh, order, weights);
        let mut nets = vec![0; size as usize];
        let mut phantoms = Phantoms::new(mesh.first_point + mesh.point_count() as u32);
        for list in &lists {
            let (quads, nets) = (&order.quads[list.patches()], &mut nets[list.first_index as usize..]);
            match list.kind {
                PatchKind::Unrefined => unrefined_nets(mesh, quads, nets),
                PatchKind::Regular => regular_nets(mesh, quads, nets, &mut phantoms),
                PatchKind::Extraordinary { valence, .. } => extraordinary_nets(mesh, valence, quads, nets),
                PatchKind::Stored { .. } => stored_nets(mesh, quads, nets),
            }
        }
        Self { lists, nets, stored, projections, phantoms }
    }

    /// How many patches are bicubic; they come first.
    pub(crate) fn regular_count(&self) -> u32 {
        let regular = self.lists.iter().take_while(|list| list.kind.form() == PatchForm::Bicubic);
        regular.map(|list| list.count).sum()
    }

    /// The list that a patch belongs to.
    pub(crate) fn list_of(&self, patch: u32) -> &PatchList {
        &self.lists[self.lists.partition_point(|list| list.first_patch <= patch) - 1]
    }

    /// First index and size of the net of a patch, by its number in its list.
    pub(crate) fn net(&self, list: &PatchList, i: u32) -> (u32, u32) {
        list.kind.net_size().map_or_else(|| self.stored[i as usize], |size| (list.first_index + size * i, size))
    }

    /// `net`, `basis` and `net_size` of [`crate::PatchRecord`].
    pub(crate) fn shape(&self, list: &PatchList, i: u32) -> (u32, u32, u32) {
        let (net, size) = self.net(list, i);
        if list.kind.is_stored() {
            let source = &self.projections.sources[i as usize];
            return (source.first, source.weights, size);
        }
        (net, list.weights, size)
    }
}

/// Where everything goes.
struct Layout {
    lists: Vec<PatchList>,
    stored: Vec<(u32, u32)>,
    projections: Projections,
    /// Points of all nets.
    size: u32,
}

impl Layout {
    fn new<M: Connectivity>(mesh: &FinalMesh<'_, M>, order: &PatchOrder, weights: &mut WeightTable) -> Self {
        let mut layout = Self { lists: Vec::new(), stored: Vec::new(), projections: Projections::default(), size: 0 };
        for &(kind, ref patches) in &order.runs {
            let (first_patch, count, first_index) = (patches.start, patches.len() as u32, layout.size);
            let mut list = PatchList { kind, first_patch, count, drawn: count, first_index, weights: 0 };
            match kind {
                PatchKind::Unrefined | PatchKind::Regular => layout.size += 16 * count,
                PatchKind::Extraordinary { form, valence } => {
                    list.weights = weights.offset(NetKind::Interior { valence }, Role::Patch(form));
                    layout.size += (2 * valence + 8) * count;
                }
                PatchKind::Stored { form } => layout.store(mesh, &order.quads[list.patches()], form, weights),
            }
            layout.lists.push(list);
        }
        layout
    }

    /// Lays out patches whose change of basis runs before the draw.
    fn store<M: Connectivity>(
        &mut self,
        mesh: &FinalMesh<'_, M>,
        quads: &[u32],
        form: PatchForm,
        weights: &mut WeightTable,
    ) {
        weights.prepare(quads.iter().map(|&quad| (mesh.net_kind(quad), Role::Patch(form))).collect());
        for &quad in quads {
            let (net, kind) = (self.size, mesh.net_kind(quad));
            let columns = kind.net_size() as u32;
            let rows = rows(form, columns);
            // All Gregory points are points; of a stam patch the first vector is one, the others are differences.
            let absolute = if form == PatchForm::Stam { 1 } else { rows };
            self.projections.push((net, columns), weights.offset(kind, Role::Patch(form)), rows, absolute);
            self.stored.push((net, columns));
            self.size += columns;
        }
    }
}

fn unrefined_nets<M: Connectivity>(mesh: &FinalMesh<'_, M>, quads: &[u32], nets: &mut [u32]) {
    nets.par_chunks_exact_mut(16).zip(quads).with_min_len(1024).for_each(|(net, &quad)| {
        net.copy_from_slice(&mesh.unrefined_net(quad));
    });
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

fn stored_nets<M: Connectivity>(mesh: &FinalMesh<'_, M>, quads: &[u32], nets: &mut [u32]) {
    let points = quads.iter().flat_map(|&quad| {
        if mesh.tag(quad).is_boundary() { mesh.sector_net(quad) } else { mesh.interior_net(quad).collect() }
    });
    nets.iter_mut().zip(points).for_each(|(slot, point)| *slot = point);
}
