//! A sphere of meridians and parallels.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, dvec2};

use super::mesh::{Mesh, Uv, Welder};
use super::primitives::circle;

/// The unit sphere with `meridians` meridians and `bands` bands, triangles round the two poles; uv is longitude and
/// latitude with a seam on meridian 0.
pub(super) fn uv_sphere(meridians: usize, bands: usize) -> Mesh {
    let sphere = Sphere { meridians, bands };
    let (mut points, mut uv) = (Welder::new(), Welder::new());
    let (mut faces, mut uv_faces) = (Vec::new(), Vec::new());
    for (band, k) in (0..bands).flat_map(|band| (0..meridians).map(move |k| (band, k))) {
        let corners = sphere.corners(band, k);
        let vertex = |&(k, band): &(usize, usize)| points.index(sphere.vertex(k, band), || sphere.position(k, band));
        faces.push(corners.iter().map(vertex).collect());
        uv_faces.push(corners.iter().map(|&(k, band)| uv.index((k, band), || sphere.coordinate(k, band))).collect());
    }
    Mesh { uv: Some(Uv { points: uv.points, faces: uv_faces }), ..Mesh::new(points.points, faces) }
}

struct Sphere {
    meridians: usize,
    bands: usize,
}

impl Sphere {
    /// Corners (meridian, parallel) of a face, counter-clockwise seen from outside.
    fn corners(&self, band: usize, k: usize) -> Vec<(usize, usize)> {
        if band == 0 {
            vec![(k, 0), (k + 1, 1), (k, 1)]
        } else if band + 1 == self.bands {
            vec![(k, band), (k + 1, band), (k, band + 1)]
        } else {
            vec![(k, band), (k + 1, band), (k + 1, band + 1), (k, band + 1)]
        }
    }

    fn at_pole(&self, parallel: usize) -> bool {
        parallel.is_multiple_of(self.bands)
    }

    /// The one name of a vertex: a pole lies on every meridian, and the last meridian is the first.
    fn vertex(&self, k: usize, parallel: usize) -> (usize, usize) {
        if self.at_pole(parallel) { (0, parallel) } else { (k % self.meridians, parallel) }
    }

    fn position(&self, k: usize, parallel: usize) -> DVec3 {
        let (height, radius) = (PI * (parallel as f64 / self.bands as f64 - 0.5)).sin_cos();
        if self.at_pole(parallel) {
            DVec3::Y * height.signum()
        } else {
            circle(k, self.meridians, radius).with_y(height)
        }
    }

    /// Texture coordinate; a pole has one per triangle, above the middle of its side.
    fn coordinate(&self, k: usize, parallel: usize) -> DVec2 {
        let shift = if self.at_pole(parallel) { 0.5 } else { 0.0 };
        dvec2((k as f64 + shift) / self.meridians as f64, parallel as f64 / self.bands as f64)
    }
}
