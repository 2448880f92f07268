//! How the parameters of two patches correspond along their spoke: the polynomials alpha, gamma, epsilon of the
//! [derivation](super#derivation).
//!
//! # Valence 3
//! With epsilon = 0, `(gamma / alpha)'` would have to vanish at 0, which no tau with a factor alpha achieves. Let
//! `a = -(1-u)^3 / alpha`, a linear factor `y = 1 + eta (u-1)`, `e = (kappa - eta) a / y` in place of epsilon / alpha,
//! and `P_v = y z` on the odd half. The condition `alpha P_vv = gamma P_v' + epsilon P_v` of that half becomes
//! `P_vv = a (y z' + kappa z)`. Locality asks for `z = O(u^4)`, and with the end data of the bicubic at u = 1
//! ```text
//! 6 z = u^4 (1 - (1 + eta) (u-1) + (1 + eta + eta^2) (u-1)^2)
//! ```
//! For degree 7 alpha must divide r and `(y z' + kappa z) / u^3`, and at V `e = a'`. These are five equations for the
//! two coefficients of alpha, tau, eta and kappa. Their root in [`CubeCorner`] was found by Newton's method;
//! multiplying by y makes all three polynomials.

use super::spoke::multiply;
use crate::angle::turn;

/// Polynomials of the parameter along a spoke, from V, as Bernstein coefficients: alpha and epsilon of degree m, gamma
/// of degree m+1.
pub(super) struct Correspondence {
    pub(super) alpha: Vec<f64>,
    pub(super) gamma: Vec<f64>,
    pub(super) epsilon: Vec<f64>,
}

/// `(1-u)^3` in Bernstein form.
const FADING_CUBE: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

impl Correspondence {
    /// The correspondence at a vertex of valence n.
    pub(super) fn of_valence(n: u32) -> Self {
        if n == 3 {
            return CubeCorner::ROOT.correspondence();
        }
        let [a, b, c] = quadratic_factor(cubic(tau(n)));
        let sum = a + b + c;
        let alpha = vec![a / sum, (a + b / 2.0) / sum, 1.0];
        let start = 2.0 * turn(1, i64::from(n)).0 * alpha[0];
        Self { gamma: FADING_CUBE.map(|x| start * x).to_vec(), epsilon: vec![0.0; 3], alpha }
    }
}

/// The free parameter of r, and what it is for: chosen, with [`first_derivative`], for the smallest range of mean
/// curvature over bowls and saddles. It moves weight between the middle of the patch and its corner at V.
fn tau(n: u32) -> f64 {
    match n {
        ..=6 => 0.0,
        7 | 8 => -0.25,
        9..=11 => 0.5,
        _ => 0.75,
    }
}

/// Length of the first derivative at V for the characteristic ring with E0 at distance 1, where it is set rather than
/// left to the energy, which would make it grow.
pub(super) fn first_derivative(n: u32) -> Option<f64> {
    match n {
        ..=8 => None,
        9 | 10 => Some(2.0),
        _ => Some(2.5),
    }
}

/// Power coefficients of `r = (2 u^2 - 5 u + 4) / 2 + tau (1-u)^2 (4 - 7 u)`.
fn cubic(tau: f64) -> [f64; 4] {
    [2.0 + 4.0 * tau, -2.5 - 15.0 * tau, 1.0 + 18.0 * tau, -7.0 * tau]
}

/// The quadratic factor of `r` without real zeros, as power coefficients up to a factor: r divided by its real zero.
///
/// The zero is beyond u = 1 for tau > 0 and below 0 for tau < 0. Newton's method started further out approaches it from
/// one side.
fn quadratic_factor([c0, c1, c2, c3]: [f64; 4]) -> [f64; 3] {
    if c3 == 0.0 {
        return [c0, c1, c2];
    }
    let mut zero = if c3 < 0.0 { 2.0 } else { -1.0 };
    for _ in 0..20 {
        let value = ((c3 * zero + c2) * zero + c1) * zero + c0;
        zero -= value / ((3.0 * c3 * zero + 2.0 * c2) * zero + c1);
    }
    let b = c3 * zero + c2;
    [b * zero + c1, b, c3]
}

