//! Patches in f64 against the reference evaluator, and identities.

use glam::DVec3;
use osculate_surface::jet::Jet;
use osculate_surface::reference::{Boundary, Reference};
use osculate_surface::stam::Patch;
use osculate_surface::{NetKind, gregory};

use crate::fixtures::{bumpy, crease, gap, interior, mesh, parameters, some_quads, stars};

/// The worst position, derivative (relative) and normal of all samples of a star against the reference.
fn worst_against_reference(star_kind: NetKind, depth: i32) -> [f64; 3] {
    let star = bumpy(star_kind, 1);
    let mesh = mesh(star_kind, &star);
    let reference = Reference::new(&mesh, Boundary::EdgeOnly).expect("valid mesh");
    let mut worst = [0.0_f64; 3];
    for (i, kind) in some_quads(star_kind) {
        let patch = Patch::new(kind);
        let coefficients = patch.project(&star.net(kind, i));
        for (u, v) in parameters(depth, i as u32) {
            let expected = reference.eval(i as usize, -1, u, v).expect("sample");
            let jet = patch.evaluate(&coefficients, u, v);
            let size = expected.du.length().max(expected.dv.length());
            let derivative = (jet.du - expected.du).length().max((jet.dv - expected.dv).length()) / size;
            let normal = gap(patch.normal(&coefficients, u, v), expected.normal);
            let errors = [(jet.position - expected.position).length(), derivative, normal];
            worst = std::array::from_fn(|k| worst[k].max(errors[k]));
        }
    }
    worst
}

#[test]
fn patches_are_the_limit_surface() {
    for kind in stars() {
        let [position, derivative, normal] = worst_against_reference(kind, 12);
        println!("{kind:?}: position {position:.1e}, derivatives {derivative:.1e}, normal {normal:.1e}");
        assert!(position < 1e-14 && derivative < 5e-14, "{kind:?}: {position:e} {derivative:e}");
        // The reference pays for nearly parallel derivatives where one dominant mode is far above the rest.
        assert!(normal < 1e-12, "{kind:?}: {normal:e}");
    }
}

#[test]
fn normals_stay_precise_at_any_depth() {
    // Scaling the parameters by the period of the eigenvalue ratios must not change their quality: a net whose points
    // lie in a plane has one normal everywhere, however deep.
    for kind in stars() {
        let plane = DVec3::new(0.3, -0.4, 1.2).normalize();
        let lift = |p: DVec3| DVec3::new(p.x, p.y, -(plane.x * p.x + plane.y * p.y) / plane.z);
        let star = bumpy(kind, 3);
        for (i, kind) in some_quads(kind) {
            let net: Vec<DVec3> = star.net(kind, i).into_iter().map(lift).collect();
            let patch = Patch::new(kind);
            let coefficients = patch.project(&net);
            for depth in [1, 10, 100, 400] {
                let (u, v) = (0.8 * 2.0_f64.powi(-depth), 0.3 * 2.0_f64.powi(-depth));
                let normal = patch.normal(&coefficients, u, v).expect("there is a normal");
                let error = (normal - plane).length().min((normal + plane).length());
                assert!(error < 1e-10, "{kind:?} at 2^-{depth}: {error:e}");
            }
        }
    }
}

#[test]
fn functions_of_the_modes_sum_to_one_over_the_net() {
    for star in stars() {
        for (_, kind) in some_quads(star) {
            let patch = Patch::new(kind);
            let projection = patch.projection();
            for mode in 0..projection.rows() {
                let sum: f64 = projection.row(mode).iter().sum();
                assert!((sum - f64::from(u8::from(mode == 0))).abs() < 1e-12, "{kind:?}, mode {mode}: {sum:e}");
            }
            for basis in [0, 1, 2].map(|s| patch.basis(s)) {
                assert_eq!((basis.rows(), basis.cols()), (16, kind.net_size()));
                assert!((0..16).all(|r| (basis.get(r, 0) - 1.0).abs() < 1e-13), "{kind:?}");
            }
        }
    }
}

#[test]
fn second_derivatives_match_differences() {
    for kind in [interior(3), interior(7), crease(1, 0), crease(4, 1), crease(5, 4)] {
        let patch = Patch::new(kind);
        let coefficients = patch.project(&bumpy(kind, 2).net(kind, kind_quad(kind)));
        for (u, v) in [(0.8_f64, 0.3), (0.1, 0.06), (0.3, 0.9), (0.01, 0.011)] {
            let h = 1e-5 * u.max(v);
            let at = |x: f64, y: f64| patch.evaluate(&coefficients, u + x * h, v + y * h);
            let jet = at(0.0, 0.0);
            let along_u = |f: fn(&Jet) -> DVec3| (f(&at(1.0, 0.0)) - f(&at(-1.0, 0.0))) / (2.0 * h);
            let along_v = |f: fn(&Jet) -> DVec3| (f(&at(0.0, 1.0)) - f(&at(0.0, -1.0))) / (2.0 * h);
            let size = jet.duu.length() + jet.duv.length() + jet.dvv.length();
            for (got, expected) in [
                (jet.du, along_u(|j| j.position)),
                (jet.dv, along_v(|j| j.position)),
                (jet.duu, along_u(|j| j.du)),
                (jet.duv, along_u(|j| j.dv)),
                (jet.duv, along_v(|j| j.du)),
                (jet.dvv, along_v(|j| j.dv)),
            ] {
                assert!(
                    (got - expected).length() < 1e-7 * (1.0 + size),
                    "{kind:?} ({u},{v}): {got} against {expected}"
                );
            }
        }
    }
}

fn kind_quad(kind: NetKind) -> i64 {
    if let NetKind::Crease { quad, .. } = kind { i64::from(quad) } else { 0 }
}

#[test]
fn the_vertex_is_that_of_the_vertex_record() {
    for star in stars() {
        for (i, kind) in some_quads(star) {
            let patch = Patch::new(kind);
            let record = gregory::vertex(kind, 0);
            let gap =
                patch.projection().row(0).iter().zip(record.row(0)).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 1e-14, "{kind:?}: {gap:e}");
            let coefficients = patch.project(&bumpy(star, 4).net(kind, i));
            assert_eq!(patch.evaluate(&coefficients, 0.0, 0.0), Jet { position: coefficients[0], ..Jet::default() });
            assert_eq!(patch.normal(&coefficients, 0.0, 0.0), None);
        }
    }
}

#[test]
fn interior_normals_converge_to_the_vertex_record() {
    for n in 3..=20 {
        let kind = interior(n);
        let net = bumpy(kind, 5).net(kind, 0);
        let record = gregory::vertex(kind, 0).apply(&net);
        let expected = record[1].cross(record[2]).normalize();
        let patch = Patch::new(kind);
        let coefficients = patch.project(&net);
        let t = 2.0_f64.powi(-900);
        // Like (lambda_2 / lambda_1)^m: the higher the valence, the slower.
        let error = gap(patch.normal(&coefficients, 0.7 * t, 0.2 * t), expected);
        assert!(error < 1e-12, "valence {n}: {error:e}");
    }
}

#[test]
#[should_panic(expected = "needs no eigenbasis")]
fn regular_nets_have_no_eigenbasis() {
    Patch::new(NetKind::Regular);
}
