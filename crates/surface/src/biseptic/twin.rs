//! The shader stages of biseptic patches on the host, in f32 and in the shaders' order of operations.
//!
//! # Layout between the stages
//! A control stage writes at most 32 vertices, so each carries two of the 64 points (report, section 4.3): vertex w
//! holds points `2w` and `2w+1`, neighbours along u. Row j of the patch is vertices `4j..4j+4`.
//!
//! Points are relative to the net's vertex V, whose position goes along once per patch. Differences of nearby points
//! are exact or nearly so, whence derivatives and curvatures lose no bits where the model lies far from the origin, and
//! the rounded weights need not sum to 1: V itself is not weighed.

use glam::Vec3;

/// What the control stage hands to the evaluation stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoints {
    /// The net's vertex V.
    pub origin: Vec3,
    /// Points `2w` and `2w+1`, less `origin`.
    pub pairs: [[Vec3; 2]; 32],
}

impl ControlPoints {
    /// Point (i, j) of the patch less `origin`, i along u.
    fn point(&self, i: usize, j: usize) -> Vec3 {
        self.pairs[(i + 8 * j) / 2][i % 2]
    }
}

/// Position and derivatives of a patch at one (u, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// The point.
    pub position: Vec3,
    /// First derivative along u.
    pub du: Vec3,
    /// First derivative along v.
    pub dv: Vec3,
}

/// Second derivatives of a patch at one (u, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondDerivatives {
    /// Along u.
    pub duu: Vec3,
    /// Mixed.
    pub duv: Vec3,
    /// Along v.
    pub dvv: Vec3,
}

/// The control stage: 64 rows of weights ([`patch`](super::patch) rounded to f32, row after row) times a net, each
/// summed from the last point to the first.
///
/// # Panics
/// If there are not 64 weights per net point.
pub fn control_points(weights: &[f32], net: &[Vec3]) -> ControlPoints {
    assert_eq!(weights.len(), 64 * net.len(), "64 weights per net point");
    let origin = net[0];
    let row = |r: usize| {
        let mut sum = Vec3::ZERO;
        for i in (1..net.len()).rev() {
            sum += weights[r * net.len() + i] * (net[i] - origin);
        }
        sum
    };
    ControlPoints { origin, pairs: std::array::from_fn(|w| [row(2 * w), row(2 * w + 1)]) }
}

/// The evaluation stage inside a patch: rows along u first, then across them.
pub fn patch_point(patch: &ControlPoints, u: f32, v: f32) -> PatchPoint {
    let (values_u, slopes_u) = (bernstein7(u), bernstein6(u));
    let mut rows = [Vec3::ZERO; 8];
    let mut slopes = [Vec3::ZERO; 8];
    for j in 0..8 {
        let points: [Vec3; 8] = std::array::from_fn(|i| patch.point(i, j));
        rows[j] = combine(values_u, points);
        slopes[j] = combine(slopes_u, differences(points));
    }
    PatchPoint {
        position: patch.origin + combine(bernstein7(v), rows),
        du: 7.0 * combine(bernstein7(v), slopes),
        dv: 7.0 * combine(bernstein6(v), differences(rows)),
    }
}

/// The evaluation stage inside a patch, for curvatures.
pub fn second_derivatives(patch: &ControlPoints, u: f32, v: f32) -> SecondDerivatives {
    let (values_u, slopes_u, bends_u) = (bernstein7(u), bernstein6(u), bernstein5(u));
    let mut rows = [Vec3::ZERO; 8];
    let mut slopes = [Vec3::ZERO; 8];
    let mut bends = [Vec3::ZERO; 8];
    for j in 0..8 {
        let points: [Vec3; 8] = std::array::from_fn(|i| patch.point(i, j));
        rows[j] = combine(values_u, points);
        slopes[j] = combine(slopes_u, differences(points));
        bends[j] = combine(bends_u, second_differences(points));
    }
    SecondDerivatives {
        duu: 42.0 * combine(bernstein7(v), bends),
        duv: 49.0 * combine(bernstein6(v), differences(slopes)),
        dvv: 42.0 * combine(bernstein5(v), second_differences(rows)),
    }
}

