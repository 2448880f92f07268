//! Eyes, nostrils, horns and ears.

use std::f64::consts::TAU;
use std::ops::Range;

use glam::{DQuat, DVec3, dvec3};

use super::eyeball::eyeball;
use super::half::{Half, Part, Sheet, SheetId};
use super::tube::{Ring, TubeDesc, Turn, first_spoke, tube};

/// Radius of the eyeball's cage.
const EYE: f64 = 0.150;

/// Everything on the head that isn't part of the loft.
pub(super) fn face(half: &mut Half, trunk: SheetId) {
    half.growing = Part::Head;
    eye(half, trunk);
    nostril(half, trunk);
    horn(half, trunk);
    half.growing = Part::Ear;
    ear(half, trunk);
}

/// An opening with lids round a ball.
fn eye(half: &mut Half, trunk: SheetId) {
    let gaze = dvec3(0.74, 0.20, 0.64).normalize();
    let rim = half.cut(trunk, 4..6, 1..3);
    half.soften(&rim, 0.3);
    let center = half.middle(&rim) - 0.52 * EYE * gaze;
    let spoke = first_spoke(half, &rim, center, gaze);
    let mut rows = vec![rim];
    for (index, lid) in LIDS.iter().enumerate() {
        let points: Vec<DVec3> = (0..8).map(|k| center + EYE * lid.point(gaze, spoke, k)).collect();
        rows.push(half.add(points, if index == 0 { 0.15 } else { 0.0 }));
    }
    let inner = rows[LIDS.len()].clone();
    half.add_sheet(Sheet { rows, closed: true, midline: false });
    half.cap(&inner, 2, 2, DVec3::ZERO);
    eyeball(half, center, gaze, EYE);
}

/// A ring of the lids in polar coordinates about the gaze, in units of the eye's radius.
struct Lid {
    /// Angle from the gaze in degrees, below and above.
    angles: [f64; 2],
    distance: f64,
}

/// From the face to the edge of the lids and inward.
const LIDS: [Lid; 4] = [
    Lid { angles: [90.0, 76.0], distance: 1.24 },
    Lid { angles: [76.0, 58.0], distance: 1.15 },
    Lid { angles: [68.0, 49.0], distance: 1.09 },
    Lid { angles: [68.0, 50.0], distance: 0.85 },
];

impl Lid {
    /// Vertex `k` of 8 relative to the eye's centre.
    fn point(&self, gaze: DVec3, spoke: DVec3, k: usize) -> DVec3 {
        let side = DQuat::from_axis_angle(gaze, TAU * k as f64 / 8.0) * spoke;
        let above = 0.5 + 0.5 * side.dot(DVec3::Y.reject_from_normalized(gaze).normalize());
        let (sine, cosine) = (self.angles[0] + above * (self.angles[1] - self.angles[0])).to_radians().sin_cos();
        // An even ring of 8 control points pulls its limit curve in by a tenth.
        self.distance * (cosine * gaze + 1.1 * sine * side)
    }
}

/// A dimple with a raised rim on top of the snout.
fn nostril(half: &mut Half, trunk: SheetId) {
    let rim = half.cut(trunk, 1..2, 1..2);
    let center = half.middle(&rim);
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| half.points[rim[k]]);
    let out = (c - a).cross(d - b).normalize();
    let mut rows = vec![rim.clone()];
    for (rise, share) in NOSTRIL {
        let points: Vec<DVec3> = [a, b, c, d].map(|point| center.lerp(point, share) + rise * out).into();
        rows.push(half.add(points, 0.0));
    }
    let bottom = rows[NOSTRIL.len()].clone();
    half.add_sheet(Sheet { rows, closed: true, midline: false });
    half.cap(&bottom, 1, 1, DVec3::ZERO);
}

/// Rings of a nostril: rise over the snout, and size as a share of the rim's.
const NOSTRIL: [(f64, f64); 3] = [(0.016, 0.84), (0.006, 0.56), (-0.05, 0.50)];

fn horn(half: &mut Half, trunk: SheetId) {
    let rings = [
        [0.165, 1.93, 0.80, 0.080],
        [0.185, 2.01, 0.74, 0.068],
        [0.205, 2.09, 0.65, 0.056],
        [0.215, 2.15, 0.54, 0.042],
        [0.205, 2.18, 0.43, 0.022],
    ];
    let rings = rings.map(|[x, y, z, radius]| Ring::round(dvec3(x, y, z), radius));
    spur(half, trunk, 7..8, 1..2, dvec3(0.2, 1.0, -0.5), Turn::Free, &rings);
}

/// A leaf hollowed on the side that faces forward.
fn ear(half: &mut Half, trunk: SheetId) {
    let flat = dvec3(-0.35, 0.25, 1.0).normalize();
    let rings = [
        [0.40, 1.72, 0.76, 0.095, 0.62],
        [0.49, 1.78, 0.72, 0.125, 0.42],
        [0.60, 1.85, 0.67, 0.140, 0.34],
        [0.72, 1.92, 0.61, 0.110, 0.34],
        [0.82, 1.99, 0.55, 0.045, 0.45],
    ];
    let rings = rings.map(|[x, y, z, radius, thin]| Ring::round(dvec3(x, y, z), radius).squashed(flat, thin));
    let ear = spur(half, trunk, 8..10, 2..4, dvec3(1.0, 0.3, -0.3), Turn::Vertex(flat), &rings);
    for (row, ring) in rings.iter().enumerate().skip(1).take(3) {
        let vertices = half.sheets[ear].rows[row + 1].clone();
        let depth = |vertex: &usize| (half.points[*vertex] - ring.center).dot(flat);
        let front = vertices.into_iter().max_by(|a, b| depth(a).total_cmp(&depth(b))).expect("a ring");
        half.points[front] -= 1.1 * ring.radius * ring.squash.1 * flat;
    }
}

/// A closed tube out of some quads of the head.
fn spur(
    half: &mut Half,
    trunk: SheetId,
    rows: Range<usize>,
    columns: Range<usize>,
    root: DVec3,
    turn: Turn,
    rings: &[Ring],
) -> SheetId {
    let rim = half.cut(trunk, rows.clone(), columns.clone());
    half.soften(&rim, 0.15);
    let sheet = tube(half, &rim, rings, &TubeDesc { root, softness: [0.1, 0.0], turn });
    let tip = half.sheets[sheet].rows[rings.len()].clone();
    half.cap(&tip, columns.len(), rows.len(), DVec3::ZERO);
    sheet
}
