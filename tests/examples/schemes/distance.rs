//! How far the device's surface is from the limit surface in f64.

use glam::{DMat2, DVec2, DVec3};
use osculate::{BoundaryRule, Cage, SubFace, Surface, SurfacePoint};
use osculate_surface::reference::{Boundary, Mesh, Reference, Sample};

use crate::Spread;

/// Distances in half diagonals of the cage's box, means weighted by area.
pub(crate) struct Distances {
    /// To the point of the same face at the same parameters.
    pub(crate) same: Spread,
    /// To the nearest point of the same face: no less than the one-sided Hausdorff distance, which may leave the face.
    pub(crate) nearest: Spread,
}

/// Samples per side of a quad: about 40 000 in all, at least 8 and at most 24.
fn samples_per_side(faces: usize) -> u32 {
    (40_000.0 / faces as f64).sqrt().clamp(8.0, 24.0) as u32
}

/// Measures at the middles of a grid of cells over every face.
pub(crate) fn measure(surface: &Surface, cage: &Cage) -> Distances {
    let rule = cage.boundary_rule().unwrap_or(BoundaryRule::EdgeAndCorner);
    let mesh = Mesh::from(cage);
    let reference = Reference::new(&mesh, Boundary::from(rule)).unwrap_or_else(|error| panic!("{error}"));
    let points = points(surface, cage);
    let samples = surface.sample(&points).unwrap_or_else(|error| panic!("{error}"));
    let size = cage.bounds().half_diagonal();
    let mut found = Distances { same: Spread::default(), nearest: Spread::default() };
    for (point, sample) in points.iter().zip(samples) {
        let limit = Limit { reference: &reference, face: point.sub_face };
        let st = DVec2::new(point.s, point.t);
        let exact = limit.at(st);
        let area = exact.du.cross(exact.dv).length();
        found.same.add((sample.position - exact.position).length() / size, area);
        found.nearest.add(limit.distance(sample.position, st) / size, area);
    }
    found
}

fn points(surface: &Surface, cage: &Cage) -> Vec<SurfacePoint> {
    let n = samples_per_side(cage.face_count());
    let at = move |i: u32| (f64::from(i) + 0.5) / f64::from(n);
    (0..cage.face_count() as u32)
        .flat_map(|face| surface.plan().locator.sub_faces(face))
        .flat_map(|sub_face| (0..n * n).map(move |i| SurfacePoint { sub_face, s: at(i % n), t: at(i / n) }))
        .collect()
}

/// The limit surface of one face.
struct Limit<'a> {
    reference: &'a Reference<'a>,
    face: SubFace,
}

impl Limit<'_> {
    fn at(&self, st: DVec2) -> Sample {
        self.reference
            .eval(self.face.face as usize, self.face.sub, st.x, st.y)
            .unwrap_or_else(|error| panic!("{error}"))
    }

    /// Distance of `point` to the nearest point of the face, by Gauss and Newton's steps from `st`.
    fn distance(&self, point: DVec3, mut st: DVec2) -> f64 {
        const STEPS: usize = 5;
        let mut nearest = f64::INFINITY;
        for _ in 0..STEPS {
            let sample = self.at(st);
            let gap = point - sample.position;
            nearest = nearest.min(gap.length());
            let (du, dv) = (sample.du, sample.dv);
            let normal_matrix = DMat2::from_cols_array(&[du.dot(du), du.dot(dv), du.dot(dv), dv.dot(dv)]);
            let step = normal_matrix.inverse() * DVec2::new(du.dot(gap), dv.dot(gap));
            if !step.is_finite() {
                break;
            }
            st = (st + step).clamp(DVec2::ZERO, DVec2::ONE);
        }
        nearest
    }
}
