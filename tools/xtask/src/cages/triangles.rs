//! A pebble of triangles with valences from 4 to 9: a subdivided icosahedron after random edge flips.

use std::collections::BTreeMap;

use glam::{DVec3, dvec3};

use super::mesh::{Mesh, Welder, corner_pairs};
use super::rng::Rng;

/// The smallest and the largest valence that flips may make.
const VALENCES: std::ops::RangeInclusive<usize> = 4..=9;

/// A closed cage of 320 triangles.
pub(super) fn pebble() -> Mesh {
    let mut mesh = split(&split(&icosahedron()));
    let mut rng = Rng::new(7);
    for _ in 0..FLIP_ROUNDS {
        for _ in 0..FLIPS_PER_ROUND {
            let (face, corner) = (rng.below(mesh.faces.len()), rng.below(3));
            flip(&mut mesh, face, corner);
        }
        relax(&mut mesh);
    }
    for point in &mut mesh.points {
        *point = shape(*point);
    }
    mesh
}

/// Rounds of flips with relaxation between them.
const FLIP_ROUNDS: usize = 6;
/// Flips tried in each round; most are refused.
const FLIPS_PER_ROUND: usize = 60;

/// The icosahedron inscribed in the unit sphere: 12 vertices of valence 5.
fn icosahedron() -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut points = Vec::new();
    for (a, b) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        points.extend([dvec3(0.0, a, b), dvec3(a, b, 0.0), dvec3(b, 0.0, a)]);
    }
    let near = |a: DVec3, b: DVec3| (a.distance(b) - 2.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for a in 0..12 {
        // Each triangle once, from its smallest vertex, counter-clockwise.
        for (b, c) in (a + 1..12).flat_map(|b| (a + 1..12).map(move |c| (b, c))) {
            let (p, q, r) = (points[a], points[b], points[c]);
            if near(p, q) && near(q, r) && near(r, p) && p.dot(q.cross(r)) > 0.0 {
                faces.push(vec![a, b, c]);
            }
        }
    }
    Mesh::new(points.iter().map(|p| p.normalize()).collect(), faces)
}

/// Every triangle of a mesh on the unit sphere into four.
fn split(mesh: &Mesh) -> Mesh {
    let mut welder = Welder::new();
    for (vertex, &point) in mesh.points.iter().enumerate() {
        welder.index((vertex, vertex), || point);
    }
    let mut faces = Vec::new();
    for face in &mesh.faces {
        let middle: Vec<usize> = corner_pairs(face)
            .map(|(a, b)| welder.index((a.min(b), a.max(b)), || (mesh.points[a] + mesh.points[b]).normalize()))
            .collect();
        faces.extend((0..3).map(|k| vec![face[k], middle[k], middle[(k + 2) % 3]]));
        faces.push(middle);
    }
    Mesh::new(welder.points, faces)
}

/// Turns the edge that leaves a corner to the other diagonal of its two triangles, where that leaves valences in range
/// and both triangles well shaped.
fn flip(mesh: &mut Mesh, face: usize, corner: usize) {
    let [a, b, c] = [0, 1, 2].map(|k| mesh.faces[face][(corner + k) % 3]);
    let across = mesh.faces.iter().position(|other| corner_pairs(other).any(|edge| edge == (b, a)));
    let other = across.expect("the pebble is closed");
    let d = mesh.faces[other].iter().copied().find(|&v| v != a && v != b).expect("a triangle");
    let valence = valences(mesh);
    let loses = [a, b].iter().all(|&v| VALENCES.contains(&(valence[v] - 1)));
    let gains = [c, d].iter().all(|&v| VALENCES.contains(&(valence[v] + 1)));
    let joined = mesh.faces.iter().any(|face| face.contains(&c) && face.contains(&d));
    let [p, q, r, s] = [a, b, c, d].map(|vertex| mesh.points[vertex]);
    if loses && gains && !joined && quality(p, s, r) > 0.3 && quality(s, q, r) > 0.3 {
        mesh.faces[face] = vec![a, d, c];
        mesh.faces[other] = vec![d, b, c];
    }
}

fn valences(mesh: &Mesh) -> Vec<usize> {
    let mut valence = vec![0; mesh.points.len()];
    mesh.faces.iter().flatten().for_each(|&vertex| valence[vertex] += 1);
    valence
}

/// Shape of a triangle seen from outside the unit sphere: 1 if equilateral, 0 if flat, negative if turned over.
fn quality(p: DVec3, q: DVec3, r: DVec3) -> f64 {
    let double_area = (q - p).cross(r - p).dot((p + q + r).normalize());
    let squares = p.distance_squared(q) + q.distance_squared(r) + r.distance_squared(p);
    2.0 * 3f64.sqrt() * double_area / squares
}

/// Moves every vertex towards the middle of its neighbours on the unit sphere.
fn relax(mesh: &mut Mesh) {
    for _ in 0..4 {
        let mut sums: BTreeMap<usize, DVec3> = BTreeMap::new();
        for (a, b) in mesh.faces.iter().flat_map(|face| corner_pairs(face)) {
            *sums.entry(a).or_default() += mesh.points[b];
        }
        for (vertex, sum) in sums {
            mesh.points[vertex] = (mesh.points[vertex] + sum.normalize()).normalize();
        }
    }
}

/// From the unit sphere to a lopsided pebble.
fn shape(p: DVec3) -> DVec3 {
    let bump = 1.0 + 0.12 * (2.0 * p.x + 1.0).sin() * (3.0 * p.y).cos() + 0.08 * (4.0 * p.z + p.x).sin();
    bump * p * dvec3(1.2, 0.8, 1.0)
}
