//! The plain cages: cube, pyramid, torus, wavy grid and a mix of polygons.

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};

use super::mesh::Mesh;

/// The cube of half side 1.
pub(super) fn cube() -> Mesh {
    let points = (0..8).map(|i| dvec3(side(i, 0), side(i, 1), side(i, 2))).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh::new(points, faces.map(Vec::from).into())
}

/// 1 or -1 by a bit of `index`.
fn side(index: usize, bit: usize) -> f64 {
    if index >> bit & 1 == 1 { 1.0 } else { -1.0 }
}

/// A pyramid over a square; base first, apex last.
pub(super) fn pyramid() -> Mesh {
    let points = vec![
        dvec3(-1.0, 0.0, -1.0),
        dvec3(1.0, 0.0, -1.0),
        dvec3(1.0, 0.0, 1.0),
        dvec3(-1.0, 0.0, 1.0),
        dvec3(0.0, 1.6, 0.0),
    ];
    let faces = vec![vec![0, 1, 2, 3], vec![1, 0, 4], vec![2, 1, 4], vec![3, 2, 4], vec![0, 3, 4]];
    Mesh::new(points, faces)
}

/// A torus about the y axis of `around` by `across` quads.
pub(super) fn torus(around: usize, across: usize) -> Mesh {
    let (major, minor) = (1.0, 0.4);
    let node = |i: usize, j: usize| (i % around) * across + j % across;
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for i in 0..around {
        for j in 0..across {
            let angle = TAU * j as f64 / across as f64;
            points.push(circle(i, around, major + minor * angle.cos()) + DVec3::Y * minor * angle.sin());
            faces.push(vec![node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
        }
    }
    Mesh::new(points, faces)
}

/// Point `index` of `count` on a circle about the y axis, counter-clockwise seen from above.
pub(super) fn circle(index: usize, count: usize, radius: f64) -> DVec3 {
    let angle = TAU * index as f64 / count as f64;
    radius * dvec3(angle.cos(), 0.0, -angle.sin())
}

/// A wavy open grid over the square of half side 1, `count` quads along each side.
pub(super) fn grid(count: usize) -> Mesh {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    let row = count + 1;
    for j in 0..=count {
        for i in 0..=count {
            let [x, z] = [i, j].map(|k| 2.0 * k as f64 / count as f64 - 1.0);
            points.push(dvec3(x, 0.25 * (3.0 * x).sin() * (2.5 * z).cos(), z));
            if i < count && j < count {
                let node = j * row + i;
                faces.push(vec![node, node + row, node + row + 1, node + 1]);
            }
        }
    }
    Mesh::new(points, faces)
}

/// A closed drum of one hexagon, pentagons, quads and triangles.
pub(super) fn ngon() -> Mesh {
    let ring =
        |count: usize, radius: f64, height: f64| (0..count).map(move |k| circle(k, count, radius).with_y(height));
    let points = ring(6, 1.0, -0.7).chain(ring(6, 1.1, 0.4)).chain(ring(3, 0.45, 0.9)).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..6).rev().collect(), vec![0, 1, 7], vec![0, 7, 6]];
    faces.extend((1..6).map(|k| vec![k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k]));
    faces.extend((0..3).map(|k| vec![6 + 2 * k, 7 + 2 * k, 6 + (2 * k + 2) % 6, 12 + (k + 1) % 3, 12 + k]));
    faces.push(vec![12, 13, 14]);
    Mesh::new(points, faces)
}
