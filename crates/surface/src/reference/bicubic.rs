//! The uniform bicubic B-spline patch.

use std::array;

use glam::DVec3;

/// The 4 x 4 control points of a patch, `[y][x]`; the patch lies over the middle square, (s,t) =
/// (0,0) at `[1][1]`, s along x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid(pub(super) [[DVec3; 4]; 4]);

/// A point of a patch with its derivatives along s and t.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub(super) position: DVec3,
    pub(super) ds: DVec3,
    pub(super) dt: DVec3,
}

impl Grid {
    /// The patch at (s,t) in the unit square.
    pub(super) fn eval(&self, s: f64, t: f64) -> Jet {
        let combine = |x: [f64; 4], y: [f64; 4]| {
            let row = |row: &[DVec3; 4]| (0..4).map(|i| x[i] * row[i]).sum::<DVec3>();
            (0..4).map(|j| y[j] * row(&self.0[j])).sum::<DVec3>()
        };
        Jet {
            position: combine(basis(s), basis(t)),
            ds: combine(basis_derivative(s), basis(t)),
            dt: combine(basis(s), basis_derivative(t)),
        }
    }
}

/// The four uniform cubic B-splines that are not zero on the unit interval.
pub(super) fn basis(t: f64) -> [f64; 4] {
    let r = 1.0 - t;
    let near = |t: f64| (4.0 - 3.0 * t * t * (2.0 - t)) / 6.0;
    [r * r * r / 6.0, near(t), near(r), t * t * t / 6.0]
}

/// Their first derivatives: each is the difference of two neighbouring quadratic B-splines.
fn basis_derivative(t: f64) -> [f64; 4] {
    let r = 1.0 - t;
    let quadratic = [0.0, 0.5 * r * r, 0.5 + t * r, 0.5 * t * t, 0.0];
    array::from_fn(|i| quadratic[i] - quadratic[i + 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basis_reproduces_lines() {
        for t in [0.0, 0.1, 0.5, 0.77, 1.0] {
            let knots = [-1.0, 0.0, 1.0, 2.0];
            let weighted = |weights: [f64; 4]| weights.iter().zip(knots).map(|(w, x)| w * x).sum::<f64>();
            assert!((basis(t).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(basis_derivative(t).iter().sum::<f64>().abs() < 1e-15);
            assert!((weighted(basis(t)) - t).abs() < 1e-15);
            assert!((weighted(basis_derivative(t)) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn derivative_matches_differences() {
        let (t, h) = (0.3, 1e-5);
        for i in 0..4 {
            let difference = (basis(t + h)[i] - basis(t - h)[i]) / (2.0 * h);
            assert!((difference - basis_derivative(t)[i]).abs() < 1e-10);
        }
    }

    #[test]
    fn is_the_tensor_product() {
        let grid =
            Grid(array::from_fn(|y| array::from_fn(|x| DVec3::new(x as f64 - 1.0, y as f64 - 1.0, (x * y) as f64))));
        let jet = grid.eval(0.25, 0.75);
        assert!((jet.position - DVec3::new(0.25, 0.75, 1.25 * 1.75)).length() < 1e-15);
        assert!((jet.ds - DVec3::new(1.0, 0.0, 1.75)).length() < 1e-15);
        assert!((jet.dt - DVec3::new(0.0, 1.0, 1.25)).length() < 1e-15);
    }
}
