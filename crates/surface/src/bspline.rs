//! The uniform cubic B-spline and its change of basis to Bezier form.

use glam::DVec3;

use crate::matrix::Matrix;

/// Row i gives Bezier point i of a segment as weights of its four B-spline points.
pub const TO_BEZIER: [[f64; 4]; 4] = [
    [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0],
    [0.0, 4.0 / 6.0, 2.0 / 6.0, 0.0],
    [0.0, 2.0 / 6.0, 4.0 / 6.0, 0.0],
    [0.0, 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0],
];

/// Values of the four basis functions of a segment at `t` in 0..=1.
pub fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ]
}

/// First derivatives of [`weights`].
pub fn derivative_weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-s * s / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, (4.0 * s - 3.0 * s * s) / 2.0, t * t / 2.0]
}

/// Bezier points of a curve segment from its four B-spline points.
pub fn curve_to_bezier(points: &[DVec3; 4]) -> [DVec3; 4] {
    TO_BEZIER.map(|row| row.iter().zip(points).map(|(&w, &p)| w * p).sum())
}

/// The 16 x 16 change of basis of a bicubic patch. Rows are Bezier points, index `i + 4 j` with i along u; columns are
/// B-spline points, index `(x+1) + 4 (y+1)`.
pub fn patch_to_bezier() -> Matrix {
    Matrix::from_fn(16, 16, |r, c| TO_BEZIER[r % 4][c % 4] * TO_BEZIER[r / 4][c / 4])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier;

    #[test]
    fn basis_is_a_partition_of_unity_with_matching_derivatives() {
        for i in 0..=16 {
            let t = f64::from(i) / 16.0;
            assert!((weights(t).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            let (a, b, d) = (weights(t - 1e-6), weights(t + 1e-6), derivative_weights(t));
            assert!((0..4).all(|i| ((b[i] - a[i]) / 2e-6 - d[i]).abs() < 1e-9));
        }
    }

    #[test]
    fn bezier_form_has_the_same_values() {
        let points = [DVec3::X, DVec3::new(2.0, -1.0, 0.5), DVec3::new(0.0, 3.0, 1.0), DVec3::NEG_ONE];
        let bezier_points = curve_to_bezier(&points);
        for i in 0..=8 {
            let t = f64::from(i) / 8.0;
            let direct: DVec3 = weights(t).iter().zip(&points).map(|(&w, &p)| w * p).sum();
            assert!((direct - bezier::curve(&bezier_points, t).0).length() < 1e-15);
        }
    }
}
