//! Subdividing the whole mesh several times and applying the limit mask of positions to every
//! vertex gives the surface at a grid of dyadic parameters.

use std::collections::HashSet;

use glam::{DVec2, DVec3};
use osculate_surface::reference::{Boundary, Mesh, Reference};

use crate::cages::{self, Case};

/// Which part of the cage a quad is, and the parameters of its corners there.
#[derive(Clone, Copy)]
struct Part {
    face: usize,
    sub: i32,
    corners: [DVec2; 4],
}

impl Part {
    /// The children in order; quads beyond the first step are numbered by the corner that they
    /// hold.
    fn children(self) -> impl Iterator<Item = Self> {
        let c = self.corners;
        let child =
            move |i: usize| [c[i], c[i].midpoint(c[(i + 1) % 4]), c[0].midpoint(c[2]), c[i].midpoint(c[(i + 3) % 4])];
        (0..4).map(move |i| Self { corners: child(i), ..self })
    }
}

const UNIT_SQUARE: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

/// The mesh after `steps` steps, and the part of the cage that each quad covers.
fn subdivided(cage: &Mesh, rule: Boundary, steps: usize) -> (Mesh, Vec<Part>) {
    let first = cage.faces().enumerate().flat_map(|(face, ring)| {
        let part = move |sub| Part { face, sub, corners: UNIT_SQUARE };
        let quad = ring.len() == 4;
        let whole = part(-1).children();
        let apart = cages::sub_faces(ring.len()).map(part);
        whole.filter(move |_| quad).chain(apart.filter(move |_| !quad))
    });
    let (mut mesh, mut parts) = (cage.subdivide(rule).mesh, first.collect::<Vec<_>>());
    for _ in 1..steps {
        mesh = mesh.subdivide(rule).mesh;
        parts = parts.into_iter().flat_map(Part::children).collect();
    }
    (mesh, parts)
}

/// Limit positions of all vertices of a quad mesh, by sums over faces: interior weights n^2, 4, 1
/// of the vertex, each neighbour and each diagonal; on the boundary 4, 1, 1 along it.
fn limits(mesh: &Mesh, rule: Boundary) -> Vec<DVec3> {
    let directed: HashSet<(u32, u32)> = mesh.faces().flat_map(|q| (0..4).map(|i| (q[i], q[(i + 1) % 4]))).collect();
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let mut rings = vec![(0.0, DVec3::ZERO, 0.0, DVec3::ZERO); mesh.positions.len()];
    for quad in mesh.faces() {
        for i in 0..4 {
            let [here, next, opposite] = [quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4]];
            rings[here as usize].0 += 1.0;
            rings[here as usize].1 += 4.0 * at(next) + at(opposite);
            if !directed.contains(&(next, here)) {
                for (end, other) in [(here, next), (next, here)] {
                    rings[end as usize].2 += 1.0;
                    rings[end as usize].3 += at(other);
                }
            }
        }
    }
    let limit = |(&point, &(n, ring, sides, along)): (&DVec3, &(f64, DVec3, f64, DVec3))| match sides > 0.0 {
        true if n == 1.0 && rule == Boundary::EdgeAndCorner => point,
        true => (4.0 * point + along) / 6.0,
        false => (n * n * point + ring) / (n * (n + 5.0)),
    };
    mesh.positions.iter().zip(&rings).map(limit).collect()
}

fn largest_error(case: &Case, steps: usize) -> f64 {
    let reference = Reference::new(&case.mesh, case.rule).expect("the cage is valid");
    let (fine, parts) = subdivided(&case.mesh, case.rule, steps);
    let limits = limits(&fine, case.rule);
    let mut largest = 0.0f64;
    for (quad, part) in fine.faces().zip(&parts) {
        for (&vertex, at) in quad.iter().zip(part.corners) {
            let sample = reference.eval(part.face, part.sub, at.x, at.y).expect("a sample of the surface");
            largest = largest.max((sample.position - limits[vertex as usize]).length());
        }
    }
    largest
}

#[test]
fn positions_are_those_of_the_subdivided_mesh() {
    let pillow = Case { name: "pillow".to_owned(), mesh: cages::pillow(), rule: Boundary::EdgeOnly };
    for case in cages::all().into_iter().chain([pillow]) {
        let steps = if case.mesh.face_count() > 50 { 3 } else { 5 };
        let error = largest_error(&case, steps);
        assert!(error < 1e-14, "{}: {error:e}", case.name);
    }
}

#[test]
fn seven_steps_change_nothing() {
    let case = Case { name: "lone triangle".to_owned(), mesh: cages::lone(3), rule: Boundary::EdgeOnly };
    let error = largest_error(&case, 7);
    assert!(error < 1e-14, "{error:e}");
}

#[test]
fn refined_points_come_in_order() {
    let cage = cages::pyramid();
    let refined = cage.subdivide(Boundary::EdgeOnly);
    assert_eq!((refined.mesh.positions.len(), refined.mesh.face_count()), (5 + 8 + 5, 16));
    let centre = cage.face(1).iter().map(|&vertex| cage.positions[vertex as usize]).sum::<DVec3>() / 3.0;
    assert!((refined.mesh.positions[refined.face_point(1) as usize] - centre).length() < 1e-15);
    // The first face meets its edges in the order of its vertices 3, 2, 1, 0.
    let edges = [(3, 2), (2, 1), (1, 0), (0, 3)].map(|(a, b)| refined.edge_point(a, b));
    assert_eq!(edges, [Some(5), Some(6), Some(7), Some(8)]);
    assert_eq!(refined.edge_point(0, 1), Some(7));
    assert_eq!(refined.edge_point(0, 2), None);
    assert_eq!(refined.mesh.face(0), [refined.vertex_point(3), 5, refined.face_point(0), 8]);
}

#[test]
#[should_panic(expected = "face 0 has 2 vertices")]
fn subdividing_an_invalid_mesh_says_why() {
    Mesh::from_faces(vec![DVec3::ZERO; 2], [[0, 1]]).subdivide(Boundary::EdgeOnly);
}
