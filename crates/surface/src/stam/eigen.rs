//! The eigensystem of a net, and Bezier points of its functions at any level.

use glam::DVec3;

use crate::matrix::Matrix;
use crate::net::NetKind;

use super::outer::{Continued, Outer};
use super::refine::Fan;
use super::ring;

/// Index of the constant mode: eigenvalue 1.
pub(super) const CONSTANT: usize = 0;
/// Index of the dominant mode: of the largest eigenvalue below 1.
pub(super) const DOMINANT: usize = 1;
/// If two modes are coupled: index of the eigenvector that receives.
pub(super) const RECEIVER: usize = 2;
/// If two modes are coupled: index of the chain vector.
pub(super) const CHAIN: usize = 3;

/// `A V = V J` with J diagonal but for one entry: `A v3 = lambda3 (v3 + coupling v2)`.
#[derive(Clone, Debug)]
pub(super) struct Eigensystem {
    /// Eigenvalues: constant, dominant, the coupled two if there are, then the rest by falling magnitude.
    pub(super) lambdas: Vec<f64>,
    /// Factor by which mode [`CHAIN`] excites mode [`RECEIVER`] at each step; 0 if nothing is coupled.
    pub(super) coupling: f64,
    /// V: a column per mode, over `points`.
    pub(super) vectors: Matrix,
    /// V^-1: a row per mode, over all points of the net (zero where not in `points`).
    pub(super) projection: Matrix,
    /// The points of the net that the system is about.
    pub(super) points: Vec<usize>,
}

/// A mode over ring and outer points; `excites` is index and factor of the mode it is coupled to.
struct Mode {
    lambda: f64,
    vector: Vec<f64>,
    excites: Option<(usize, f64)>,
}

impl Eigensystem {
    /// The system of ring and outer points of a net. `axis`: see [`ring::modes`].
    pub(super) fn new(kind: NetKind, axis: i64, outer: Outer) -> Self {
        let mut modes: Vec<Mode> = Vec::new();
        let mut outer_modes: Vec<_> = (0..outer.len()).map(|i| (outer.lambdas[i], outer.vector(i))).collect();
        let ring = ring::modes(Fan::of(kind), axis);
        let ring_size = ring.len();
        for mode in ring {
            let target = mode.chain.map_or(vec![0.0; outer.len()], |(to, factor)| {
                modes[to].vector[ring_size..].iter().map(|x| factor * x).collect()
            });
            let Continued { vector, receiver } = outer.continued(mode.lambda, &mode.vector, &target);
            let excites = mode.chain.or_else(|| {
                let (vector, factor) = receiver?;
                let place = outer.main_component(&vector);
                outer_modes[place].1 = vector;
                Some((ring_size + place, factor))
            });
            modes.push(Mode { lambda: mode.lambda, vector: [mode.vector, vector].concat(), excites });
        }
        modes.extend(outer_modes.into_iter().map(|(lambda, vector)| Mode {
            lambda,
            vector: [vec![0.0; ring_size], vector].concat(),
            excites: None,
        }));
        Self::from_modes(kind, outer.points, &modes)
    }

    fn from_modes(kind: NetKind, points: Vec<usize>, modes: &[Mode]) -> Self {
        let order = order(modes);
        let vectors = Matrix::from_fn(points.len(), points.len(), |r, c| modes[order[c]].vector[r]);
        let inverse = vectors.inverse().expect("the modes are independent");
        let mut projection = Matrix::zeros(points.len(), kind.net_size());
        for (c, &point) in points.iter().enumerate() {
            (0..points.len()).for_each(|r| projection.set(r, point, inverse.get(r, c)));
        }
        let coupling = modes.iter().find_map(|mode| mode.excites).map_or(0.0, |(_, factor)| factor);
        Self { lambdas: order.iter().map(|&i| modes[i].lambda).collect(), coupling, vectors, projection, points }
    }

    /// The Bezier points of functions of the modes: `refined` gives B-spline points over the net, `to_bezier` changes
    /// their basis.
    pub(super) fn basis(&self, to_bezier: &Matrix, refined: &Matrix) -> Matrix {
        let over_points = Matrix::from_fn(refined.rows(), self.points.len(), |r, c| refined.get(r, self.points[c]));
        to_bezier.mul(&over_points).mul(&self.vectors)
    }

    /// Second largest eigenvalue in magnitude below 1: the scale of the remainder.
    pub(super) fn remainder_scale(&self) -> f64 {
        self.lambdas[DOMINANT + 1..].iter().fold(0.0, |m, lambda| lambda.abs().max(m))
    }

