//! Fairing: soft vertices move towards the middle of their neighbours.

use std::collections::BTreeSet;

use glam::DVec3;

use super::half::{Half, reflect};

/// Rounds of fairing.
const ROUNDS: usize = 6;

/// Smooths the soft parts of a half. Vertices on the plane of symmetry see their neighbours on both sides and stay there.
pub(super) fn fair(half: &mut Half) {
    let neighbours = neighbours(half);
    for _ in 0..ROUNDS {
        let middles: Vec<DVec3> = neighbours.iter().enumerate().map(|(v, around)| middle(half, v, around)).collect();
        for (vertex, middle) in middles.into_iter().enumerate() {
            half.points[vertex] = half.points[vertex].lerp(middle, half.softness[vertex]);
        }
    }
}

fn middle(half: &Half, vertex: usize, around: &BTreeSet<usize>) -> DVec3 {
    if around.is_empty() {
        return half.points[vertex];
    }
    let on_plane = half.points[vertex].x == 0.0;
    let seen = |&other: &usize| {
        let point = half.points[other];
        if on_plane { 0.5 * (point + reflect(point)) } else { point }
    };
    // On the plane a neighbour beside it counts twice: it is seen on both sides.
    let weight = |&other: &usize| if on_plane && half.points[other].x != 0.0 { 2.0 } else { 1.0 };
    let total: f64 = around.iter().map(weight).sum();
    around.iter().map(|other| weight(other) * seen(other)).sum::<DVec3>() / total
}

fn neighbours(half: &Half) -> Vec<BTreeSet<usize>> {
    let mut neighbours = vec![BTreeSet::new(); half.points.len()];
    for &cell in &half.cells {
        let corners = half.corners(cell);
        for (a, b) in (0..4).map(|k| (corners[k], corners[(k + 1) % 4])) {
            neighbours[a].insert(b);
            neighbours[b].insert(a);
        }
    }
    neighbours
}
