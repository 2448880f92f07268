//! Evaluation of a triangular Gregory patch in f64: a quartic Bezier triangle with cubic sides and blended inner points.

use std::ops::{Add, Mul};

use glam::DVec3;

use crate::jet::Jet;

/// A number with its derivatives along two directions: first (u, v), second (uu, uv, vv).
#[derive(Clone, Copy, Debug)]
struct Dual {
    value: f64,
    first: [f64; 2],
    second: [f64; 3],
}

impl Dual {
    fn constant(value: f64) -> Self {
        Self { value, first: [0.0; 2], second: [0.0; 3] }
    }

    /// `self / (self + other)`; the mean 1/2, as if constant, where both are zero.
    fn share(self, other: Self) -> Self {
        let sum = self + other;
        if sum.value == 0.0 { Self::constant(0.5) } else { self * sum.reciprocal() }
    }

    fn product(self, other: Self) -> Self {
        let (a, b) = (self.first, other.first);
        let product = |i: usize, (j, k): (usize, usize)| {
            self.second[i] * other.value + a[j] * b[k] + a[k] * b[j] + self.value * other.second[i]
        };
        Self {
            value: self.value * other.value,
            first: std::array::from_fn(|i| a[i] * other.value + self.value * b[i]),
            second: [product(0, (0, 0)), product(1, (0, 1)), product(2, (1, 1))],
        }
    }

    fn reciprocal(self) -> Self {
        let r = 1.0 / self.value;
        let [u, v] = self.first;
        let second = |second: f64, product: f64| (2.0 * product * r - second) * r * r;
        let [uu, uv, vv] = self.second;
        Self {
            value: r,
            first: [u, v].map(|d| -d * r * r),
            second: [second(uu, u * u), second(uv, u * v), second(vv, v * v)],
        }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let first = std::array::from_fn(|i| self.first[i] + other.first[i]);
        Self {
            value: self.value + other.value,
            first,
            second: std::array::from_fn(|i| self.second[i] + other.second[i]),
        }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.product(other)
    }
}

/// Point and exact derivatives of the patch with points as [`triangle_points`](super::triangle_points) gives them, the
/// blends differentiated with the rest.
///
/// u and v are the barycentric coordinates of corners 1 and 2; that of corner 0 is the rest. At a corner with `f+ != f-` second
/// derivatives depend on the direction of approach; there the blends count as constant.
pub fn evaluate_triangle(points: &[DVec3; 15], u: f64, v: f64) -> Jet {
    jet(points, u, v, |share| share)
}

/// The same with the blends differentiated as if they were constant, as a renderer may do: exact on all three sides.
pub fn evaluate_triangle_frozen(points: &[DVec3; 15], u: f64, v: f64) -> Jet {
    jet(points, u, v, |share| Dual::constant(share.value))
}

fn jet(points: &[DVec3; 15], u: f64, v: f64, blend: impl Fn(Dual) -> Dual) -> Jet {
    let coordinate = |value, first| Dual { value, first, second: [0.0; 3] };
    let b = [coordinate(1.0 - u - v, [-1.0, -1.0]), coordinate(u, [1.0, 0.0]), coordinate(v, [0.0, 1.0])];
    let mut jet = Jet::default();
    for (weight, &point) in weights(b, blend).into_iter().zip(points) {
        jet.position += weight.value * point;
        jet.du += weight.first[0] * point;
        jet.dv += weight.first[1] * point;
        jet.duu += weight.second[0] * point;
        jet.duv += weight.second[1] * point;
        jet.dvv += weight.second[2] * point;
    }
    jet
}

/// Weights of the 15 points: for corner i with neighbours j (next) and k, `b_i^3` on p, `3 b_i^2 b_j (b_i + b_j)` on e+,
/// `3 b_i^2 b_k (b_i + b_k)` on e-, and `12 b_i^2 b_j b_k` on the blend of f+ and f- by b_j : b_k.
fn weights(b: [Dual; 3], blend: impl Fn(Dual) -> Dual) -> [Dual; 15] {
    let number = Dual::constant;
    let corner = |i: usize| {
        let (at, next, previous) = (b[i], b[(i + 1) % 3], b[(i + 2) % 3]);
        let edge = |to: Dual| number(3.0) * at * at * to * (at + to);
        let face = number(12.0) * at * at * next * previous;
        let (plus, minus) = (blend(next.share(previous)), blend(previous.share(next)));
        [at * at * at, edge(next), edge(previous), face * plus, face * minus]
    };
    let corners = [corner(0), corner(1), corner(2)];
    std::array::from_fn(|k| corners[k / 5][k % 5])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered() -> [DVec3; 15] {
        let mut state = 11_u32;
        let mut next = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        std::array::from_fn(|_| DVec3::new(next(), next(), next()))
    }

    #[test]
    fn weights_sum_to_one_everywhere() {
        for (u, v) in [(0.2, 0.3), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.4, 0.6), (0.7, 0.0)] {
            let ones = [DVec3::ONE; 15];
            for jet in [evaluate_triangle(&ones, u, v), evaluate_triangle_frozen(&ones, u, v)] {
                assert!((jet.position - DVec3::ONE).length() < 1e-15, "({u}, {v})");
                let derivatives = [jet.du, jet.dv, jet.duu, jet.duv, jet.dvv];
                assert!(derivatives.iter().all(|d| d.length() < 2e-14), "({u}, {v}): {derivatives:?}");
            }
        }
    }

    #[test]
    fn derivatives_match_differences() {
        let (points, h) = (scattered(), 1e-5);
        for (u, v) in [(0.3, 0.6), (0.9, 0.05), (0.05, 0.04), (0.0, 0.5), (0.6, 0.4), (0.2, 0.0)] {
            let at = |x: f64, y: f64| evaluate_triangle(&points, u + x * h, v + y * h);
            let jet = at(0.0, 0.0);
            let (along_u, along_v) = ([at(1.0, 0.0), at(-1.0, 0.0)], [at(0.0, 1.0), at(0.0, -1.0)]);
            let slope = |[a, b]: [Jet; 2], of: fn(Jet) -> DVec3| (of(a) - of(b)) / (2.0 * h);
            for (got, expected) in [
                (jet.du, slope(along_u, |j| j.position)),
                (jet.dv, slope(along_v, |j| j.position)),
                (jet.duu, slope(along_u, |j| j.du)),
                (jet.duv, slope(along_v, |j| j.du)),
                (jet.dvv, slope(along_v, |j| j.dv)),
            ] {
                assert!((got - expected).length() < 1e-5, "({u}, {v}): {got} against {expected}");
            }
        }
    }

    #[test]
    fn freezing_the_blends_is_exact_on_the_sides() {
        let points = scattered();
        for (u, v) in [(0.0, 0.3), (0.4, 0.6), (0.2, 0.0), (0.0, 0.0), (1.0, 0.0)] {
            let (exact, frozen) = (evaluate_triangle(&points, u, v), evaluate_triangle_frozen(&points, u, v));
            assert!((exact.du - frozen.du).length() < 1e-14 && (exact.dv - frozen.dv).length() < 1e-14, "({u}, {v})");
        }
    }

    #[test]
    fn sides_are_cubics() {
        let points = scattered();
        let side = [points[0], points[1], points[7], points[5]];
        for t in [0.0, 0.25, 0.5, 1.0] {
            let (on_side, _) = crate::bezier::curve(&side, t);
            assert!((evaluate_triangle(&points, t, 0.0).position - on_side).length() < 1e-15);
        }
    }
}
