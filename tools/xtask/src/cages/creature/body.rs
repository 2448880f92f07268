//! The loft from nose to tail.

use glam::{DVec3, dvec3};

use super::half::{Half, Sheet, SheetId};
use super::spline::{Keys, sample};

/// Columns of quads from the middle of the back to the middle of the belly.
pub(super) const COLUMNS: usize = 8;
/// The column that runs along the mouth.
pub(super) const MOUTH: usize = 4;

/// Rings by row, nose first: z, y, pitch of the ring in degrees (0 faces forward, 90 up), half width, height of the
/// back over the middle, depth of the belly below it, and how much the columns gather along the mouth (0 to 1).
const RINGS: &Keys<7> = &[
    (0.0, [1.59, 1.485, 0.0, 0.165, 0.125, 0.095, 1.0]),
    (1.0, [1.535, 1.49, 0.0, 0.220, 0.170, 0.130, 1.0]),
    (2.0, [1.46, 1.50, 0.0, 0.255, 0.190, 0.150, 1.0]),
    (3.0, [1.38, 1.515, 0.0, 0.272, 0.205, 0.165, 1.0]),
    (4.0, [1.29, 1.535, 0.0, 0.300, 0.245, 0.180, 1.0]),
    (5.0, [1.20, 1.56, 0.0, 0.350, 0.315, 0.195, 0.9]),
    (6.0, [1.10, 1.58, 0.0, 0.395, 0.370, 0.210, 0.7]),
    (7.0, [1.00, 1.59, 0.0, 0.420, 0.395, 0.222, 0.4]),
    (8.0, [0.89, 1.58, 5.0, 0.420, 0.395, 0.228, 0.15]),
    (9.0, [0.77, 1.53, 20.0, 0.380, 0.365, 0.225, 0.0]),
    (10.0, [0.65, 1.41, 50.0, 0.300, 0.310, 0.200, 0.0]),
    (11.0, [0.57, 1.25, 75.0, 0.245, 0.245, 0.200, 0.0]),
    (12.0, [0.53, 1.11, 72.0, 0.245, 0.240, 0.220, 0.0]),
    (13.0, [0.46, 0.97, 55.0, 0.290, 0.243, 0.275, 0.0]),
    (14.0, [0.36, 0.86, 34.0, 0.350, 0.290, 0.330, 0.0]),
    (15.0, [0.23, 0.79, 14.0, 0.385, 0.330, 0.355, 0.0]),
    (17.0, [-0.04, 0.74, 0.0, 0.410, 0.350, 0.370, 0.0]),
    (19.0, [-0.32, 0.73, 0.0, 0.405, 0.355, 0.345, 0.0]),
    (21.0, [-0.59, 0.76, 0.0, 0.340, 0.305, 0.265, 0.0]),
    (23.0, [-0.86, 0.77, 0.0, 0.225, 0.215, 0.190, 0.0]),
    (25.0, [-1.14, 0.74, 0.0, 0.160, 0.155, 0.145, 0.0]),
    (28.0, [-1.56, 0.70, 0.0, 0.105, 0.105, 0.100, 0.0]),
    (31.0, [-1.95, 0.68, 0.0, 0.060, 0.062, 0.058, 0.0]),
    (32.0, [-2.05, 0.68, 0.0, 0.080, 0.062, 0.056, 0.0]),
    (33.0, [-2.07, 0.68, 0.0, 0.200, 0.058, 0.052, 0.0]),
    (34.0, [-2.19, 0.68, 0.0, 0.205, 0.050, 0.046, 0.0]),
    (35.0, [-2.34, 0.68, 0.0, 0.120, 0.042, 0.038, 0.0]),
    (36.0, [-2.48, 0.68, 0.0, 0.028, 0.026, 0.022, 0.0]),
];

/// Angles of the columns in degrees, from the middle of the back to that of the belly: round, and gathered at the mouth.
const ANGLES: [[f64; COLUMNS + 1]; 2] = [
    [0.0, 22.5, 45.0, 67.5, 90.0, 112.5, 135.0, 157.5, 180.0],
    [0.0, 26.0, 54.0, 84.0, 98.0, 109.0, 133.0, 157.0, 180.0],
];

/// Depth of the mouth by row, as a share of the half width: a groove that ends in the cheek.
const MOUTH_DEPTH: [f64; 8] = [0.24, 0.22, 0.20, 0.20, 0.20, 0.20, 0.17, 0.03];

/// Angle in degrees by which the mouth and the lips beside it rise towards its corner, by row.
const SMILE: [f64; 8] = [0.0, 0.0, 0.0, 0.0, 1.0, 4.0, 9.0, 8.0];

/// The middle of the loft at a row, between rows too.
pub(super) fn middle(row: f64) -> DVec3 {
    let [z, y, ..] = sample(RINGS, row);
    dvec3(0.0, y, z)
}

/// Lofts nose, head, neck, body and tail; returns the sheet.
pub(super) fn body(half: &mut Half) -> SheetId {
    let last = RINGS[RINGS.len() - 1].0 as usize;
    let rows: Vec<Vec<usize>> = (0..=last).map(|row| half.add(ring(row), 0.05)).collect();
    let (nose, tip) = (rows[0].clone(), rows[last].clone());
    let sheet = half.add_sheet(Sheet { rows, closed: false, midline: true });
    let from_below: Vec<usize> = nose.into_iter().rev().collect();
    let muzzle = half.cap(&from_below, 2, 4, DVec3::Z * 0.05);
    for (row, forward) in [(1, 0.005), (2, -0.045), (3, 0.02)] {
        for column in 0..2 {
            let vertex = half.sheets[muzzle].rows[row][column];
            half.points[vertex].z += forward;
            half.softness[vertex] = 0.05;
        }
    }
    half.cap(&tip, 2, 4, DVec3::NEG_Z * 0.03);
    sheet
}

/// The right half of one ring, top to bottom.
fn ring(row: usize) -> Vec<DVec3> {
    let [z, y, pitch, width, back, belly, gathered] = sample(RINGS, row as f64);
    let (sine, cosine) = pitch.to_radians().sin_cos();
    let up = dvec3(0.0, cosine, -sine);
    let point = |column: usize| {
        let near_mouth = if column == MOUTH {
            1.0
        } else if column.abs_diff(MOUTH) == 1 {
            0.7
        } else {
            0.0
        };
        let rise = near_mouth * SMILE.get(row).copied().unwrap_or(0.0);
        let angle = ANGLES[0][column] + gathered * (ANGLES[1][column] - ANGLES[0][column]) - rise;
        let (across, along) = match column {
            0 => (0.0, 1.0),
            COLUMNS => (0.0, -1.0),
            _ => angle.to_radians().sin_cos(),
        };
        let inward = if column == MOUTH { MOUTH_DEPTH.get(row).copied().unwrap_or(0.0) } else { 0.0 };
        let height = if along > 0.0 { back } else { belly };
        dvec3(0.0, y, z) + DVec3::X * width * across * (1.0 - inward) + up * height * along
    };
    (0..=COLUMNS).map(point).collect()
}
