//! The outer points O: the eigenvectors that leave the ring at zero, and ring modes continued to the outer points.

use crate::matrix::Matrix;
use crate::net::NetKind;

use super::refine::{Fan, outer_coordinates};

/// Eigenvalues and values on O0, O1, O2 (seen from the side they lie around) of the block of one side.
const FULL_SIDE: [(f64, [f64; 3]); 3] =
    [(1.0 / 8.0, [1.0, 1.0, 1.0]), (1.0 / 16.0, [1.0, 0.0, -1.0]), (1.0 / 32.0, [1.0, -0.5, 1.0])];

/// The same on a sharp side, where O0 = 2 O1 - O2 is not a point of the net.
const SHARP_SIDE: [(f64, [f64; 3]); 2] = [(1.0 / 8.0, [1.0, 1.0, 1.0]), (1.0 / 16.0, [-1.0, 0.0, 1.0])];

/// Eigenvalue of O3 alone.
const FAR: f64 = 1.0 / 64.0;

/// Components this small next to vectors of size 1 are rounding errors.
const NEGLIGIBLE: f64 = 1e-10;

/// A set of outer points that, with the ring, refines into itself, and the eigenvectors of its block S12 of A.
pub(super) struct Outer {
    /// Net indices of ring and outer points, in net order.
    pub(super) points: Vec<usize>,
    /// Eigenvalues of the block.
    pub(super) lambdas: Vec<f64>,
    /// Its eigenvectors as columns, over the outer points.
    vectors: Matrix,
    inverse: Matrix,
    /// S11 of A: from ring to outer points.
    inflow: Matrix,
}

/// A ring mode over the outer points.
pub(super) struct Continued {
    /// Values of the mode on the outer points.
    pub(super) vector: Vec<f64>,
    /// If the block has the mode's eigenvalue and is excited by it: the eigenvector it excites and the factor, in
    /// `A (mode) = lambda (mode + factor * eigenvector)`.
    pub(super) receiver: Option<(Vec<f64>, f64)>,
}

impl Outer {
    /// All outer points of the net, given its step A.
    pub(super) fn of_net(kind: NetKind, step: &Matrix) -> Self {
        let coordinates = outer_coordinates(kind);
        let far = coordinates.iter().position(|&at| at == (2, 2)).expect("O3 is in every net");
        let ring = Fan::of(kind).size();
        let mut modes = [side_modes(kind, 0, &coordinates), side_modes(kind, 3, &coordinates)].concat();
        for (lambda, vector) in &mut modes {
            // O3 follows its neighbours: (A x) at O3 = lambda x at O3.
            let inflow: f64 = vector.iter().enumerate().map(|(i, x)| step.get(ring + far, ring + i) * x).sum();
            vector[far] = inflow / (*lambda - FAR);
        }
        let mut alone = vec![0.0; coordinates.len()];
        alone[far] = 1.0;
        modes.push((FAR, alone));
        let points = (0..kind.net_size()).collect();
        Self::new(step, ring, points, &modes)
    }

    /// The outer points around side 0 or 3 that leaves V: `O0 O1 O2` or `O4 O5 O6`, without the one beyond a boundary.
    pub(super) fn of_side(kind: NetKind, side: usize, step: &Matrix) -> Self {
        let coordinates = outer_coordinates(kind);
        let ring = Fan::of(kind).size();
        let kept: Vec<usize> =
            (0..coordinates.len()).filter(|&i| place_along(coordinates[i], side).is_some()).collect();
        let modes: Vec<_> = side_modes(kind, side, &coordinates)
            .into_iter()
            .map(|(lambda, vector)| (lambda, kept.iter().map(|&i| vector[i]).collect()))
            .collect();
        let points = (0..ring).chain(kept.iter().map(|i| ring + i)).collect();
        Self::new(step, ring, points, &modes)
    }

    fn new(step: &Matrix, ring: usize, points: Vec<usize>, modes: &[(f64, Vec<f64>)]) -> Self {
        let vectors = Matrix::from_fn(modes.len(), modes.len(), |r, c| modes[c].1[r]);
        let inverse = vectors.inverse().expect("the eigenvectors of the outer points are independent");
        let inflow = Matrix::from_fn(modes.len(), ring, |r, c| step.get(points[ring + r], c));
        Self { points, lambdas: modes.iter().map(|mode| mode.0).collect(), vectors, inverse, inflow }
    }

    /// Number of outer points.
    pub(super) fn len(&self) -> usize {
        self.lambdas.len()
    }

    /// Eigenvector i of the block.
    pub(super) fn vector(&self, i: usize) -> Vec<f64> {
        (0..self.len()).map(|r| self.vectors.get(r, i)).collect()
    }

    /// Continues a ring mode with eigenvalue `lambda` to the outer points: solves `(S12 - lambda) x = -S11 ring +
    /// lambda target` in the eigenvectors of S12, where `target` is the continuation of the mode that a chain vector
    /// excites, times the factor (zero for an eigenvector).
    ///
    /// Where S12 has the eigenvalue lambda too, that component is free and set to zero; if the right-hand side has the
    /// component, there is no eigenvector and the mode excites one of S12: that happens at valence 2 alone.
    pub(super) fn continued(&self, lambda: f64, ring: &[f64], target: &[f64]) -> Continued {
        let rhs: Vec<f64> = (0..self.len())
            .map(|r| lambda * target[r] - self.inflow.row(r).iter().zip(ring).map(|(s, y)| s * y).sum::<f64>())
            .collect();
        let (mut vector, mut excited) = (vec![0.0; self.len()], vec![0.0; self.len()]);
        for (i, &own) in self.lambdas.iter().enumerate() {
            let component: f64 = self.inverse.row(i).iter().zip(&rhs).map(|(w, x)| w * x).sum();
            let (into, weight) = if own == lambda {
                (&mut excited, -component / lambda)
            } else {
                (&mut vector, component / (own - lambda))
            };
            (0..self.len()).for_each(|r| into[r] += weight * self.vectors.get(r, i));
        }
        let factor = excited.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let receiver = (factor > NEGLIGIBLE).then(|| (excited.iter().map(|x| x / factor).collect(), factor));
        Continued { vector, receiver }
    }

    /// Which eigenvector of the block has the largest part in `vector`.
    pub(super) fn main_component(&self, vector: &[f64]) -> usize {
        let part = |i: usize| self.inverse.row(i).iter().zip(vector).map(|(w, x)| w * x).sum::<f64>().abs();
        (0..self.len()).max_by(|&a, &b| part(a).total_cmp(&part(b))).expect("there are outer points")
    }
}

/// Which of O0, O1, O2 seen from side 0 or 3 a point is.
fn place_along((x, y): (i32, i32), side: usize) -> Option<usize> {
    let (along, across) = if side == 0 { (x, y) } else { (y, x) };
    (along == 2 && across < 2).then_some((across + 1) as usize)
}

/// The eigenvectors that live around one side, over all outer points but O3, which is left at zero.
fn side_modes(kind: NetKind, side: usize, coordinates: &[(i32, i32)]) -> Vec<(f64, Vec<f64>)> {
    let modes: &[_] = if kind.side_is_sharp(side) { &SHARP_SIDE } else { &FULL_SIDE };
    let value = |values: &[f64; 3], at| place_along(at, side).map_or(0.0, |place| values[place]);
    modes.iter().map(|(lambda, values)| (*lambda, coordinates.iter().map(|&at| value(values, at)).collect())).collect()
}
