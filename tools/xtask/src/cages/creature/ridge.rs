//! The row of rounded spines along the back.

use glam::{DVec3, dvec3};

use super::half::{Half, Part, Sheet, SheetId};

/// Rows of the trunk that carry a spine, and its height.
const SPINES: [(usize, f64); 9] =
    [(8, 0.12), (10, 0.12), (12, 0.12), (16, 0.13), (18, 0.14), (20, 0.14), (22, 0.13), (24, 0.11), (26, 0.09)];

/// Grows the spines.
pub(super) fn ridge(half: &mut Half, trunk: SheetId) {
    half.growing = Part::Ridge;
    for (row, height) in SPINES {
        spine(half, trunk, row, height);
    }
}

fn spine(half: &mut Half, trunk: SheetId, row: usize, height: f64) {
    let rim = half.cut(trunk, row..row + 1, 0..1);
    let ends = [half.points[rim[0]], half.points[rim[3]]];
    let back = (ends[1] - ends[0]).normalize();
    let up = dvec3(0.0, -back.z, back.y).normalize();
    let up = if up.y < 0.0 { -up } else { up };
    let base = 0.5 * (ends[0] + ends[1]);
    let length = ends[0].distance(ends[1]);
    let mut rows = vec![rim];
    for (rise, lean, long, wide) in [(0.35, 0.05, 0.42, 0.045), (1.0, 0.35, 0.16, 0.018)] {
        let middle = base + height * (rise * up + lean * back);
        let point = |along: f64, x: f64| middle + along * long * length * back + DVec3::X * x;
        rows.push(half.add([point(-1.0, 0.0), point(-1.0, wide), point(1.0, wide), point(1.0, 0.0)], 0.0));
    }
    let tip = rows[2].clone();
    half.add_sheet(Sheet { rows, closed: false, midline: true });
    half.cap(&tip, 1, 1, DVec3::ZERO);
}
