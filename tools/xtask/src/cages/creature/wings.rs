//! A small bat's wing: a thin sheet with a thick leading edge and a scalloped trailing edge.

use glam::DVec3;

use super::half::{Half, Part, Sheet, SheetId};
use super::spline::{Keys, sample};

/// Quads along the chord.
const CHORD: usize = 4;
/// Rows of quads from the root to the tip.
const SPAN: usize = 8;
/// First row of the trunk under the wing.
const ROOT: usize = 14;

/// Leading edge by row: x, y, z.
const LEADING: &Keys<3> = &[
    (0.0, [0.25, 1.08, 0.24]),
    (2.0, [0.36, 1.40, 0.12]),
    (4.0, [0.47, 1.72, -0.06]),
    (5.0, [0.53, 1.84, -0.20]),
    (8.0, [0.66, 2.00, -0.80]),
];
/// Trailing edge by row.
const TRAILING: &Keys<3> = &[
    (0.0, [0.25, 1.03, -0.16]),
    (2.0, [0.36, 1.14, -0.48]),
    (4.0, [0.46, 1.30, -0.82]),
    (6.0, [0.57, 1.54, -1.00]),
    (8.0, [0.67, 1.95, -0.90]),
];
/// How far the membrane falls short of the trailing edge between two fingers, as a share of the chord.
const SCALLOP: f64 = 0.32;

/// Grows the right wing.
pub(super) fn wing(half: &mut Half, trunk: SheetId) {
    half.growing = Part::Wing;
    let rim = half.cut(trunk, ROOT..ROOT + CHORD, 1..2);
    half.soften(&rim, 0.4);
    let mut rows = vec![rim];
    for row in 1..=SPAN {
        rows.push(half.add(section(row as f64), if row == 1 { 0.3 } else { 0.0 }));
    }
    let tip = rows[SPAN].clone();
    half.add_sheet(Sheet { rows, closed: true, midline: false });
    half.cap(&tip, 1, CHORD, DVec3::ZERO);
}

/// One closed section in the order of the rim: the upper front corner, the lower side to the rear, the upper side back.
fn section(row: f64) -> Vec<DVec3> {
    let lead = DVec3::from(sample(LEADING, row));
    let full = DVec3::from(sample(TRAILING, row));
    let between_fingers = row % 2.0 == 1.0;
    let trail = full.lerp(lead, if between_fingers && row > 1.0 { SCALLOP } else { 0.0 });
    let along = DVec3::from(sample(LEADING, row + 0.5)) - DVec3::from(sample(LEADING, row - 0.5));
    let up = (trail - lead).cross(along).normalize();
    let up = if up.x < 0.0 { up } else { -up };
    let finger = if between_fingers { 0.0 } else { 0.026 };
    let point = |chord: usize, side: f64| {
        let t = chord as f64 / CHORD as f64;
        let thickness = if chord == 0 { 0.035 } else { 0.010 + finger * (1.0 - t) };
        let camber = 0.16 * t * (1.0 - t) * lead.distance(trail);
        lead.lerp(trail, t) + (camber + side * thickness) * up
    };
    let lower = (0..=CHORD).map(|chord| point(chord, -1.0));
    let upper = (1..=CHORD).rev().map(|chord| point(chord, 1.0));
    std::iter::once(point(0, 1.0)).chain(lower).chain(upper).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_thin_and_fits_the_rim() {
        let section = section(3.0);
        assert_eq!(section.len(), 2 * (CHORD + 1));
        // The two corners of the leading edge come first, and lower and upper side lie opposite each other.
        for (lower, upper) in [(1, 0), (2, 9), (3, 8), (4, 7), (5, 6)] {
            assert!(section[lower].distance(section[upper]) < 0.1, "{lower} and {upper}");
        }
    }
}
