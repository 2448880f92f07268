//! Legs, feet and toes.

use std::ops::Range;

use glam::{DVec3, dvec3};

use super::half::{Half, Part, SheetId};
use super::tube::{Ring, TubeDesc, Turn, tube};

/// Quads from the leg's outer side that are cut from the trunk for a leg.
const COLUMNS: Range<usize> = 4..6;

/// Where a leg leaves the trunk, and its rings down to the sole: x, y, z, radius, scale along z.
struct LegDesc {
    rows: Range<usize>,
    rings: &'static [[f64; 5]],
}

const FORELEG: LegDesc = LegDesc {
    rows: 14..16,
    rings: &[
        [0.335, 0.530, 0.27, 0.200, 1.0],
        [0.340, 0.400, 0.29, 0.180, 1.0],
        [0.340, 0.270, 0.29, 0.160, 1.0],
        [0.340, 0.170, 0.30, 0.155, 1.0],
        [0.340, 0.095, 0.33, 0.180, 1.1],
        [0.340, 0.005, 0.34, 0.185, 1.1],
    ],
};

const HIND_LEG: LegDesc = LegDesc {
    rows: 18..21,
    rings: &[
        [0.375, 0.570, -0.37, 0.270, 1.05],
        [0.430, 0.420, -0.33, 0.235, 1.05],
        [0.430, 0.280, -0.37, 0.175, 1.0],
        [0.430, 0.170, -0.42, 0.150, 1.0],
        [0.430, 0.095, -0.37, 0.180, 1.15],
        [0.430, 0.005, -0.36, 0.185, 1.15],
    ],
};

/// Grows both legs of the right half.
pub(super) fn legs(half: &mut Half, trunk: SheetId) {
    half.growing = Part::Foreleg;
    leg(half, trunk, &FORELEG);
    half.growing = Part::HindLeg;
    leg(half, trunk, &HIND_LEG);
}

fn leg(half: &mut Half, trunk: SheetId, desc: &LegDesc) {
    let rim = half.cut(trunk, desc.rows.clone(), COLUMNS);
    half.soften(&rim, 0.5);
    let ring = |&[x, y, z, radius, long]: &[f64; 5]| Ring::round(dvec3(x, y, z), radius).squashed(DVec3::Z, long);
    let rings: Vec<Ring> = desc.rings.iter().map(ring).collect();
    let how = TubeDesc { root: dvec3(0.8, -0.6, 0.0), softness: [0.4, 0.05], turn: Turn::Side(DVec3::Z) };
    let sheet = tube(half, &rim, &rings, &how);
    let sole = half.sheets[sheet].rows[rings.len()].clone();
    half.cap(&sole, desc.rows.len(), COLUMNS.len(), DVec3::ZERO);
    toes(half, sheet, rings.len() - 1);
}

/// Three toes from the sides of the foot that face forward. Between two toes six faces meet.
fn toes(half: &mut Half, leg: SheetId, row: usize) {
    let count = half.sheets[leg].rows[row].len();
    let front = |&column: &usize| {
        let next = (column + 1) % count;
        let [a, b] = [column, next].map(|column| half.points[half.sheets[leg].rows[row][column]]);
        a.z + b.z
    };
    let middle = (0..count).max_by(|a, b| front(a).total_cmp(&front(b))).expect("a ring has sides");
    for column in [middle + count - 1, middle, middle + 1].map(|column| column % count) {
        toe(half, leg, row, column);
    }
}

fn toe(half: &mut Half, leg: SheetId, row: usize, column: usize) {
    let foot = half.middle(&half.sheets[leg].rows[row + 1].clone());
    let rim = half.cut(leg, row..row + 1, column..column + 1);
    let base = half.middle(&rim);
    let out = (base - foot).with_y(0.0).normalize().lerp(DVec3::Z, 0.4).normalize();
    let ring = |along: f64, drop: f64, radius: f64| Ring::round(base + along * out - DVec3::Y * drop, radius);
    let rings = [ring(0.010, 0.0, 0.084), ring(0.065, 0.006, 0.084), ring(0.118, 0.018, 0.050)];
    let sheet = tube(half, &rim, &rings, &TubeDesc { root: out, softness: [0.0, 0.0], turn: Turn::Free });
    let tip = half.sheets[sheet].rows[rings.len()].clone();
    half.cap(&tip, 1, 1, DVec3::ZERO);
}
