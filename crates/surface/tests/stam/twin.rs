//! The f32 twin against the f64 evaluation of the same (rounded) net.

#![expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what is under test")]

use glam::{DVec3, Vec3};
use osculate_surface::NetKind;
use osculate_surface::stam::twin::{patch_point, project, side_point};
use osculate_surface::stam::{Patch, Side, Table};

use crate::fixtures::{bumpy, gap, parameters, some_quads, stars};

/// A net of f32 points, moved by `offset`, and the same in f64.
fn nets(kind: NetKind, star_kind: NetKind, i: i64, offset: f64) -> (Vec<Vec3>, Vec<DVec3>) {
    let exact = bumpy(star_kind, 11).net(kind, i);
    let rounded: Vec<Vec3> = exact.into_iter().map(|p| (p + DVec3::splat(offset)).as_vec3()).collect();
    let back = rounded.iter().map(|p| p.as_dvec3()).collect();
    (rounded, back)
}

fn all_coefficients(table: &Table, net: &[Vec3]) -> Vec<Vec3> {
    (0..table.modes).map(|mode| project(table, net, mode)).collect()
}

/// The worst position and normal error of the patches of a star.
fn worst_of_patches(star_kind: NetKind, offset: f64, depths: impl Fn(u32) -> Vec<(f64, f64)>) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for (i, kind) in some_quads(star_kind) {
        let (net, exact_net) = nets(kind, star_kind, i, offset);
        let patch = Patch::new(kind);
        let table = patch.table();
        let (coefficients, exact) = (all_coefficients(&table, &net), patch.project(&exact_net));
        for (u, v) in depths(i as u32) {
            let point = patch_point(&table, &coefficients, u as f32, v as f32);
            let position = patch.evaluate(&exact, u, v).position;
            worst[0] = worst[0].max((point.position.as_dvec3() - position).length());
            worst[1] = worst[1].max(gap(patch.normal(&exact, u, v), point.normal.as_dvec3()));
        }
    }
    worst
}

/// Bounds of the error in the unit normal. The quads around a high valence are narrow: errors of f32, which are relative
/// to the coordinates (up to 3), are larger next to their width.
fn normal_bound(kind: NetKind) -> f64 {
    let around = match kind {
        NetKind::Regular => unreachable!("stars have a centre"),
        NetKind::Interior { valence } => valence,
        NetKind::Crease { faces, .. } => 2 * faces,
    };
    let width = std::f64::consts::TAU / f64::from(around);
    if around <= 24 { 3.5e-6 } else { 1e-5 + 4.0 * f64::from(f32::EPSILON) * 3.0 / width }
}

#[test]
fn patches_of_moderate_coordinates() {
    for kind in stars() {
        let [position, normal] = worst_of_patches(kind, 0.0, |seed| parameters(12, seed));
        println!("{kind:?}: position {position:.1e}, normal {normal:.1e}");
        assert!(position < 1e-6 && normal < normal_bound(kind), "{kind:?}: {position:e} {normal:e}");
    }
}

#[test]
fn patches_far_from_the_origin() {
    // Half an ulp of 100 is 3.8e-6; it is lost once in the limit position and once in the point, in three components.
    for kind in stars() {
        let [position, normal] = worst_of_patches(kind, 100.0, |seed| parameters(6, seed));
        assert!(position < 1.33e-5 && normal < normal_bound(kind), "{kind:?}: {position:e} {normal:e}");
    }
}

#[test]
fn patches_very_near_the_vertex() {
    for kind in stars() {
        for depth in [16, 24, 40, 100] {
            let at = |x: f64| f64::from((x * 2.0_f64.powi(-depth)) as f32);
            let places = |_| vec![(at(0.8), at(0.3)), (at(0.2), at(0.9)), (at(0.6), at(0.6)), (at(0.01), at(1.0))];
            let [position, normal] = worst_of_patches(kind, 0.0, places);
            println!("{kind:?} at 2^-{depth}: position {position:.1e}, normal {normal:.1e}");
            assert!(position < 1e-6 && normal < normal_bound(kind), "{kind:?} 2^-{depth}: {position:e} {normal:e}");
        }
    }
}

#[test]
fn sides() {
    for star_kind in stars() {
        let mut worst = [0.0_f64; 2];
        for (i, kind) in some_quads(star_kind) {
            let (net, exact_net) = nets(kind, star_kind, i, 0.0);
            for side in [0, 3] {
                let edge = Side::new(kind, side);
                let table = edge.table();
                let (record, exact) = (all_coefficients(&table, &net), edge.project(&exact_net));
                for t in parameters(24, i as u32).into_iter().map(|(u, _)| u).filter(|&t| t > 0.0) {
                    let point = side_point(&table, &record, t as f32);
                    let position = edge.evaluate(&exact, t).position;
                    worst[0] = worst[0].max((point.position.as_dvec3() - position).length());
                    worst[1] = worst[1].max(gap(edge.normal(&exact, t), point.normal.as_dvec3()));
                }
            }
        }
        println!("{star_kind:?}: position {:.1e}, normal {:.1e}", worst[0], worst[1]);
        assert!(worst[0] < 1e-6 && worst[1] < normal_bound(star_kind), "{star_kind:?}: {worst:?}");
    }
}

#[test]
fn the_vertex_itself_is_the_limit_position() {
    let kind = NetKind::Interior { valence: 5 };
    let (net, _) = nets(kind, kind, 0, 0.0);
    for (u, v) in [(0.0, 0.0), (1e-40, 0.0)] {
        let table = Patch::new(kind).table();
        let coefficients = all_coefficients(&table, &net);
        let point = patch_point(&table, &coefficients, u, v);
        assert_eq!((point.position, point.normal), (coefficients[0], Vec3::ZERO));
        let edge = Side::new(kind, 0).table();
        assert_eq!(side_point(&edge, &all_coefficients(&edge, &net), u).normal, Vec3::ZERO);
    }
}