/// The unknowns of valence 3: alpha = 1 + a1 u + a2 u^2 before multiplication by y.
struct CubeCorner {
    a1: f64,
    a2: f64,
    #[cfg_attr(not(test), expect(dead_code, reason = "the other unknowns are a root together with this one"))]
    tau: f64,
    eta: f64,
    kappa: f64,
}

impl CubeCorner {
    const ROOT: Self = Self {
        a1: -1.140_990_714_427_724_7,
        a2: 0.517_400_094_292_849_3,
        tau: 0.070_484_437_995_667_84,
        eta: -0.867_395_218_113_937_6,
        kappa: -4.338_900_268_421_011,
    };

    fn correspondence(&self) -> Correspondence {
        let alpha = [1.0, 1.0 + self.a1 / 2.0, 1.0 + self.a1 + self.a2];
        let y = [1.0 - self.eta, 1.0];
        let product = |f: &[f64]| multiply(f, &y.map(|c| [c])).into_iter().flatten().collect::<Vec<f64>>();
        Correspondence {
            alpha: product(&alpha),
            gamma: product(&FADING_CUBE.map(|x| -x)),
            epsilon: FADING_CUBE.map(|x| (self.eta - self.kappa) * x).to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn horner(power: &[f64], u: f64) -> f64 {
        power.iter().rev().fold(0.0, |sum, c| sum * u + c)
    }

    /// Remainder of `power` after division by `1 + a1 u + a2 u^2`.
    fn remainder(mut power: Vec<f64>, a1: f64, a2: f64) -> f64 {
        while power.len() > 2 {
            let lead = power.pop().expect("longer than 2") / a2;
            let top = power.len();
            power[top - 1] -= lead * a1;
            power[top - 2] -= lead;
        }
        power.iter().fold(0.0, |worst, c| worst.max(c.abs()))
    }

    fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                out[i + j] += x * y;
            }
        }
        out
    }

    #[test]
    fn cubic_meets_its_conditions() {
        for tau in [0.0, -0.25, 0.75] {
            let r = cubic(tau);
            let slope = [r[1], 2.0 * r[2], 3.0 * r[3]];
            let integral: f64 = (0..4).map(|k| r[k] / (k as f64 + 4.0)).sum();
            // P = integral of u^3 r: value 1/6, first derivative 1/2, second derivative 1 at u = 1.
            assert!((integral - 1.0 / 6.0).abs() < 1e-15 && (horner(&r, 1.0) - 0.5).abs() < 1e-14);
            assert!((3.0 * horner(&r, 1.0) + horner(&slope, 1.0) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn alpha_divides_the_cubic_and_is_positive() {
        for n in 4..=14 {
            let alpha = Correspondence::of_valence(n).alpha;
            let power = [alpha[0], 2.0 * (alpha[1] - alpha[0]), alpha[0] - 2.0 * alpha[1] + alpha[2]];
            let (a1, a2) = (power[1] / power[0], power[2] / power[0]);
            let gap = remainder(cubic(tau(n)).to_vec(), a1, a2);
            assert!(gap < 1e-13 && a1 * a1 < 4.0 * a2 && power[0] > 0.0, "valence {n}: {gap:e}");
        }
    }

    #[test]
    fn valence_three_meets_its_five_equations() {
        let CubeCorner { a1, a2, tau, eta, kappa } = CubeCorner::ROOT;
        let (y, l) = ([1.0 - eta, eta], [-1.0, 1.0]);
        let s = 1.0 + eta + eta * eta;
        let squares = times(&l, &l);
        let factor: Vec<f64> = (0..3)
            .map(|k| if k == 0 { 1.0 } else { 0.0 } - (1.0 + eta) * l.get(k).unwrap_or(&0.0) + s * squares[k])
            .collect();
        let z = times(&[0.0, 0.0, 0.0, 0.0, 1.0 / 6.0], &factor);
        let slope: Vec<f64> = z.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect();
        let second: Vec<f64> = times(&y, &slope).iter().zip(&z).map(|(a, b)| a + kappa * b).collect();
        assert!(second[..3].iter().all(|c| *c == 0.0));
        assert!(remainder(cubic(tau).to_vec(), a1, a2) < 1e-14);
        assert!(remainder(second[3..].to_vec(), a1, a2) < 1e-14);
        assert!((kappa - eta - (1.0 - eta) * (-3.0 - a1)).abs() < 1e-14);
        assert!(a1 * a1 < 4.0 * a2);
    }
}
