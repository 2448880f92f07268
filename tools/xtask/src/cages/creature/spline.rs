//! Natural cubic splines through tables of keys.

/// A table of keys: where, and the values there.
pub(super) type Keys<const N: usize> = [(f64, [f64; N])];

/// Values at `x` of the natural cubic splines through `keys`, which are in rising order.
pub(super) fn sample<const N: usize>(keys: &Keys<N>, x: f64) -> [f64; N] {
    std::array::from_fn(|value| {
        let knots: Vec<(f64, f64)> = keys.iter().map(|(at, values)| (*at, values[value])).collect();
        natural(&knots, x)
    })
}

fn natural(knots: &[(f64, f64)], x: f64) -> f64 {
    let curvature = curvatures(knots);
    let last = knots.len() - 2;
    let segment = knots[1..].iter().position(|knot| x <= knot.0).unwrap_or(last).min(last);
    let ((x0, y0), (x1, y1)) = (knots[segment], knots[segment + 1]);
    let h = x1 - x0;
    let (a, b) = ((x1 - x) / h, (x - x0) / h);
    let bend = (a * a * a - a) * curvature[segment] + (b * b * b - b) * curvature[segment + 1];
    a * y0 + b * y1 + bend * h * h / 6.0
}

/// Second derivatives at the knots: the tridiagonal system of the natural spline, solved by elimination.
fn curvatures(knots: &[(f64, f64)]) -> Vec<f64> {
    let count = knots.len();
    let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
    for k in 1..count - 1 {
        let (before, after) = (knots[k].0 - knots[k - 1].0, knots[k + 1].0 - knots[k].0);
        let slope = (knots[k + 1].1 - knots[k].1) / after - (knots[k].1 - knots[k - 1].1) / before;
        let pivot = 2.0 * (before + after) - before * upper[k - 1];
        upper[k] = after / pivot;
        right[k] = (6.0 * slope - before * right[k - 1]) / pivot;
    }
    for k in (1..count - 1).rev() {
        right[k] -= upper[k] * right[k + 1];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolates_and_keeps_lines() {
        let keys = [(0.0, [1.0, 2.0]), (1.0, [3.0, 2.5]), (4.0, [-1.0, 4.0]), (5.0, [0.0, 4.5])];
        for (at, values) in keys {
            let found = sample(&keys, at);
            assert!((0..2).all(|k| (found[k] - values[k]).abs() < 1e-12), "{found:?} at {at}");
        }
        assert!((sample(&keys, 2.5)[1] - 3.25).abs() < 1e-12);
    }

    #[test]
    fn has_a_smooth_derivative() {
        let keys = [(0.0, [1.0]), (1.0, [3.0]), (4.0, [-1.0]), (5.0, [0.0])];
        let (before, at, after) = (sample(&keys, 1.0 - 1e-4)[0], 3.0, sample(&keys, 1.0 + 1e-4)[0]);
        assert!((before + after - 2.0 * at).abs() < 1e-6);
    }
}
