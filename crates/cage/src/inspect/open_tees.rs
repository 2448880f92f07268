//! Boundary vertices in the middle of boundary edges.

use glam::DVec3;

use crate::{Bounds, Cage, NONE};

/// A vertex is on an edge if its distance is below this part of the edge's length.
const NEAR: f64 = 1e-4;
/// How many vertices are looked at altogether: edges that cross each other everywhere must not take forever.
const MOST_LOOKS: usize = 20_000_000;

/// The boundary vertices that lie on a boundary edge between its ends, in rising order.
pub(super) fn find(cage: &Cage) -> Vec<u32> {
    let topology = cage.topology();
    let boundary = (0..cage.vertex_count() as u32).filter(|&v| topology.is_boundary_vertex(v));
    let mut points: Vec<(DVec3, u32)> = boundary.map(|v| (cage.positions()[v as usize], v)).collect();
    sort(&mut points, 0);

    let (mut found, mut looks) = (Vec::new(), MOST_LOOKS);
    let edges = (0..topology.half_edge_count() as u32).filter(|&h| topology.twin(h) == NONE);
    for h in edges {
        let ends = [topology.origin(h), topology.target(h)];
        let [a, b] = ends.map(|v| cage.positions()[v as usize]);
        let near = NEAR * a.distance(b);
        let between = |p: DVec3| {
            let t = (p - a).dot(b - a) / a.distance_squared(b);
            t > NEAR && t < 1.0 - NEAR && p.distance(a.lerp(b, t)) < near
        };
        let mut reach = Bounds::of(&[a, b]);
        (reach.min, reach.max) = (reach.min - near, reach.max + near);
        visit(&points, 0, &reach, &mut looks, &mut |p, v| {
            // A face without area lies on its own sides.
            if between(p) && !topology.face_vertices(topology.face(h)).contains(&v) {
                found.push(v);
            }
        });
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Makes a balanced tree of points: the middle one divides the others along an axis, which changes from level to level.
fn sort(points: &mut [(DVec3, u32)], axis: usize) {
    if points.len() < 2 {
        return;
    }
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let (left, right) = points.split_at_mut(middle);
    sort(left, (axis + 1) % 3);
    sort(&mut right[1..], (axis + 1) % 3);
}

/// Visits the points of a tree that are in a box, as long as there are looks left.
fn visit(points: &[(DVec3, u32)], axis: usize, reach: &Bounds, looks: &mut usize, action: &mut impl FnMut(DVec3, u32)) {
    if points.is_empty() || *looks == 0 {
        return;
    }
    *looks -= 1;
    let middle = points.len() / 2;
    let (p, v) = points[middle];
    if p[axis] >= reach.min[axis] {
        visit(&points[..middle], (axis + 1) % 3, reach, looks, action);
    }
    if p.cmpge(reach.min).all() && p.cmple(reach.max).all() {
        action(p, v);
    }
    if p[axis] <= reach.max[axis] {
        visit(&points[middle + 1..], (axis + 1) % 3, reach, looks, action);
    }
}
