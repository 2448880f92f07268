//! Records of sides: against the patches that share them, against each other, and at their ends.

use glam::DVec3;
use osculate_surface::stam::{Patch, Side};
use osculate_surface::{NetKind, bezier, gregory};

use crate::fixtures::{bumpy, crease, gap, interior, some_quads, stars};
use crate::star::Star;

/// Parameters along a side, down to 2^-20.
const PLACES: [f64; 9] = [1.0, 0.9, 0.6, 0.5, 0.3, 0.11, 0.04, 0.007, 1e-6];

/// The worst (position, relative derivative, normal) gap of a side's record to a patch that has it.
fn worst_against_patch(kind: NetKind, side: usize, net: &[DVec3]) -> [f64; 3] {
    let (edge, patch) = (Side::new(kind, side), Patch::new(kind));
    let (record, coefficients) = (edge.project(net), patch.project(net));
    PLACES.iter().fold([0.0; 3], |worst, &t| {
        let (u, v) = if side == 0 { (t, 0.0) } else { (0.0, t) };
        let (own, jet) = (edge.evaluate(&record, t), patch.evaluate(&coefficients, u, v));
        let (tangent, cross) = if side == 0 { (jet.du, jet.dv) } else { (jet.dv, -jet.du) };
        let size = tangent.length().max(cross.length());
        let derivative = (own.tangent - tangent).length().max((own.cross - cross).length()) / size;
        let normal = gap(edge.normal(&record, t), patch.normal(&coefficients, u, v).expect("there is a normal"));
        let gaps = [(own.position - jet.position).length(), derivative, normal];
        std::array::from_fn(|i| worst[i].max(gaps[i]))
    })
}

#[test]
fn sides_are_limits_of_their_patches() {
    for star_kind in stars() {
        let star = bumpy(star_kind, 6);
        for (i, kind) in some_quads(star_kind) {
            for side in [0, 3] {
                let [position, derivative, normal] = worst_against_patch(kind, side, &star.net(kind, i));
                let what = format!("{kind:?} side {side}: {position:.1e} {derivative:.1e} {normal:.1e}");
                assert!(position < 1e-14 && derivative < 5e-14 && normal < 1e-12, "{what}");
            }
        }
    }
}

/// The two quads of each inner edge of a star: on its left and on its right.
fn inner_edges(kind: NetKind) -> Vec<((i64, NetKind), (i64, NetKind))> {
    match kind {
        NetKind::Interior { .. } => vec![((0, kind), (-1, kind)), ((1, kind), (0, kind))],
        NetKind::Crease { faces, .. } => {
            (1..faces).map(|s| ((i64::from(s), crease(faces, s)), (i64::from(s) - 1, crease(faces, s - 1)))).collect()
        }
        NetKind::Regular => unreachable!("stars have a centre"),
    }
}

#[test]
fn both_patches_of_an_edge_have_the_same_record() {
    for star_kind in stars() {
        let star = bumpy(star_kind, 7);
        for ((i, left), (j, right)) in inner_edges(star_kind) {
            let (a, b) = (Side::new(left, 0), Side::new(right, 3));
            assert_eq!(a.eigenvalues().len(), b.eigenvalues().len());
            let (record_a, record_b) = (a.project(&star.net(left, i)), b.project(&star.net(right, j)));
            // Modes and their coefficients may differ by signs and, for equal eigenvalues, by order.
            for t in PLACES {
                let (p, q) = (a.evaluate(&record_a, t), b.evaluate(&record_b, t));
                let size = p.tangent.length().max(p.cross.length());
                assert!((p.position - q.position).length() < 1e-14, "{left:?} at {t}");
                assert!((p.tangent - q.tangent).length() < 5e-14 * size, "{left:?} at {t}");
                assert!((p.cross - q.cross).length() < 5e-14 * size, "{left:?} at {t}");
            }
        }
    }
}

#[test]
fn records_need_no_more_than_both_patches_have() {
    for star in stars() {
        for (_, kind) in some_quads(star) {
            for side in [0, 3] {
                let edge = Side::new(kind, side);
                let modes = edge.eigenvalues().len();
                let expected = match kind {
                    NetKind::Interior { valence } => 2 * valence as usize + 4,
                    NetKind::Crease { faces, .. } => 2 * faces as usize + 5 - usize::from(kind.side_is_sharp(side)),
                    NetKind::Regular => unreachable!("stars have a centre"),
                };
                assert_eq!((modes, edge.basis().cols()), (expected, expected), "{kind:?} side {side}");
                let used =
                    (0..kind.net_size()).filter(|&c| (0..modes).any(|r| edge.projection().get(r, c) != 0.0)).count();
                assert_eq!(used, expected, "{kind:?} side {side}");
                for mode in 0..modes {
                    let sum: f64 = edge.projection().row(mode).iter().sum();
                    assert!((sum - f64::from(u8::from(mode == 0))).abs() < 1e-12, "{kind:?}, mode {mode}: {sum:e}");
                }
                let constant = |r: usize| f64::from(u8::from(r < 4));
                assert!((0..8).all(|r| (edge.basis().get(r, 0) - constant(r)).abs() < 1e-13), "{kind:?}");
            }
        }
    }
}

