//! The ball of an eye: a closed component of its own.

use glam::{DMat3, DVec3, dvec3};

use super::half::{Half, Sheet};

/// Quads along each side of the cube that becomes the ball.
const SIDE: usize = 3;

/// A ball that looks along `gaze`, its pupil drilled as sculptors do.
pub(super) fn eyeball(half: &mut Half, center: DVec3, gaze: DVec3, radius: f64) {
    let right = DVec3::Y.cross(gaze).normalize();
    let frame = DMat3::from_cols(right, gaze.cross(right), gaze);
    let place = |p: DVec3| center + radius * (frame * p.normalize());
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for row in 0..=SIDE {
        // Rows run round the gaze from front to back, counter-clockwise seen from the front.
        let depth = 1.0 - 2.0 * row as f64 / SIDE as f64;
        let points = square().into_iter().map(|(x, y)| place(dvec3(x, y, even(depth)))).collect::<Vec<_>>();
        rows.push(half.add(points, 0.0));
    }
    let (front, back) = (rows[0].clone(), rows[SIDE].clone());
    rows.reverse();
    half.add_sheet(Sheet { rows, closed: true, midline: false });
    let iris = half.cap(&front, SIDE, SIDE, DVec3::ZERO);
    let count = back.len();
    let from_behind: Vec<usize> = (0..count).map(|k| back[(count - k) % count]).collect();
    half.cap(&from_behind, SIDE, SIDE, DVec3::ZERO);
    for point in &mut half.points[front[0]..] {
        *point = center + radius * (*point - center).normalize();
    }
    half.softness[front[0]..].fill(0.0);
    pupil(half, iris, center, gaze, radius);
}

/// Cube coordinate whose projection on the sphere is spread evenly.
fn even(t: f64) -> f64 {
    (t * std::f64::consts::FRAC_PI_4).tan()
}

/// The border of a square of half side 1, counter-clockwise from its lower left corner.
fn square() -> Vec<(f64, f64)> {
    let step = |k: usize| even(2.0 * k as f64 / SIDE as f64 - 1.0);
    let corner = |side: usize, t: f64| match side {
        0 => (t, -1.0),
        1 => (1.0, t),
        2 => (-t, 1.0),
        _ => (-1.0, -t),
    };
    (0..4).flat_map(|side| (0..SIDE).map(move |k| corner(side, step(k)))).collect()
}

/// Sinks the middle quad of the front.
fn pupil(half: &mut Half, iris: usize, center: DVec3, gaze: DVec3, radius: f64) {
    let rim = half.cut(iris, 1..2, 1..2);
    for &vertex in &rim {
        let spoke = (half.points[vertex] - center).reject_from_normalized(gaze).normalize();
        half.points[vertex] = center + radius * (0.875 * gaze + 0.56 * spoke);
    }
    let mut rows = vec![rim.clone()];
    for (depth, reach) in [(0.885, 0.47), (0.66, 0.36)] {
        let points: Vec<DVec3> = rim
            .iter()
            .map(|&vertex| {
                let spoke = (half.points[vertex] - center).reject_from_normalized(gaze).normalize();
                center + radius * (depth * gaze + reach * spoke)
            })
            .collect();
        rows.push(half.add(points, 0.0));
    }
    let bottom = rows[2].clone();
    half.add_sheet(Sheet { rows, closed: true, midline: false });
    half.cap(&bottom, 1, 1, DVec3::ZERO);
}
