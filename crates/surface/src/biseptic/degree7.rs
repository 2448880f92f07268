//! Evaluation of Bezier curves and patches of degree 7 in f64.

use glam::DVec3;

use crate::jet::Jet;

/// The N Bernstein values of degree N - 1 at `t`, by their recurrence.
fn bernstein<const N: usize>(t: f64) -> [f64; N] {
    let mut values = [0.0; N];
    values[0] = 1.0;
    for degree in 1..N {
        for i in (0..=degree).rev() {
            let below = if i > 0 { values[i - 1] } else { 0.0 };
            values[i] = (1.0 - t) * values[i] + t * below;
        }
    }
    values
}

/// Values, first and second derivatives of the eight Bernstein polynomials of degree 7 at `t`.
fn basis(t: f64) -> [[f64; 8]; 3] {
    let (sixth, fifth) = (bernstein::<7>(t), bernstein::<6>(t));
    // Entry i of the basis of lower degree, zero beyond its ends.
    fn at(values: &[f64], i: usize, back: usize) -> f64 {
        i.checked_sub(back).and_then(|i| values.get(i)).copied().unwrap_or(0.0)
    }
    [
        bernstein(t),
        std::array::from_fn(|i| 7.0 * (at(&sixth, i, 1) - at(&sixth, i, 0))),
        std::array::from_fn(|i| 42.0 * (at(&fifth, i, 2) - 2.0 * at(&fifth, i, 1) + at(&fifth, i, 0))),
    ]
}

/// Point and first derivative of a Bezier curve of degree 7.
pub fn curve(points: &[DVec3; 8], t: f64) -> (DVec3, DVec3) {
    let [values, first, _] = basis(t);
    let sum = |weights: [f64; 8]| weights.iter().zip(points).map(|(&w, &p)| w * p).sum();
    (sum(values), sum(first))
}

/// Point and derivatives of a Bezier patch of bidegree 7; `points[i + 8 j]` with i along u.
pub fn evaluate(points: &[DVec3; 64], u: f64, v: f64) -> Jet {
    let (along_u, along_v) = (basis(u), basis(v));
    let sum = |du: usize, dv: usize| {
        points.iter().enumerate().map(|(k, &p)| along_u[du][k % 8] * along_v[dv][k / 8] * p).sum()
    };
    Jet { position: sum(0, 0), du: sum(1, 0), dv: sum(0, 1), duu: sum(2, 0), duv: sum(1, 1), dvv: sum(0, 2) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basis_sums_to_one_and_derivatives_match_differences() {
        let h = 1e-5;
        for step in 0..=10 {
            let t = f64::from(step) / 10.0;
            let [values, first, second] = basis(t);
            let (before, after) = (basis(t - h), basis(t + h));
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            for i in 0..8 {
                assert!(((after[0][i] - before[0][i]) / (2.0 * h) - first[i]).abs() < 1e-7);
                assert!(((after[1][i] - before[1][i]) / (2.0 * h) - second[i]).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn monomials_come_out() {
        // u^2 v: Bezier coefficients C(i,2)/C(7,2) and j/7.
        let points = std::array::from_fn(|k| {
            let (i, j) = ((k % 8) as f64, (k / 8) as f64);
            DVec3::new(i / 7.0, j / 7.0, i * (i - 1.0) / 42.0 * j / 7.0)
        });
        let (u, v) = (0.3, 0.8);
        let jet = evaluate(&points, u, v);
        assert!((jet.position - DVec3::new(u, v, u * u * v)).length() < 1e-15);
        assert!((jet.du - DVec3::new(1.0, 0.0, 2.0 * u * v)).length() < 1e-14);
        assert!((jet.dv - DVec3::new(0.0, 1.0, u * u)).length() < 1e-14);
        assert!((jet.duu - 2.0 * v * DVec3::Z).length() < 1e-13);
        assert!((jet.duv - 2.0 * u * DVec3::Z).length() < 1e-13 && jet.dvv.length() < 1e-13);
    }
}
