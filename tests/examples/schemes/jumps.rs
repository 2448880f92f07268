//! What normals and curvatures do across the edges that patches share. Patches are evaluated in f64 from the device's points, each by its own formula: what is
//! drawn takes the normals on edges from records, where nothing can jump.

use osculate::{Cage, Surface};
use osculate_subdiv::PatchRecord;
use osculate_surface::jet::Jet;
use osculate_tests::formula::{self, Formula};

use crate::Spread;

/// Over edges that have an extraordinary patch on one side at least.
pub(crate) struct Jumps {
    /// Angle between the normals in degrees.
    pub(crate) normal: Spread,
    /// Difference of the mean curvatures, times the half diagonal of the cage's box. Where the normals agree all along an edge, the two surfaces can differ in
    /// the curvature across the edge alone, by twice this.
    pub(crate) curvature: Spread,
}

/// Where along an edge. Ends are left out: at an irregular vertex the limit surface has no curvature.
const PARAMETERS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// A side of a patch.
#[derive(Clone, Copy)]
struct Side {
    patch: usize,
    side: usize,
}

/// Measures all edges that two patches share.
///
/// # Panics
/// If two patches do not meet at their edge.
pub(crate) fn measure(surface: &Surface, cage: &Cage) -> Jumps {
    let patches = formula::patches(surface);
    let records = &surface.plan().patches;
    // Patches are in cage space.
    let half_diagonal = cage.bounds().half_diagonal() * surface.space().scale;
    let mut found = Jumps { normal: Spread::default(), curvature: Spread::default() };
    for [a, b] in shared_edges(records) {
        if ![a, b].iter().any(|side| records[side.patch].is_extraordinary()) {
            continue;
        }
        for t in PARAMETERS {
            let [a, b] = [a, b].map(|side| jet(&patches[side.patch], &records[side.patch], side.side, t));
            assert!((a.position - b.position).length() < 1e-5, "{} and {} must meet", a.position, b.position);
            let (Some(m), Some(n)) = (a.normal(), b.normal()) else { continue };
            found.normal.add(m.cross(n).length().atan2(m.dot(n)).to_degrees(), 1.0);
            if let (Some(a), Some(b)) = (a.curvature(), b.curvature()) {
                found.curvature.add((a.mean - b.mean).abs() * half_diagonal, 1.0);
            }
        }
    }
    found
}

fn shared_edges(records: &[PatchRecord]) -> Vec<[Side; 2]> {
    let mut sides: Vec<Vec<Side>> = Vec::new();
    for (patch, record) in records.iter().enumerate() {
        for (side, edge) in record.edge[..record.sides()].iter().enumerate() {
            let edge = (edge >> 1) as usize;
            sides.resize_with(sides.len().max(edge + 1), Vec::new);
            sides[edge].push(Side { patch, side });
        }
    }
    sides.into_iter().filter_map(|sides| sides.try_into().ok()).collect()
}

/// The patch where its edge record has parameter t: sides 2 and 3 of quads run against u and v, the flip bit turns once more.
fn jet(patch: &Formula, record: &PatchRecord, side: usize, t: f64) -> Jet {
    // From the side's own start to its end.
    let x = if record.edge[side] & 1 == 1 { 1.0 - t } else { t };
    let [u, v] = match record.sides() {
        3 => [[x, 0.0], [1.0 - x, x], [0.0, 1.0 - x]][side],
        _ => [[x, 0.0], [1.0, x], [1.0 - x, 1.0], [0.0, 1.0 - x]][side],
    };
    patch.jet(u, v)
}