/// The record of a spoke: 16 rows of weights ([`edge`](super::edge) rounded to f32) times a net, summed from the last
/// point to the first.
///
/// # Panics
/// If there are not 16 weights per net point.
pub fn edge_record(weights: &[f32], net: &[Vec3]) -> [Vec3; 16] {
    assert_eq!(weights.len(), 16 * net.len(), "16 weights per net point");
    std::array::from_fn(|r| {
        let mut sum = Vec3::ZERO;
        for i in (0..net.len()).rev() {
            sum += weights[r * net.len() + i] * net[i];
        }
        sum
    })
}

/// Position and unnormalised normal `C' x D` of a spoke's record at t: what every patch that has the spoke reads.
pub fn edge_point(record: &[Vec3; 16], t: f32) -> (Vec3, Vec3) {
    let curve: [Vec3; 8] = std::array::from_fn(|i| record[i]);
    let cross: [Vec3; 8] = std::array::from_fn(|i| record[8 + i]);
    let tangent = combine(bernstein6(t), differences(curve));
    let position = combine(bernstein7(t), curve);
    (position, cross_product(tangent, combine(bernstein7(t), cross)))
}

/// Bernstein polynomials of degree 7 at t.
fn bernstein7(t: f32) -> [f32; 8] {
    let s = 1.0 - t;
    let (t2, s2) = (t * t, s * s);
    let (t3, s3) = (t2 * t, s2 * s);
    let (t4, s4) = (t2 * t2, s2 * s2);
    [
        s4 * s3,
        7.0 * (t * (s3 * s3)),
        21.0 * (t2 * (s4 * s)),
        35.0 * (t3 * s4),
        35.0 * (t4 * s3),
        21.0 * ((t4 * t) * s2),
        7.0 * ((t3 * t3) * s),
        t4 * t3,
    ]
}

/// Bernstein polynomials of degree 6 at t.
fn bernstein6(t: f32) -> [f32; 7] {
    let s = 1.0 - t;
    let (t2, s2) = (t * t, s * s);
    let (t3, s3) = (t2 * t, s2 * s);
    let (t4, s4) = (t2 * t2, s2 * s2);
    [s3 * s3, 6.0 * (t * (s4 * s)), 15.0 * (t2 * s4), 20.0 * (t3 * s3), 15.0 * (t4 * s2), 6.0 * ((t4 * t) * s), t3 * t3]
}

/// Bernstein polynomials of degree 5 at t.
fn bernstein5(t: f32) -> [f32; 6] {
    let s = 1.0 - t;
    let (t2, s2) = (t * t, s * s);
    let (t3, s3) = (t2 * t, s2 * s);
    let (t4, s4) = (t2 * t2, s2 * s2);
    [s4 * s, 5.0 * (t * s4), 10.0 * (t2 * s3), 10.0 * (t3 * s2), 5.0 * (t4 * s), t4 * t]
}

/// Weighted sum in index order.
fn combine<const N: usize>(weights: [f32; N], points: [Vec3; N]) -> Vec3 {
    let mut sum = weights[0] * points[0];
    for i in 1..N {
        sum += weights[i] * points[i];
    }
    sum
}

fn differences(p: [Vec3; 8]) -> [Vec3; 7] {
    std::array::from_fn(|i| p[i + 1] - p[i])
}

fn second_differences(p: [Vec3; 8]) -> [Vec3; 6] {
    std::array::from_fn(|i| (p[i + 2] - p[i + 1]) - (p[i + 1] - p[i]))
}

/// The cross product written out, as in shaders/include/vector.glsl.
fn cross_product(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}
