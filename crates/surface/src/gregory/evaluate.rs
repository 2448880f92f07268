//! Evaluation of a bicubic Gregory patch in f64.

use glam::DVec3;

use crate::bezier::{bernstein, bernstein_first, bernstein_second, patch};
use crate::jet::Jet;

/// Where the 20 points of the patch sit in the 4 x 4 Bezier grid `i + 4 j`, but for the four blended inner points.
const GRID: [Option<usize>; 16] = [
    Some(0),
    Some(1),
    Some(7),
    Some(5), //
    Some(2),
    None,
    None,
    Some(6), //
    Some(16),
    None,
    None,
    Some(12), //
    Some(15),
    Some(17),
    Some(11),
    Some(10),
];

/// Corner of each inner point of the Bezier grid, in grid order.
const INNER: [(usize, usize); 4] = [(5, 0), (6, 1), (10, 2), (9, 3)];

/// The bicubic Bezier points of the patch at (u, v): the inner four are blends `(a f+ + b f-) / (a + b)` of a corner's
/// face points, by the distances a and b to the sides that f- and f+ belong to.
///
/// At a corner the blend is undefined and multiplied by zero; the mean stands in for it.
pub fn bezier_grid(points: &[DVec3; 20], u: f64, v: f64) -> [DVec3; 16] {
    let mut grid = GRID.map(|k| k.map_or(DVec3::ZERO, |k| points[k]));
    for (at, corner) in INNER {
        let (a, b) = distances(corner, u, v);
        let weight = if a + b == 0.0 { 0.5 } else { a / (a + b) };
        let (plus, minus) = (points[5 * corner + 3], points[5 * corner + 4]);
        grid[at] = plus * weight + minus * (1.0 - weight);
    }
    grid
}

/// Blend numerators of f+ and f- of a corner: the distances to the side behind f- and to the side of f+.
fn distances(corner: usize, u: f64, v: f64) -> (f64, f64) {
    match corner {
        0 => (u, v),
        1 => (v, 1.0 - u),
        2 => (1.0 - u, 1.0 - v),
        _ => (1.0 - v, u),
    }
}

/// Derivatives of [`distances`] of each corner: (a, b) along u, (a, b) along v.
const DISTANCE_GRADIENTS: [[[f64; 2]; 2]; 4] =
    [[[1.0, 0.0], [0.0, 1.0]], [[0.0, -1.0], [1.0, 0.0]], [[-1.0, 0.0], [0.0, -1.0]], [[0.0, 1.0], [-1.0, 0.0]]];

/// Point and exact derivatives of the patch at (u, v), the blends differentiated with the rest.
///
/// A renderer may instead differentiate [`bezier_grid`] as if it were constant: that is exact on all edges. At a corner
/// with `f+ != f-` the mixed derivative depends on the direction of approach and its mean is returned.
pub fn evaluate(points: &[DVec3; 20], u: f64, v: f64) -> Jet {
    let mut jet = patch(&bezier_grid(points, u, v), u, v);
    let basis_u = [bernstein(u), bernstein_first(u), bernstein_second(u)];
    let basis_v = [bernstein(v), bernstein_first(v), bernstein_second(v)];
    for (at, corner) in INNER {
        let basis = |du: usize, dv: usize| basis_u[du][at % 4] * basis_v[dv][at / 4];
        let gap = points[5 * corner + 3] - points[5 * corner + 4];
        let [wu, wv, wuu, wuv, wvv] = blend_derivatives(corner, u, v);
        jet.du += gap * (basis(0, 0) * wu);
        jet.dv += gap * (basis(0, 0) * wv);
        jet.duu += gap * (2.0 * basis(1, 0) * wu + basis(0, 0) * wuu);
        jet.duv += gap * (basis(1, 0) * wv + basis(0, 1) * wu + basis(0, 0) * wuv);
        jet.dvv += gap * (2.0 * basis(0, 1) * wv + basis(0, 0) * wvv);
    }
    jet
}

/// Derivatives (u, v, uu, uv, vv) of the weight `a / (a + b)` of f+; zero at the corner itself.
fn blend_derivatives(corner: usize, u: f64, v: f64) -> [f64; 5] {
    let (a, b) = distances(corner, u, v);
    let sum = a + b;
    if sum == 0.0 {
        return [0.0; 5];
    }
    let [[au, bu], [av, bv]] = DISTANCE_GRADIENTS[corner];
    let first = |da: f64, db: f64| (b * da - a * db) / (sum * sum);
    let second =
        |da: f64, db: f64, ea: f64, eb: f64| (eb * da - ea * db) / (sum * sum) - 2.0 * first(da, db) * (ea + eb) / sum;
    [first(au, bu), first(av, bv), second(au, bu, au, bu), second(au, bu, av, bv), second(av, bv, av, bv)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered() -> [DVec3; 20] {
        let mut state = 7_u32;
        let mut next = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        std::array::from_fn(|_| DVec3::new(next(), next(), next()))
    }

    #[test]
    fn derivatives_match_differences() {
        let (points, h) = (scattered(), 1e-5);
        for (u, v) in [(0.3, 0.6), (0.9, 0.2), (0.05, 0.04), (0.0, 0.5), (1.0, 0.7), (0.8, 1.0)] {
            let at = |x: f64, y: f64| evaluate(&points, u + x * h, v + y * h);
            let jet = at(0.0, 0.0);
            let (u_gap, v_gap) = ((at(1.0, 0.0), at(-1.0, 0.0)), (at(0.0, 1.0), at(0.0, -1.0)));
            let slope = |(a, b): (Jet, Jet), of: fn(Jet) -> DVec3| (of(a) - of(b)) / (2.0 * h);
            for (got, expected) in [
                (jet.du, slope(u_gap, |j| j.position)),
                (jet.dv, slope(v_gap, |j| j.position)),
                (jet.duu, slope(u_gap, |j| j.du)),
                (jet.duv, slope(u_gap, |j| j.dv)),
                (jet.duv, slope(v_gap, |j| j.du)),
                (jet.dvv, slope(v_gap, |j| j.dv)),
            ] {
                assert!((got - expected).length() < 1e-6, "({u},{v}): {got} against {expected}");
            }
        }
    }

    #[test]
    fn freezing_the_blends_is_exact_on_the_sides() {
        let points = scattered();
        for (u, v) in [(0.0, 0.3), (1.0, 0.6), (0.2, 0.0), (0.7, 1.0)] {
            let (exact, frozen) = (evaluate(&points, u, v), patch(&bezier_grid(&points, u, v), u, v));
            assert!((exact.du - frozen.du).length() < 1e-15 && (exact.dv - frozen.dv).length() < 1e-15);
        }
    }

    #[test]
    fn corners_are_control_points_and_finite() {
        let points = scattered();
        for (corner, (u, v)) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].into_iter().enumerate() {
            let jet = evaluate(&points, u, v);
            assert_eq!(jet.position, points[5 * corner]);
            assert!([jet.du, jet.dv, jet.duu, jet.duv, jet.dvv].iter().all(|d| d.is_finite()));
        }
    }
}
