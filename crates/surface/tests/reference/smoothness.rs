//! Derivatives against differences, and continuity across the edges that faces share.

use glam::DVec3;
use osculate_surface::reference::{Boundary, Mesh, Reference, Sample};

use crate::cages;

/// A side of a sub-face in the parameters of that sub-face, walked from x = 0 at a vertex of the
/// cage to x = 1 at the next vertex.
struct Side {
    face: usize,
    corner: usize,
    sides: usize,
}

impl Side {
    /// The surface at fraction `x` of the side.
    fn at(&self, reference: &Reference<'_>, x: f64) -> Sample {
        let (sub, s, t) = if self.sides == 4 {
            let (s, t) = [(x, 0.0), (1.0, x), (1.0 - x, 1.0), (0.0, 1.0 - x)][self.corner];
            (-1, s, t)
        } else if x <= 0.5 {
            (self.corner as i32, 2.0 * x, 0.0)
        } else {
            (((self.corner + 1) % self.sides) as i32, 0.0, 2.0 - 2.0 * x)
        };
        reference.eval(self.face, sub, s, t).expect("a sample of the surface")
    }
}

/// The pairs of sides that run along one edge in opposite directions.
fn shared_sides(mesh: &Mesh) -> Vec<(Side, Side)> {
    let sides =
        |face: usize| (0..mesh.face(face).len()).map(move |corner| Side { face, corner, sides: mesh.face(face).len() });
    let ends = |side: &Side| (mesh.face(side.face)[side.corner], mesh.face(side.face)[(side.corner + 1) % side.sides]);
    let mut pairs = Vec::new();
    for a in (0..mesh.face_count()).flat_map(sides) {
        let (from, to) = ends(&a);
        let twin = (a.face + 1..mesh.face_count()).flat_map(sides).find(|b| ends(b) == (to, from));
        pairs.extend(twin.map(|b| (a, b)));
    }
    pairs
}

#[test]
fn shared_edges_have_one_position_and_one_normal() {
    for case in cages::all() {
        let reference = Reference::new(&case.mesh, case.rule).expect("the cage is valid");
        for (a, b) in shared_sides(&case.mesh) {
            // Places whose distance from both ends is exact.
            for x in [0.0, 2f64.powi(-30), 0.125, 0.25, 0.5, 0.6875, 0.9375, 1.0] {
                let (here, there) = (a.at(&reference, x), b.at(&reference, 1.0 - x));
                let place = format!("{}: faces {} and {}, at {x}", case.name, a.face, b.face);
                assert!((here.position - there.position).length() < 1e-14, "{place}");
                assert!(
                    (here.normal - there.normal).length() < 1e-8,
                    "{place}: {} against {}",
                    here.normal,
                    there.normal
                );
                assert!(here.normal.is_normalized() && there.normal.is_normalized(), "{place}: {}", here.normal);
            }
        }
    }
}

#[test]
fn derivatives_match_differences() {
    for case in cages::all() {
        let reference = Reference::new(&case.mesh, case.rule).expect("the cage is valid");
        for (face, ring) in case.mesh.faces().enumerate().take(10) {
            for sub in cages::sub_faces(ring.len()) {
                for (s, t) in [(0.37, 0.21), (0.8, 0.55), (0.1, 0.9), (0.03, 0.04)] {
                    let h = 1e-5;
                    let at = |s, t| reference.eval(face, sub, s, t).expect("a sample of the surface");
                    let across = |a: Sample, b: Sample| (b.position - a.position) / (2.0 * h);
                    let centre = at(s, t);
                    let place = format!("{}: face {face}, sub {sub}, ({s}, {t})", case.name);
                    for (derivative, difference) in [
                        (centre.du, across(at(s - h, t), at(s + h, t))),
                        (centre.dv, across(at(s, t - h), at(s, t + h))),
                    ] {
                        assert!(
                            (derivative - difference).length() < 1e-6,
                            "{place}: {derivative} against {difference}"
                        );
                    }
                    assert!(normal_error(&centre) < 1e-14, "{place}");
                }
            }
        }
    }
}

fn normal_error(sample: &Sample) -> f64 {
    (sample.normal - sample.du.cross(sample.dv).normalize_or_zero()).length()
}

#[test]
fn one_sided_derivatives_match_differences_on_boundaries() {
    let mesh = cages::grid(4, 3);
    for rule in [Boundary::EdgeAndCorner, Boundary::EdgeOnly] {
        let reference = Reference::new(&mesh, rule).expect("the cage is valid");
        let at = |s, t| reference.eval(1, -1, s, t).expect("a sample of the surface").position;
        let h = 1e-6;
        for s in [0.0, 0.25, 1.0] {
            let sample = reference.eval(1, -1, s, 0.0).expect("a sample of the surface");
            let inward = (4.0 * at(s, h) - 3.0 * at(s, 0.0) - at(s, 2.0 * h)) / (2.0 * h);
            assert!((sample.dv - inward).length() < 1e-8, "{} against {inward}", sample.dv);
        }
    }
}

#[test]
fn normals_of_a_closed_cage_point_outwards() {
    let mesh = cages::cube();
    let reference = Reference::new(&mesh, Boundary::default()).expect("the cage is valid");
    for face in 0..6 {
        for (s, t) in [(0.0, 0.0), (0.5, 0.5), (0.2, 0.9), (1.0, 0.0)] {
            let sample = reference.eval(face, -1, s, t).expect("a sample of the surface");
            assert!(sample.normal.dot(sample.position) > 0.0);
        }
    }
    let corner = reference.eval(1, -1, 1.0, 1.0).expect("the vertex at (1,1,1)");
    assert!((corner.normal - DVec3::ONE.normalize()).length() < 1e-15);
}
