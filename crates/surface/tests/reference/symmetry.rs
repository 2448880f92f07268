//! Affine maps, the numbering of the vertices of a face, and the order of faces must not matter;
//! regular meshes are tensor B-splines.

use glam::{DMat3, DVec2, DVec3};
use osculate_surface::reference::{Boundary, EvalError, Mesh, Reference, Sample};

use crate::cages;

/// Some places in the unit square: inside, on edges, at corners, near irregular vertices.
const PLACES: [(f64, f64); 8] =
    [(0.3, 0.6), (0.91, 0.04), (0.5, 0.5), (0.0, 0.37), (1.0, 0.25), (0.0, 0.0), (1.0, 1.0), (1e-6, 3e-6)];

fn samples(mesh: &Mesh, rule: Boundary) -> Vec<Sample> {
    let reference = Reference::new(mesh, rule).expect("the cage is valid");
    let mut samples = Vec::new();
    for (face, ring) in mesh.faces().enumerate() {
        for sub in cages::sub_faces(ring.len()) {
            samples.extend(PLACES.map(|(s, t)| reference.eval(face, sub, s, t).expect("a sample of the surface")));
        }
    }
    samples
}

fn assert_close(a: DVec3, b: DVec3, tolerance: f64, what: &str) {
    assert!((a - b).length() <= tolerance * a.length().max(1.0), "{what}: {a} against {b}");
}

#[test]
fn commutes_with_affine_maps() {
    let linear = DMat3::from_cols(DVec3::new(1.2, 0.3, -0.4), DVec3::new(0.1, 0.7, 0.2), DVec3::new(-0.5, 0.1, 1.6));
    let moved = |mesh: &Mesh| Mesh {
        positions: mesh.positions.iter().map(|&p| linear * p + DVec3::splat(3.0)).collect(),
        ..mesh.clone()
    };
    for case in cages::all() {
        for (a, b) in samples(&case.mesh, case.rule).iter().zip(samples(&moved(&case.mesh), case.rule)) {
            assert_close(linear * a.position + DVec3::splat(3.0), b.position, 1e-14, &case.name);
            assert_close(linear * a.du, b.du, 1e-12, &case.name);
            assert_close(linear * a.dv, b.dv, 1e-12, &case.name);
            let normal = linear.inverse().transpose() * a.normal;
            assert_close(normal.normalize_or_zero(), b.normal, 1e-8, &case.name);
        }
    }
}

#[test]
fn a_cage_far_away_keeps_its_derivatives() {
    // Coordinates with few bits, so that moving the cage is exact.
    let near = Mesh {
        positions: cages::pyramid().positions.iter().map(|p| (p * 1024.0).round() / 1024.0).collect(),
        ..cages::pyramid()
    };
    let far =
        Mesh { positions: near.positions.iter().map(|&p| p + DVec3::splat(2f64.powi(40))).collect(), ..near.clone() };
    for (a, b) in samples(&near, Boundary::EdgeOnly).iter().zip(samples(&far, Boundary::EdgeOnly)) {
        assert_eq!((a.du, a.dv, a.normal), (b.du, b.dv, b.normal));
    }
}

#[test]
fn renumbering_a_quad_turns_its_parameters() {
    let mesh = cages::grid(3, 3);
    let turned = Mesh::from_faces(mesh.positions.clone(), mesh.faces().map(|q| [q[1], q[2], q[3], q[0]]));
    let [a, b] = [&mesh, &turned].map(|mesh| Reference::new(mesh, Boundary::EdgeOnly).expect("the cage is valid"));
    for face in 0..9 {
        for (s, t) in PLACES {
            // The old corner 1 is the new (0,0): old s = 1 - new t, old t = new s.
            let (old, new) = (a.eval(face, -1, 1.0 - t, s).expect("old"), b.eval(face, -1, s, t).expect("new"));
            assert_close(old.position, new.position, 1e-14, "position");
            assert_close(old.dv, new.du, 1e-9, "du");
            assert_close(-old.du, new.dv, 1e-9, "dv");
        }
    }
}

/// The cubic B-spline with knots 0 to 4, by truncated powers.
fn cubic(x: f64) -> f64 {
    [1.0, -4.0, 6.0, -4.0, 1.0].iter().enumerate().map(|(k, c)| c * (x - k as f64).max(0.0).powi(3)).sum::<f64>() / 6.0
}

#[test]
fn a_regular_grid_is_a_tensor_b_spline() {
    let (columns, rows) = (5, 6);
    let mesh = cages::grid(columns, rows);
    let reference = Reference::new(&mesh, Boundary::EdgeAndCorner).expect("the cage is valid");
    let spline = |at: DVec2| {
        let weight = |i: usize| {
            let (x, y) = (i % (columns as usize + 1), i / (columns as usize + 1));
            cubic(at.x - x as f64 + 2.0) * cubic(at.y - y as f64 + 2.0)
        };
        mesh.positions.iter().enumerate().map(|(i, &point)| weight(i) * point).sum::<DVec3>()
    };
    for (x, y) in [(1, 1), (3, 4), (2, 3), (1, 4)] {
        for (s, t) in PLACES {
            let sample = reference.eval(x + y * columns as usize, -1, s, t).expect("a sample of the surface");
            assert!(!sample.irregular);
            assert_close(spline(DVec2::new(x as f64 + s, y as f64 + t)), sample.position, 1e-13, "position");
        }
    }
}

#[test]
fn refuses_what_is_not_on_the_surface() {
    let mesh = cages::pyramid();
    let reference = Reference::new(&mesh, Boundary::EdgeOnly).expect("the cage is valid");
    assert_eq!(reference.eval(5, 0, 0.5, 0.5), Err(EvalError::FaceOutOfRange { face: 5, faces: 5 }));
    for (face, sides, sub) in [(0, 4, 0), (0, 4, -2), (1, 3, -1), (1, 3, 3), (1, 3, i32::MIN)] {
        assert_eq!(reference.eval(face, sub, 0.5, 0.5), Err(EvalError::NoSuchSubFace { face, sides, sub }));
    }
    for (s, t) in [(-1e-300, 0.5), (0.5, 1.0 + f64::EPSILON), (f64::NAN, 0.5), (0.5, f64::INFINITY)] {
        assert!(matches!(reference.eval(0, -1, s, t), Err(EvalError::OutsideUnitSquare { .. })));
    }
}
