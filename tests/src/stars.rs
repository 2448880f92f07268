//! Cages of any valence: quads around one vertex, and around two.

use glam::DVec3;
use osculate_cage::Cage;

use crate::zoo::cage;

/// Two poles of valence `n`, 2 or more, with `n` quads each, whose zigzag rim has vertices of valence 3.
pub fn trapezohedron(n: usize) -> Cage {
    let rim = |i: usize| {
        let zigzag = if i.is_multiple_of(2) { 0.15 } else { -0.15 };
        let angle = std::f64::consts::PI * i as f64 / n as f64;
        let radius = 1.0 + 0.04 * (i % 5) as f64;
        DVec3::new(radius * angle.cos(), zigzag + 0.03 * (i % 3) as f64, -radius * angle.sin())
    };
    let mut positions: Vec<DVec3> = (0..2 * n).map(rim).collect();
    positions.extend([DVec3::new(0.05, 0.8, 0.0), DVec3::new(0.0, -0.9, 0.1)]);
    let n = n as u32;
    let around = |i: u32| i % (2 * n);
    let above = |i: u32| vec![2 * n, around(2 * i), around(2 * i + 1), around(2 * i + 2)];
    let below = |i: u32| vec![2 * n + 1, around(2 * i + 3), around(2 * i + 2), around(2 * i + 1)];
    let faces: Vec<Vec<u32>> = (0..n).flat_map(|i| [above(i), below(i)]).collect();
    cage(positions, &faces)
}

/// Quads around the origin in `n` sectors of four by four, over a disc, with spokes of edges of length 1 and with height `z(x, y)`.
pub fn star(n: usize, z: impl Fn(f64, f64) -> f64) -> Cage {
    const RINGS: usize = 4;
    let spoke = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / n as f64;
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    };
    // Diagonals reach as far as those of a square grid, so that narrow sectors do not bulge.
    let place = |i: usize, a: usize, b: usize| {
        let (first, second) = (spoke(i), spoke(i + 1));
        let middle = first + second;
        let skew = a.min(b) as f64 * (std::f64::consts::SQRT_2 - middle.length());
        let flat = a as f64 * first + b as f64 * second + skew * middle.normalize();
        flat.with_z(z(flat.x, flat.y))
    };
    let number = |i: usize, a: usize, b: usize| match (a, b) {
        (0, 0) => 0,
        (0, b) => 1 + ((i + 1) % n * RINGS + b - 1) * (RINGS + 1),
        (a, b) => 1 + (i * RINGS + a - 1) * (RINGS + 1) + b,
    } as u32;
    let rows = (0..n).flat_map(|i| (1..=RINGS).flat_map(move |a| (0..=RINGS).map(move |b| (i, a, b))));
    let positions = std::iter::once((0, 0, 0)).chain(rows).map(|(i, a, b)| place(i, a, b)).collect();
    let quads = (0..n).flat_map(|i| (0..RINGS).flat_map(move |a| (0..RINGS).map(move |b| (i, a, b))));
    let corners = |(i, a, b)| vec![number(i, a, b), number(i, a + 1, b), number(i, a + 1, b + 1), number(i, a, b + 1)];
    let faces: Vec<Vec<u32>> = quads.map(corners).collect();
    cage(positions, &faces)
}
