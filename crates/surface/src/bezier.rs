//! Cubic Bernstein polynomials, Bezier curves and bicubic Bezier patches.

use glam::DVec3;

use crate::jet::Jet;

/// The four cubic Bernstein values at `t`.
pub fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// First derivatives of the four cubic Bernstein polynomials at `t`.
pub fn bernstein_first(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

/// Second derivatives of the four cubic Bernstein polynomials at `t`.
pub fn bernstein_second(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [6.0 * s, 6.0 * (t - 2.0 * s), 6.0 * (s - 2.0 * t), 6.0 * t]
}

/// Point and first derivative of a cubic Bezier curve.
pub fn curve(points: &[DVec3; 4], t: f64) -> (DVec3, DVec3) {
    let sum = |weights: [f64; 4]| weights.iter().zip(points).map(|(&w, &p)| w * p).sum();
    (sum(bernstein(t)), sum(bernstein_first(t)))
}

/// Point and derivatives of a bicubic Bezier patch; `points[i + 4 j]` with i along u.
pub fn patch(points: &[DVec3; 16], u: f64, v: f64) -> Jet {
    let along_u = [bernstein(u), bernstein_first(u), bernstein_second(u)];
    let along_v = [bernstein(v), bernstein_first(v), bernstein_second(v)];
    let sum = |du: usize, dv: usize| {
        points.iter().enumerate().map(|(k, &p)| along_u[du][k % 4] * along_v[dv][k / 4] * p).sum()
    };
    Jet { position: sum(0, 0), du: sum(1, 0), dv: sum(0, 1), duu: sum(2, 0), duv: sum(1, 1), dvv: sum(0, 2) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_match_differences_and_sum_to_zero() {
        let h = 1e-5;
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            assert!((bernstein(t).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            for k in 0..4 {
                let first = (bernstein(t + h)[k] - bernstein(t - h)[k]) / (2.0 * h);
                let second = (bernstein_first(t + h)[k] - bernstein_first(t - h)[k]) / (2.0 * h);
                assert!((first - bernstein_first(t)[k]).abs() < 1e-8);
                assert!((second - bernstein_second(t)[k]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn patch_of_a_plane_has_constant_derivatives() {
        let points = std::array::from_fn(|k| DVec3::new((k % 4) as f64 / 3.0, (k / 4) as f64 / 3.0, 2.0));
        let jet = patch(&points, 0.3, 0.8);
        assert!((jet.position - DVec3::new(0.3, 0.8, 2.0)).length() < 1e-15);
        assert!((jet.du - DVec3::X).length() < 1e-14 && (jet.dv - DVec3::Y).length() < 1e-14);
        assert!(jet.duu.length() < 1e-14 && jet.duv.length() < 1e-14 && jet.dvv.length() < 1e-14);
    }
}
