//! Irregular vertices, and the surface very close to them.

use glam::DVec3;
use osculate_surface::reference::{Boundary, Mesh, Reference, Sample};

use crate::cages;

fn sample(mesh: &Mesh, rule: Boundary, face: usize, s: f64, t: f64) -> Sample {
    let sub = if mesh.face(face).len() == 4 { -1 } else { 0 };
    Reference::new(mesh, rule).expect("the cage is valid").eval(face, sub, s, t).expect("a sample of the surface")
}

/// A star of `n` quads around vertex 0, which is corner 0 of all of them.
fn star(n: u32) -> Mesh {
    let mut mesh = cages::half_star(n);
    // Close it: the last spoke becomes the first, and the quads spread all round.
    let faces: Vec<[u32; 4]> = mesh.faces().map(|q| [q[0], q[1], q[2], if q[3] == n + 1 { 1 } else { q[3] }]).collect();
    let turned = |i: f64, radius: f64| {
        let angle = std::f64::consts::TAU * i / f64::from(n);
        radius * DVec3::new(angle.cos(), angle.sin(), 0.2 * (3.0 * angle).sin())
    };
    for i in 0..n {
        mesh.positions[1 + i as usize] = turned(f64::from(i), 1.0);
        mesh.positions[(2 + n + i) as usize] = turned(f64::from(i) + 0.5, 1.5);
    }
    mesh.positions[0] = DVec3::new(0.1, -0.2, 0.3);
    Mesh::from_faces(mesh.positions, faces)
}

#[test]
fn the_surface_tends_to_the_vertex_limit() {
    // The normal converges as (second / first eigenvalue)^steps, slowly for high valence.
    for (n, tolerance) in [(3, 1e-12), (5, 1e-12), (6, 1e-12), (12, 1e-4)] {
        let mesh = star(n);
        let limit = sample(&mesh, Boundary::EdgeOnly, 1, 0.0, 0.0);
        assert!(limit.irregular && limit.normal.is_normalized());
        let h = 2f64.powi(-120);
        for (s, t) in [(h, 0.0), (0.7 * h, 0.9 * h), (0.0, h)] {
            let near = sample(&mesh, Boundary::EdgeOnly, 1, s, t);
            assert!(!near.irregular && near.du.is_finite() && near.dv.is_finite());
            assert!((near.position - limit.position).length() < 1e-14, "valence {n}");
            assert!(
                (near.normal - limit.normal).length() < tolerance,
                "valence {n}: {} against {}",
                near.normal,
                limit.normal
            );
        }
    }
}

#[test]
fn nearer_than_any_step_is_the_vertex() {
    for n in [3, 5, 64, 200] {
        let mesh = star(n);
        let limit = sample(&mesh, Boundary::EdgeOnly, 1, 0.0, 0.0);
        let near = sample(&mesh, Boundary::EdgeOnly, 1, 1e-300, 1e-310);
        assert!(near.irregular && (near.position - limit.position).length() < 1e-14, "valence {n}");
        assert!((near.normal - limit.normal).length() < 1e-10, "valence {n}: {} against {}", near.normal, limit.normal);
    }
}

#[test]
fn near_any_vertex_the_surface_keeps_its_shape() {
    // At a boundary vertex of two faces and a fixed corner the surface is bicubic: nothing special
    // may happen there.
    for rule in [Boundary::EdgeOnly, Boundary::EdgeAndCorner] {
        let mesh = cages::half_star(2);
        let limit = sample(&mesh, rule, 0, 0.0, 0.0);
        assert!(!limit.irregular);
        let near = sample(&mesh, rule, 0, 1e-9, 1e-9);
        assert!((near.du - limit.du).length() < 1e-7 && (near.dv - limit.dv).length() < 1e-7);
    }
}

#[test]
fn crease_normals_are_the_limit_along_the_boundary() {
    for k in 3..=8 {
        let mesh = cages::half_star(k);
        let limit = sample(&mesh, Boundary::EdgeAndCorner, 0, 0.0, 0.0);
        assert!(limit.irregular && limit.normal.is_normalized());
        // Convergence is that of (second / first eigenvalue)^steps: slow for large k.
        let along = sample(&mesh, Boundary::EdgeAndCorner, 0, 2f64.powi(-100), 0.0);
        let tolerance = if k <= 5 { 1e-6 } else { 2e-2 };
        assert!(
            (along.normal - limit.normal).length() < tolerance,
            "{k} faces: {} against {}",
            along.normal,
            limit.normal
        );
    }
}

#[test]
fn a_smoothed_corner_has_the_normal_that_the_surface_tends_to() {
    for mesh in [cages::lone(4), cages::lone(5), cages::half_star(1)] {
        let limit = sample(&mesh, Boundary::EdgeOnly, 0, 0.0, 0.0);
        assert!(limit.irregular && limit.normal.is_normalized());
        // Two modes share the second eigenvalue, so the angle falls as one over the number of
        // steps: its cotangent grows evenly.
        let cotangents = [10, 15, 20, 25].map(|steps| {
            let h = 2f64.powi(-steps);
            let normal = sample(&mesh, Boundary::EdgeOnly, 0, h, 0.2 * h).normal;
            normal.dot(limit.normal) / normal.cross(limit.normal).length()
        });
        let growth = [1, 2, 3].map(|i| cotangents[i] - cotangents[i - 1]);
        assert!(growth[0] > 0.0, "{cotangents:?}");
        assert!(growth.iter().all(|g| (g / growth[0] - 1.0).abs() < 1e-2), "{cotangents:?}");
    }
}

#[test]
fn a_fixed_corner_is_interpolated() {
    let mesh = cages::lone(4);
    for (corner, (s, t)) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].into_iter().enumerate() {
        let fixed = sample(&mesh, Boundary::EdgeAndCorner, 0, s, t);
        assert!(!fixed.irregular);
        assert!((fixed.position - mesh.positions[corner]).length() < 1e-15);
    }
    let fixed = sample(&mesh, Boundary::EdgeAndCorner, 0, 0.0, 0.0);
    assert!((fixed.du - (mesh.positions[1] - mesh.positions[0])).length() < 1e-14);
}

#[test]
fn vertices_of_valence_two_have_a_position_and_the_mean_plane() {
    let mesh = cages::polygons();
    let limit = sample(&mesh, Boundary::EdgeOnly, 1, 0.0, 1.0);
    assert!(limit.irregular && limit.normal.is_normalized());
    let near = sample(&mesh, Boundary::EdgeOnly, 1, 1e-4, 1.0 - 1e-4);
    assert!((near.position - limit.position).length() < 1e-6);
    let flat = Mesh { positions: mesh.positions.iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect(), ..mesh.clone() };
    assert_eq!(sample(&flat, Boundary::EdgeOnly, 1, 0.0, 1.0).normal, DVec3::Z);
}

#[test]
fn centres_of_polygons_are_irregular_and_of_quads_are_not() {
    for (sides, irregular) in [(3, true), (5, true), (6, true)] {
        assert_eq!(sample(&cages::lone(sides), Boundary::EdgeOnly, 0, 1.0, 1.0).irregular, irregular);
    }
    assert!(!sample(&cages::lone(4), Boundary::EdgeOnly, 0, 0.5, 0.5).irregular);
    let folded = Mesh::from_faces(vec![DVec3::ZERO, DVec3::X, DVec3::X, DVec3::X], [[0, 1, 2, 3]]);
    assert_eq!(sample(&folded, Boundary::EdgeAndCorner, 0, 0.4, 0.4).normal, DVec3::ZERO);
}
