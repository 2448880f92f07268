//! The conditions of curvature continuity across a spoke, as weights on the coefficients of one patch.

use super::correspondence::Correspondence;
use super::{Coefficients, combine};

/// Conditions G0 to G2 of the [derivation](super#derivation) on the even and the odd half of a pair of patches: weights
/// on the coefficients of the patch left of the spoke, whose sums must vanish.
pub(super) struct SpokeConditions {
    pub(super) even: Vec<Coefficients>,
    pub(super) odd: Vec<Coefficients>,
}

impl SpokeConditions {
    pub(super) fn new(by: &Correspondence) -> Self {
        let unit = |i: usize, j: usize| -> Coefficients { std::array::from_fn(|k| f64::from(k == i + 8 * j)) };
        let rows = |weights: [f64; 3]| -> Vec<Coefficients> {
            let row = |i| combine([(weights[0], &unit(i, 0)), (weights[1], &unit(i, 1)), (weights[2], &unit(i, 2))]);
            (0..8).map(row).collect()
        };
        let (curve, cross, second) = (rows([1.0, 0.0, 0.0]), rows([-7.0, 7.0, 0.0]), rows([42.0, -84.0, 42.0]));
        let even = zip(&multiply(&by.alpha, &cross), &multiply(&by.gamma, &derivative(&curve)), |a, b| {
            combine([(2.0, a), (-1.0, b)])
        });
        let first_order = zip(&multiply(&by.gamma, &derivative(&cross)), &multiply(&by.epsilon, &cross), |a, b| {
            combine([(1.0, a), (1.0, b)])
        });
        let bend = zip(&multiply(&by.alpha, &second), &first_order, |a, b| combine([(1.0, a), (-1.0, b)]));
        Self { even, odd: [curve, bend].concat() }
    }
}

fn zip(
    a: &[Coefficients],
    b: &[Coefficients],
    with: impl Fn(&Coefficients, &Coefficients) -> Coefficients,
) -> Vec<Coefficients> {
    assert_eq!(a.len(), b.len(), "both sides of a condition have one degree");
    a.iter().zip(b).map(|(a, b)| with(a, b)).collect()
}

/// Bernstein coefficients of the derivative.
fn derivative(b: &[Coefficients]) -> Vec<Coefficients> {
    let degree = (b.len() - 1) as f64;
    b.windows(2).map(|pair| combine([(degree, &pair[1]), (-degree, &pair[0])])).collect()
}

/// Product of polynomials in Bernstein form, that of `g` having rows as coefficients:
/// `B(m,i) B(d,j) = C(m,i) C(d,j) / C(m+d,i+j) B(m+d,i+j)`.
pub(super) fn multiply<const N: usize>(f: &[f64], g: &[[f64; N]]) -> Vec<[f64; N]> {
    let (m, d) = (f.len() - 1, g.len() - 1);
    let mut out = vec![[0.0; N]; m + d + 1];
    for (i, x) in f.iter().enumerate() {
        for (j, row) in g.iter().enumerate() {
            let weight = x * binomial(m, i) * binomial(d, j) / binomial(m + d, i + j);
            for (o, y) in out[i + j].iter_mut().zip(row) {
                *o += weight * y;
            }
        }
    }
    out
}

/// The binomial coefficient, exact for the small arguments here.
pub(super) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |value, i| value * (n - i) as f64 / (i + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(bernstein: &[f64], u: f64) -> f64 {
        let d = bernstein.len() - 1;
        let term = |i: usize| binomial(d, i) * u.powi(i as i32) * (1.0 - u).powi((d - i) as i32);
        bernstein.iter().enumerate().map(|(i, b)| b * term(i)).sum()
    }

    #[test]
    fn products_multiply_values() {
        let (f, g) = ([1.0, -2.0, 0.5], [0.25, 3.0, -1.0, 2.0]);
        let product: Vec<f64> = multiply(&f, &g.map(|x| [x])).into_iter().flatten().collect();
        for u in [0.0, 0.3, 0.8, 1.0] {
            assert!((value(&product, u) - value(&f, u) * value(&g, u)).abs() < 1e-15);
        }
    }

    #[test]
    fn conditions_are_the_identities_of_the_derivation() {
        // Coefficients b(i,j) = i^2 - 3 i j + j^2 + 2, against derivatives of the rows.
        let b: Coefficients = std::array::from_fn(|k| {
            let (i, j) = ((k % 8) as f64, (k / 8) as f64);
            i * i - 3.0 * i * j + j * j + 2.0
        });
        let row = |weights: [f64; 3]| -> Vec<f64> {
            (0..8).map(|i| (0..3).map(|j| weights[j] * b[i + 8 * j]).sum()).collect()
        };
        let slope = |f: &[f64], u: f64| value(&f.windows(2).map(|p| 7.0 * (p[1] - p[0])).collect::<Vec<_>>(), u);
        let (curve, cross, second) = (row([1.0, 0.0, 0.0]), row([-7.0, 7.0, 0.0]), row([42.0, -84.0, 42.0]));
        for n in [3, 5, 9] {
            let by = Correspondence::of_valence(n);
            let conditions = SpokeConditions::new(&by);
            let dot = |w: &Coefficients| -> f64 { w.iter().zip(&b).map(|(x, y)| x * y).sum() };
            let even: Vec<f64> = conditions.even.iter().map(dot).collect();
            let odd: Vec<f64> = conditions.odd[8..].iter().map(dot).collect();
            for u in [0.0, 0.2, 0.7, 1.0] {
                let (alpha, gamma, epsilon) = (value(&by.alpha, u), value(&by.gamma, u), value(&by.epsilon, u));
                let first = 2.0 * alpha * value(&cross, u) - gamma * slope(&curve, u);
                let bend = alpha * value(&second, u) - gamma * slope(&cross, u) - epsilon * value(&cross, u);
                assert!((value(&even, u) - first).abs() < 1e-11, "valence {n}");
                assert!((value(&odd, u) - bend).abs() < 1e-11, "valence {n}");
            }
        }
    }
}
