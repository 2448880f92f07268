//! What is at a place of the picture: the point of the surface that a ray from the eye meets first, and the vertex of the cage next
//! to the pointer.

use glam::{DMat2, DVec2, DVec3, Vec3};
use osculate::{CageSpace, CapturedVertex, EngineError, Evaluator, Sample, Surface, SurfacePoint, Tessellation};
use rayon::prelude::*;

use crate::camera::Orbit;

/// Level of the triangles that rays are shot at; the exact point is found from there.
const LEVEL: f32 = 6.0;
/// Rounds of Newton's method; three give single precision.
const ROUNDS: usize = 4;
/// Distance of the points that curvatures are differences of, in (s,t).
const STEP: f64 = 1.0 / 256.0;

/// A question to a surface.
pub(crate) struct Pick {
    pub(crate) surface: Surface,
    /// Where the ray begins.
    pub(crate) eye: DVec3,
    /// Where it goes, of unit length.
    pub(crate) direction: DVec3,
}

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Picked {
    /// Number of the patch.
    pub(crate) patch: u32,
    /// Place on the cage.
    pub(crate) point: SurfacePoint,
    pub(crate) sample: Sample,
    /// Mean and Gaussian curvature; positive mean curvature bulges towards the normal.
    pub(crate) curvature: Option<[f64; 2]>,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hit {
    /// Length along the ray.
    distance: f32,
    patch: u32,
    uv: [f32; 2],
}

/// A ray in cage space.
#[derive(Clone, Copy)]
struct Ray {
    origin: Vec3,
    direction: Vec3,
}

impl Pick {
    /// Finds the point.
    pub(crate) fn run(&self) -> Result<Option<Picked>, EngineError> {
        let Some(hit) = self.nearest()? else { return Ok(None) };
        let place = self.surface.place(hit.patch, hit.uv.map(f64::from));
        let mut point =
            SurfacePoint { sub_face: place.sub_face, s: place.st[0].clamp(0.0, 1.0), t: place.st[1].clamp(0.0, 1.0) };
        let mut sample = self.sample(point)?;
        for _ in 0..ROUNDS {
            point = self.closer(point, &sample);
            sample = self.sample(point)?;
        }
        Ok(Some(Picked { patch: hit.patch, point, sample, curvature: self.curvature(point, &sample)? }))
    }

    fn sample(&self, point: SurfacePoint) -> Result<Sample, EngineError> {
        let samples = self.surface.sample(&[point])?;
        Ok(samples[0])
    }

    /// The first triangle that the ray meets.
    fn nearest(&self) -> Result<Option<Hit>, EngineError> {
        let space = self.surface.space();
        let ray = Ray { origin: space.enter(self.eye), direction: self.direction.as_vec3() };
        let tessellation = Tessellation { evaluator: Evaluator::Compute, ..Tessellation::uniform(LEVEL) };
        let mut nearest: Option<Hit> = None;
        self.surface.capture(&tessellation, |vertices| {
            let found = vertices.par_chunks_exact(3).filter_map(|corners| ray.meets(corners)).reduce_with(nearer);
            nearest = nearest.into_iter().chain(found).reduce(nearer);
            Ok::<(), EngineError>(())
        })?;
        Ok(nearest)
    }

    /// A step of Newton's method towards the ray, within the face.
    fn closer(&self, point: SurfacePoint, sample: &Sample) -> SurfacePoint {
        let across = self.direction.any_orthonormal_vector();
        let along = self.direction.cross(across);
        let flat = |v: DVec3| DVec2::new(v.dot(across), v.dot(along));
        let derivative = DMat2::from_cols(flat(sample.du), flat(sample.dv));
        let miss = flat(sample.position - self.eye);
        let step = derivative.inverse() * miss;
        if !step.is_finite() || step.length() > 0.5 {
            return point;
        }
        SurfacePoint { s: (point.s - step.x).clamp(0.0, 1.0), t: (point.t - step.y).clamp(0.0, 1.0), ..point }
    }

    /// Mean and Gaussian curvature by differences of normals; none where there is no tangent plane.
    fn curvature(&self, point: SurfacePoint, sample: &Sample) -> Result<Option<[f64; 2]>, EngineError> {
        // Inside the face on both sides of the middle, which may lie beside the point.
        let middle = [point.s, point.t].map(|x| x.clamp(STEP, 1.0 - STEP));
        let at = |ds: f64, dt: f64| SurfacePoint { s: middle[0] + ds, t: middle[1] + dt, ..point };
        let around = self.surface.sample(&[at(-STEP, 0.0), at(STEP, 0.0), at(0.0, -STEP), at(0.0, STEP)])?;
        if sample.normal == DVec3::ZERO || around.iter().any(|one| one.normal == DVec3::ZERO) {
            return Ok(None);
        }
        let difference = |a: &Sample, b: &Sample| (b.position - a.position, b.normal - a.normal);
        let forms = [difference(&around[0], &around[1]), difference(&around[2], &around[3])];
        Ok(curvatures(forms))
    }
}

/// Mean and Gaussian curvature from differences of position and normal in two directions (the shape operator, do Carmo,
/// *Differential Geometry of Curves and Surfaces*, section 3.3, with the opposite sign).
fn curvatures([(u, along_u), (v, along_v)]: [(DVec3, DVec3); 2]) -> Option<[f64; 2]> {
    let (e, f, g) = (u.dot(u), u.dot(v), v.dot(v));
    let (l, m, n) = (along_u.dot(u), (along_u.dot(v) + along_v.dot(u)) / 2.0, along_v.dot(v));
    let area = e * g - f * f;
    let result = [(e * n - 2.0 * f * m + g * l) / (2.0 * area), (l * n - m * m) / area];
    result.iter().all(|x| x.is_finite()).then_some(result)
}

fn nearer(a: Hit, b: Hit) -> Hit {
    if b.distance < a.distance { b } else { a }
}

impl Ray {
    /// Where it meets a triangle in front of the eye, from either side (Möller and Trumbore, *Fast, Minimum Storage Ray/Triangle
    /// Intersection*, 1997).
    fn meets(&self, corners: &[CapturedVertex]) -> Option<Hit> {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from(corners[i].position));
        let (ab, ac) = (b - a, c - a);
        let across = self.direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            return None;
        }
        let from_a = self.origin - a;
        let s = from_a.dot(across) / determinant;
        let beside = from_a.cross(ab);
        let t = self.direction.dot(beside) / determinant;
        let distance = ac.dot(beside) / determinant;
        // A little more than the triangle, lest a ray slip through between two.
        let slack = 1e-5;
        if s < -slack || t < -slack || s + t > 1.0 + slack || distance <= 0.0 {
            return None;
        }
        let uv = [0, 1].map(|i| {
            let at = |corner: usize| corners[corner].uv[i];
            at(0) + s * (at(1) - at(0)) + t * (at(2) - at(0))
        });
        Some(Hit { distance, patch: corners[0].patch, uv: uv.map(|x| x.clamp(0.0, 1.0)) })
    }
}