    /// The coefficients of the modes: `V^-1 (C - C_0)`, and C_0 added to that of the constant mode, which so is the
    /// limit position of V.
    ///
    /// Subtracting V first keeps the coefficients as precise as the differences of the points, however far the net is
    /// from the origin; all rows but the first sum to 0.
    pub(super) fn project(&self, net: &[DVec3]) -> Vec<DVec3> {
        let origin = net[0];
        let relative: Vec<DVec3> = net.iter().map(|&p| p - origin).collect();
        let mut coefficients = self.projection.apply(&relative);
        coefficients[CONSTANT] += origin;
        coefficients
    }

    /// The functions whose Bezier points are the rows of `basis`, after `steps` steps.
    pub(super) fn expand(&self, basis: &Matrix, coefficients: &[DVec3], steps: i32) -> Expansion {
        let scale = self.remainder_scale();
        let mut remainder = vec![DVec3::ZERO; basis.rows()];
        for mode in DOMINANT + 1..self.lambdas.len() {
            let chained = if mode == RECEIVER { self.coupling * f64::from(steps) } else { 0.0 };
            let coefficient = coefficients[mode] + chained * coefficients[CHAIN];
            let weighted = (self.lambdas[mode] / scale).powi(steps) * coefficient;
            remainder.iter_mut().enumerate().for_each(|(r, sum)| *sum += basis.get(r, mode) * weighted);
        }
        Expansion {
            limit: coefficients[CONSTANT],
            dominant: coefficients[DOMINANT],
            shape: (0..basis.rows()).map(|r| basis.get(r, DOMINANT)).collect(),
            remainder,
            dominant_scale: self.lambdas[DOMINANT].powi(steps),
            remainder_scale: scale.powi(steps),
            ratio: (scale / self.lambdas[DOMINANT]).powi(steps),
        }
    }
}

/// The modes in the order documented at [`Eigensystem::lambdas`].
fn order(modes: &[Mode]) -> Vec<usize> {
    let chain = modes.iter().position(|mode| mode.excites.is_some());
    let coupled: Vec<usize> =
        chain.map_or(vec![], |chain| vec![modes[chain].excites.map_or(0, |(receiver, _)| receiver), chain]);
    let mut rest: Vec<usize> = (1..modes.len()).filter(|i| !coupled.contains(i)).collect();
    // Stable: among equal eigenvalues the one built first stays first.
    rest.sort_by(|&a, &b| modes[b].lambda.abs().total_cmp(&modes[a].lambda.abs()));
    let dominant = rest.remove(0);
    [vec![CONSTANT, dominant], coupled, rest].concat()
}

/// The surface of one level, in Bezier points: `limit + lambda^m shape dominant + mu^m remainder`.
///
/// Lambda is the dominant eigenvalue, mu the next one. Keeping the dominant mode apart, with nothing scaled, lets
/// normals be computed at any depth.
pub(super) struct Expansion {
    /// Limit position of V.
    pub(super) limit: DVec3,
    /// The dominant mode's coefficient.
    pub(super) dominant: DVec3,
    /// Bezier values of the dominant mode's function.
    pub(super) shape: Vec<f64>,
    /// Bezier points of the other modes, each weighted by `(lambda_i / mu)^m`.
    pub(super) remainder: Vec<DVec3>,
    /// `lambda^m`.
    pub(super) dominant_scale: f64,
    /// `mu^m`.
    pub(super) remainder_scale: f64,
    /// `(mu / lambda)^m`.
    pub(super) ratio: f64,
}

/// A derivative split like an [`Expansion`]: the dominant mode's factor and the remainder.
pub(super) type Split = (f64, DVec3);

impl Expansion {
    /// The combination `sum weight_i point_i`, split.
    pub(super) fn combine(&self, weight: impl Fn(usize) -> f64) -> Split {
        let shape = self.shape.iter().enumerate().map(|(i, x)| weight(i) * x).sum();
        (shape, self.remainder.iter().enumerate().map(|(i, &p)| weight(i) * p).sum())
    }

    /// A split vector put together.
    pub(super) fn whole(&self, (shape, remainder): Split) -> DVec3 {
        self.dominant_scale * shape * self.dominant + self.remainder_scale * remainder
    }

    /// The direction of the cross product of two split derivatives a and b, over `(lambda mu)^m`:
    /// `p x (s_a R_b - s_b R_a) + (mu/lambda)^m R_a x R_b`. The product of the dominant mode with itself, which only
    /// rounding would leave, never appears.
    pub(super) fn cross(&self, a: Split, b: Split) -> DVec3 {
        self.dominant.cross(a.0 * b.1 - b.0 * a.1) + self.ratio * a.1.cross(b.1)
    }
}
