//! A dense row-major matrix of weights over the points of a net.

use glam::DVec3;

/// Row-major matrix of `f64` weights: row `r` gives an output as a combination of the points of a net.
///
/// Rows that give points sum to 1, rows that give vectors (tangents, cross derivatives) sum to 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    rows: usize,
    cols: usize,
    data: Vec<f64>,
}

impl Matrix {
    /// The matrix whose entry at row `r`, column `c` is `entry(r, c)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let data = (0..rows * cols).map(|i| entry(i / cols, i % cols)).collect();
        Self { rows, cols, data }
    }

    /// The `rows` by `cols` matrix of zeros.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Self { rows, cols, data: vec![0.0; rows * cols] }
    }

    /// Stacks rows of equal length.
    ///
    /// # Panics
    /// If the rows differ in length.
    pub fn from_rows<R: AsRef<[f64]>>(rows: &[R]) -> Self {
        let cols = rows.first().map_or(0, |r| r.as_ref().len());
        assert!(rows.iter().all(|r| r.as_ref().len() == cols), "rows of a matrix must have equal lengths");
        let data = rows.iter().flat_map(|r| r.as_ref()).copied().collect();
        Self { rows: rows.len(), cols, data }
    }

    /// Number of outputs.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of net points.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// The weight of net point `c` in output `r`.
    ///
    /// # Panics
    /// If `r` or `c` is out of range.
    pub fn get(&self, r: usize, c: usize) -> f64 {
        self.row(r)[c]
    }

    /// Replaces the weight of net point `c` in output `r`.
    ///
    /// # Panics
    /// If `r` or `c` is out of range.
    pub fn set(&mut self, r: usize, c: usize, weight: f64) {
        assert!(c < self.cols, "column {c} of a matrix with {} columns", self.cols);
        self.data[r * self.cols + c] = weight;
    }

    /// The weights of output `r`, one per net point.
    ///
    /// # Panics
    /// If `r` is out of range.
    pub fn row(&self, r: usize) -> &[f64] {
        &self.data[r * self.cols..(r + 1) * self.cols]
    }

    /// All weights, row after row.
    pub fn as_slice(&self) -> &[f64] {
        &self.data
    }

    /// The product `self * right`.
    ///
    /// # Panics
    /// If `self.cols() != right.rows()`.
    pub fn mul(&self, right: &Self) -> Self {
        assert_eq!(self.cols, right.rows, "inner dimensions of a matrix product");
        Self::from_fn(self.rows, right.cols, |r, c| {
            self.row(r).iter().enumerate().map(|(k, w)| w * right.data[k * right.cols + c]).sum()
        })
    }

    /// The outputs for one net, summed in net order.
    ///
    /// # Panics
    /// If `net.len() != self.cols()`.
    pub fn apply(&self, net: &[DVec3]) -> Vec<DVec3> {
        assert_eq!(net.len(), self.cols, "points of the net against columns of the matrix");
        (0..self.rows).map(|r| self.row(r).iter().zip(net).map(|(&w, &p)| w * p).sum()).collect()
    }

    /// The inverse of a square matrix, by Gauss-Jordan elimination with row pivoting, or `None` if it has none.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn inverse(&self) -> Option<Self> {
        assert_eq!(self.rows, self.cols, "only square matrices have inverses");
        let n = self.rows;
        let mut work =
            Self::from_fn(n, 2 * n, |r, c| if c < n { self.get(r, c) } else { f64::from(u8::from(c - n == r)) });
        for step in 0..n {
            let pivot_row = (step..n).max_by(|&a, &b| work.get(a, step).abs().total_cmp(&work.get(b, step).abs()))?;
            let pivot = work.get(pivot_row, step);
            if !pivot.is_finite() || pivot == 0.0 {
                return None;
            }
            work.swap_rows(step, pivot_row);
            // Columns before `step` are those of the unit matrix already.
            let source: Vec<f64> = work.row(step)[step..].iter().map(|w| w / pivot).collect();
            for r in 0..n {
                let factor = work.get(r, step);
                let target = &mut work.data[r * 2 * n + step..(r + 1) * 2 * n];
                if r == step {
                    target.copy_from_slice(&source);
                } else if factor != 0.0 {
                    target.iter_mut().zip(&source).for_each(|(t, s)| *t -= factor * s);
                }
            }
        }
        Some(Self::from_fn(n, n, |r, c| work.get(r, n + c)))
    }

    fn swap_rows(&mut self, a: usize, b: usize) {
        for c in 0..self.cols {
            self.data.swap(a * self.cols + c, b * self.cols + c);
        }
    }

    /// All weights rounded to `f32`, row after row: what a storage buffer holds.
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
    pub fn to_f32(&self) -> Vec<f32> {
        self.data.iter().map(|&w| w as f32).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_applies_right_then_left() {
        let a = Matrix::from_fn(2, 3, |r, c| (r * 3 + c) as f64);
        let b = Matrix::from_fn(3, 2, |r, c| 1.0 + (r * 2 + c) as f64);
        let net = [DVec3::new(1.0, -2.0, 0.5), DVec3::new(4.0, 0.0, 3.0)];
        assert_eq!(a.mul(&b).apply(&net), a.apply(&b.apply(&net)));
    }

    #[test]
    fn inverse_undoes_and_singular_matrices_have_none() {
        // A zero first pivot, and entries of very different size.
        let a = Matrix::from_rows(&[[0.0, 2.0, 1.0], [1e-8, 1.0, 3.0], [4.0, -1.0, 1e3]]);
        let unit = a.mul(&a.inverse().expect("regular matrix"));
        for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
            assert!((unit.get(r, c) - f64::from(u8::from(r == c))).abs() < 1e-12, "{unit:?}");
        }
        assert_eq!(Matrix::from_rows(&[[1.0, 2.0], [2.0, 4.0]]).inverse(), None);
        assert_eq!(Matrix::from_rows(&[[f64::NAN]]).inverse(), None);
    }

    #[test]
    #[should_panic(expected = "equal lengths")]
    fn ragged_rows_are_refused() {
        Matrix::from_rows(&[vec![1.0], vec![1.0, 2.0]]);
    }

    #[test]
    fn rows_and_f32_follow_row_major_order() {
        let mut m = Matrix::zeros(2, 2);
        m.set(1, 0, 0.5);
        assert_eq!((m.get(1, 0), m.row(1)), (0.5, [0.5, 0.0].as_slice()));
        assert_eq!(m.to_f32(), [0.0, 0.0, 0.5, 0.0]);
        assert_eq!(Matrix::from_rows(&[m.row(0), m.row(1)]), m);
    }
}
