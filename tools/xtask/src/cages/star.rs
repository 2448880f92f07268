//! Open domes round one vertex of chosen valence.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec3};

use super::mesh::{Mesh, Welder};

/// The valences of the shipped stars.
pub(super) const VALENCES: [usize; 11] = [3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 32];

/// Quads from the centre to the rim.
const RINGS: usize = 2;

/// An open dome of `valence` sectors of 2 x 2 quads; vertex 0 is the centre.
pub(super) fn star(valence: usize) -> Mesh {
    let mut welder = Welder::new();
    let mut faces = Vec::new();
    for sector in 0..valence {
        for (i, j) in squares(RINGS) {
            let corners = quad(i, j).map(|(i, j)| spoke_owner(valence, sector, i, j));
            faces.push(corners.map(|(s, i, j)| welder.index((s, i, j), || dome(place(valence, s, i, j)))).into());
        }
    }
    Mesh::new(welder.points, faces)
}

/// The valences that stand side by side in [`stars`]: those with a pipeline of their own, and the regular one.
pub(super) const SIDE_BY_SIDE: std::ops::RangeInclusive<usize> = 3..=12;

/// Two rows of stars, one of each valence.
pub(super) fn stars() -> Mesh {
    let mut all = Mesh::default();
    let columns = SIDE_BY_SIDE.count() / 2;
    for (number, valence) in SIDE_BY_SIDE.enumerate() {
        let (row, column) = (number / columns, number % columns);
        // No star reaches farther than 1.4 from its centre.
        let centre = 3.0 * dvec3(column as f64, 0.0, row as f64);
        let (star, first) = (star(valence), all.points.len());
        all.points.extend(star.points.iter().map(|&p| p + centre));
        all.faces.extend(star.faces.iter().map(|face| face.iter().map(|vertex| first + vertex).collect::<Vec<_>>()));
    }
    all
}

/// Every (i, j) below `side`.
pub(super) fn squares(side: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..side).flat_map(move |i| (0..side).map(move |j| (i, j)))
}

/// Corners of the quad at (i, j), counter-clockwise where i and j run along spokes in that order.
pub(super) fn quad(i: usize, j: usize) -> [(usize, usize); 4] {
    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
}

/// The one name of a node: those with i = 0 lie on the next sector's spoke, and all sectors share the centre.
fn spoke_owner(valence: usize, sector: usize, i: usize, j: usize) -> (usize, usize, usize) {
    match (i, j) {
        (0, 0) => (0, 0, 0),
        (0, j) => ((sector + 1) % valence, j, 0),
        (i, j) => (sector, i, j),
    }
}

/// Plane position of node (i, j) of a sector: polar, the rim scalloped so that no quad of a narrow sector flattens.
fn place(valence: usize, sector: usize, i: usize, j: usize) -> DVec2 {
    if i + j == 0 {
        return DVec2::ZERO;
    }
    let across = j as f64 / (i + j) as f64;
    let reach = (2.0 * (PI / valence as f64).cos()).min(1.4);
    let bulge = 1.0 + (reach - 1.0) * (i.min(j) as f64 / i.max(j) as f64);
    let radius = bulge * i.max(j) as f64 / RINGS as f64;
    radius * DVec2::from_angle(TAU * (sector as f64 + across) / valence as f64)
}

/// Lifts a plane position, counter-clockwise seen from above, onto a gentle dome.
fn dome(p: DVec2) -> DVec3 {
    dvec3(p.x, 0.4 - 0.3 * p.length_squared(), -p.y)
}