#[test]
fn around_closed_rings_curve_and_cross_derivative_have_modes_of_their_own() {
    for n in (2..=12).chain([64]) {
        let edge = Side::new(interior(n), 0);
        let largest = |rows: std::ops::Range<usize>, mode: usize| {
            rows.fold(0.0_f64, |m, r| m.max(edge.basis().get(r, mode).abs()))
        };
        for mode in 0..edge.eigenvalues().len() {
            let (curve, across) = (largest(0..4, mode), largest(4..8, mode));
            assert!(curve.min(across) < 1e-14, "valence {n}, mode {mode}: {curve:e} {across:e}");
        }
    }
}

#[test]
fn sharp_sides_follow_one_cubic() {
    for faces in 1..=12 {
        for (quad, side) in [(0, 0), (faces - 1, 3)] {
            let kind = crease(faces, quad);
            let net = bumpy(kind, 8).net(kind, i64::from(quad));
            let edge = Side::new(kind, side);
            let record = edge.project(&net);
            let mut curve: [DVec3; 4] = gregory::edge(kind, side).apply(&net)[..4].try_into().expect("four points");
            if side == 3 {
                curve.reverse();
            }
            for t in PLACES {
                let gap = (edge.evaluate(&record, t).position - bezier::curve(&curve, t).0).length();
                assert!(gap < 1e-14, "{kind:?} at {t}: {gap:e}");
            }
        }
    }
}

#[test]
fn outer_sides_have_the_regular_record() {
    for star_kind in stars() {
        let star = bumpy(star_kind, 9);
        for (i, kind) in some_quads(star_kind) {
            let net = star.net(kind, i);
            let patch = Patch::new(kind);
            let coefficients = patch.project(&net);
            for side in [1, 2] {
                let record = gregory::edge(kind, side).apply(&net);
                let curve = record[..4].try_into().expect("four points");
                let across = record[4..].try_into().expect("four points");
                for t in [0.0, 0.2, 0.5, 0.7, 1.0] {
                    let (u, v) = if side == 1 { (1.0, t) } else { (1.0 - t, 1.0) };
                    let jet = patch.evaluate(&coefficients, u, v);
                    let (tangent, cross) = if side == 1 { (jet.dv, -jet.du) } else { (-jet.du, -jet.dv) };
                    let (p, d) = bezier::curve(&curve, t);
                    assert!((p - jet.position).length() < 1e-14, "{kind:?} side {side} at {t}");
                    assert!((d - tangent).length() < 1e-12, "{kind:?} side {side} at {t}");
                    let c = bezier::curve(&across, t).0;
                    assert!((c - cross).length() < 1e-12, "{kind:?} side {side} at {t}: {c} against {cross}");
                }
            }
        }
    }
}

/// Angle-like gap of the normal at `2^-depth` along side 0 of quad 0 to that of the vertex record.
fn gap_to_vertex(kind: NetKind, star: &Star, depth: i32) -> f64 {
    let net = star.net(kind, 0);
    let record = gregory::vertex(kind, 0).apply(&net);
    let edge = Side::new(kind, 0);
    gap(edge.normal(&edge.project(&net), 2.0_f64.powi(-depth)), record[1].cross(record[2]).normalize())
}

#[test]
fn normals_along_sides_converge_to_the_vertex_record() {
    for n in 3..=12 {
        let (kind, star) = (interior(n), bumpy(interior(n), 10));
        assert!(gap_to_vertex(kind, &star, 900) < 1e-12, "valence {n}: {:e}", gap_to_vertex(kind, &star, 900));
    }
    for k in 2..=12 {
        let (kind, star) = (crease(k, 0), bumpy(crease(k, 0), 10));
        assert!(gap_to_vertex(kind, &star, 900) < 1e-9, "{k} faces: {:e}", gap_to_vertex(kind, &star, 900));
    }
    // One face: like the inverse of the depth.
    let (kind, star) = (crease(1, 0), bumpy(crease(1, 0), 10));
    let (near, far) = (gap_to_vertex(kind, &star, 900), gap_to_vertex(kind, &star, 90));
    assert!(near < 0.15 * far && far < 0.1, "{near} {far}");
}

#[test]
#[should_panic(expected = "side 1 does not")]
fn outer_sides_are_refused() {
    Side::new(interior(5), 1);
}