/// The vertex of the cage nearest to a place in a picture of that size, if one is within `reach` pixels: of several the one in front.
pub(crate) fn vertex_at(points: &[DVec3], orbit: &Orbit, place: DVec2, size: DVec2, reach: f64) -> Option<usize> {
    let near = |(vertex, &point): (usize, &DVec3)| {
        let (at, depth) = orbit.project(point, size)?;
        (at.distance(place) <= reach).then_some((vertex, depth))
    };
    points.iter().enumerate().filter_map(near).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(vertex, _)| vertex)
}

/// Lengths of the device's space in the cage's own.
pub(crate) fn length_in_cage_space(space: &CageSpace, length: f64) -> f32 {
    (length * space.scale) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(position: [f32; 3], uv: [f32; 2]) -> CapturedVertex {
        CapturedVertex { position, normal: [0.0; 3], uv, patch: 7 }
    }

    fn triangle() -> [CapturedVertex; 3] {
        [corner([0.0; 3], [0.0, 0.0]), corner([1.0, 0.0, 0.0], [1.0, 0.0]), corner([0.0, 1.0, 0.0], [0.0, 1.0])]
    }

    #[test]
    fn rays_meet_triangles_from_both_sides() {
        for z in [5.0, -5.0] {
            let ray = Ray { origin: Vec3::new(0.25, 0.5, z), direction: Vec3::new(0.0, 0.0, -z.signum()) };
            let hit = ray.meets(&triangle()).unwrap();
            assert_eq!((hit.patch, hit.uv, hit.distance), (7, [0.25, 0.5], 5.0));
        }
    }

    #[test]
    fn rays_miss_what_is_beside_behind_or_edge_on() {
        let ray = |origin: [f32; 3], direction: [f32; 3]| Ray { origin: origin.into(), direction: direction.into() };
        assert_eq!(ray([0.8, 0.8, 5.0], [0.0, 0.0, -1.0]).meets(&triangle()), None);
        assert_eq!(ray([0.2, 0.2, 5.0], [0.0, 0.0, 1.0]).meets(&triangle()), None);
        assert_eq!(ray([0.2, -5.0, 0.0], [0.0, 1.0, 0.0]).meets(&triangle()), None);
    }

    #[test]
    fn spheres_and_cylinders_have_their_curvatures() {
        // Differences on a sphere of radius 2: normals are positions over the radius.
        let (u, v) = (DVec3::new(0.1, 0.0, 0.0), DVec3::new(0.03, 0.2, 0.0));
        let [mean, gaussian] = curvatures([(u, u / 2.0), (v, v / 2.0)]).unwrap();
        assert!((mean - 0.5).abs() < 1e-12 && (gaussian - 0.25).abs() < 1e-12);
        // A cylinder of radius 4 along x.
        let bent = |d: DVec3| DVec3::new(0.0, d.y / 4.0, 0.0);
        let [mean, gaussian] = curvatures([(u, bent(u)), (v, bent(v))]).unwrap();
        assert!((mean - 0.125).abs() < 1e-12 && gaussian.abs() < 1e-12);
        assert_eq!(curvatures([(u, u), (u, u)]), None, "no tangent plane");
    }

    #[test]
    fn the_vertex_in_front_is_found() {
        let orbit = Orbit::looking(&"0,0,5:0,0,0:0,1,0:45".parse().unwrap());
        let size = DVec2::new(200.0, 100.0);
        let points = [DVec3::ZERO, DVec3::new(0.0, 0.0, 1.0), DVec3::X];
        assert_eq!(vertex_at(&points, &orbit, size / 2.0, size, 5.0), Some(1));
        assert_eq!(vertex_at(&points, &orbit, DVec2::ZERO, size, 5.0), None);
    }
}
