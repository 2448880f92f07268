//! Limit position and tangent plane of a Catmull-Clark vertex as weights over its one-ring.
//!
//! Interior: Halstead, Kass and DeRose, *Efficient, Fair Interpolation using Catmull-Clark Surfaces* (1993), section 3
//! and appendix A; the scale of the tangents is that of the edge points in Loop, Schaefer, Ni and Castano,
//! *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation* (2009), section 3.
//! Boundary: left eigenvectors of the standard rules, 1:6:1 along the boundary and the smooth rule for the edges that
//! end on it. This differs from Loop 2009 section 5, whose cross tangent belongs to modified edge rules and is 3 to 10
//! degrees off for 3 to 12 faces.

use crate::angle::turn;
use crate::matrix::Matrix;

/// What the cosine of half the angle between neighbouring edges decides: with `h = cos(pi/n)` the subdominant eigenvalue
/// is `lambda = (2 + h^2 + h root) / 8`, `root = sqrt(4 + h^2)`. Written this way nothing cancels, at any valence.
struct Subdominant {
    h: f64,
    root: f64,
}

impl Subdominant {
    /// For a smooth vertex of valence n.
    fn of_valence(n: i64) -> Self {
        let h = turn(1, 2 * n).0;
        Self { h, root: (4.0 + h * h).sqrt() }
    }

    fn lambda(&self) -> f64 {
        (2.0 + self.h * self.h + self.h * self.root) / 8.0
    }

    /// Weight of an edge neighbour in the tangent at angle 0: `2 lambda q` of Loop 2009 with midpoints and centroids
    /// written out. A face neighbour weighs [`Self::face_to_edge`] times this.
    fn edge_weight(&self, n: i64) -> f64 {
        2.0 * self.lambda() * (1.0 + self.h / self.root) / n as f64
    }

    fn face_to_edge(&self) -> f64 {
        (self.root - self.h) / 4.0
    }
}

/// Limit position and two tangents of an interior vertex of valence n, over V, E0, F0, .., E(n-1), F(n-1): 3 x (2n+1).
///
/// Row 1 is the tangent along V-E0, row 2 the one a right angle further in the characteristic map; their cross product
/// is the outward normal. The scale is three times the edge vectors of the Gregory patch: at n = 4 the derivatives of
/// the bicubic along V-E0 and V-E1.
///
/// At n = 2 the limit surface has no tangent plane in general (eigenvalues 1/4, 1/4, -1/4). The rows then are parallel
/// to E0-E1 and F0-F1, the symmetric choice, and the plane that the Gregory patches share near V.
///
/// # Panics
/// If `valence < 2`.
pub fn interior(valence: u32) -> Matrix {
    assert!(valence >= 2, "an interior vertex has at least two edges, not {valence}");
    let n = i64::from(valence);
    let sub = Subdominant::of_valence(n);
    let (edge, square) = (sub.edge_weight(n), (n * n) as f64);
    let face = edge * sub.face_to_edge();
    let total = square + 5.0 * n as f64;
    Matrix::from_fn(3, 2 * valence as usize + 1, |row, col| {
        let half_steps = col as i64 - 1; // E_i at angle i, F_i at angle i + 1/2, in steps of 2 pi / n
        let (cos, sin) = turn(half_steps, 2 * n);
        let is_face = half_steps % 2 == 1;
        match (row, col) {
            (0, 0) => square / total,
            (_, 0) => 0.0,
            (0, _) => (if is_face { 1.0 } else { 4.0 }) / total,
            (1, _) => cos * (if is_face { face } else { edge }),
            _ => sin * (if is_face { face } else { edge }),
        }
    })
}

/// Limit position and two tangents of a vertex with `faces` faces on one side of a boundary or crease that follows the
/// 1:6:1 rule, over V, E0, F0, .., F(k-1), Ek: 3 x (2k+2). Row 1 x row 2 is the outward normal.
///
/// Row 1 is the derivative `(E0-Ek)/2` of the boundary curve towards E0. Row 2 for k >= 2 is the left eigenvector of
/// the dominant odd mode, `sin(i pi/k)` on the edges: the sector is half a smooth ring of valence 2k under odd
/// reflection, and the scale is that of [`interior`]`(2k)`, so that k = 2 gives the derivative of the bicubic with
/// reflected points beyond the boundary.
///
/// At k = 1 both derivatives of the surface are parallel to E0-E1 at V, and the limit of the normal is
/// (E0-V) x (E1-V) (approached like 1/log of the distance). Row 2 then is `(E0+E1-2V)/2`. If E0, V, E1 are collinear
/// the cross product of these rows vanishes.
///
/// # Panics
/// If `faces == 0`.
pub fn crease(faces: u32) -> Matrix {
    assert!(faces >= 1, "a boundary vertex has at least one face");
    let k = faces as usize;
    let mut rows = Matrix::zeros(3, 2 * k + 2);
    let (first, last) = (1, 2 * k + 1);
    for (col, position, tangent) in [(0, 4.0, 0.0), (first, 1.0, 0.5), (last, 1.0, -0.5)] {
        rows.set(0, col, position / 6.0);
        rows.set(1, col, tangent);
    }
    for (col, weight) in cross_tangent(faces).into_iter().enumerate() {
        rows.set(2, col, weight);
    }
    rows
}

/// Limit position and two tangents of a boundary vertex with one face that stays where it is, over V, E0, F0, E1: 3 x 4.
/// Row 1 x row 2 is the outward normal.
///
/// The derivatives of the bicubic with points reflected beyond both boundaries: towards E0 and towards E1.
pub fn corner() -> Matrix {
    Matrix::from_rows(&[vec![1.0, 0.0, 0.0, 0.0], vec![-1.0, 1.0, 0.0, 0.0], vec![-1.0, 0.0, 0.0, 1.0]])
}

/// Row 2 of [`crease`].
///
/// The sine values on E1..E(k-1) and the faces are the odd left eigenvector of the smooth ring of valence 2k; the
/// weights of V and of the two boundary neighbours follow from `l (S - lambda) = 0` for the columns of the boundary
/// curve, whose points refine among themselves by (1,6,1)/8 and (1,1)/2.
fn cross_tangent(faces: u32) -> Vec<f64> {
    let k = i64::from(faces);
    if k == 1 {
        return vec![-1.0, 0.5, 0.0, 0.5];
    }
    let sub = Subdominant::of_valence(2 * k);
    let lambda = sub.lambda();
    let face = sub.face_to_edge();
    // Inflow from the interior columns into V (`a_v`) and into E0 or Ek (`a_e`), summed in closed form.
    let ((cos_half, sin_half), sin) = (turn(1, 4 * k), turn(1, 2 * k).1);
    let a_v = 0.375 * cos_half / sin_half + face / (4.0 * sin_half);
    let a_e = sin / 16.0 + face * sin_half / 4.0;
    let vertex = (a_v * (lambda - 0.5) + a_e) / ((lambda - 1.0) * (lambda - 0.25));
    let boundary = (lambda - 0.75) * vertex - a_v;
    let scale = 2.0 * sub.edge_weight(2 * k);
    (-1..=2 * k)
        .map(|half_steps| {
            scale
                * match half_steps {
                    -1 => vertex,
                    h if h == 0 || h == 2 * k => boundary,
                    h => turn(h, 4 * k).1 * if h % 2 == 1 { face } else { 1.0 },
                }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row_sum(m: &Matrix, r: usize) -> f64 {
        m.row(r).iter().sum()
    }

    #[test]
    fn rows_are_points_and_vectors_at_any_valence() {
        for n in [2, 3, 4, 5, 7, 12, 64, 401, 1000] {
            for m in [interior(n), crease(n), crease(1)] {
                assert!((row_sum(&m, 0) - 1.0).abs() < 1e-13);
                assert!(row_sum(&m, 1).abs() < 1e-13 && row_sum(&m, 2).abs() < 1e-13, "{n}: {}", row_sum(&m, 2));
            }
        }
    }

    #[test]
    fn valence_four_is_the_bicubic_derivative() {
        let m = interior(4);
        let expected = [0.0, 4.0, 1.0, 0.0, -1.0, -4.0, -1.0, 0.0, 1.0].map(|w| w / 12.0);
        assert!(m.row(1).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-16), "{:?}", m.row(1));
    }

    #[test]
    fn two_faces_are_the_reflected_bicubic() {
        let m = crease(2);
        // (row above the boundary - boundary row), each filtered by (1,4,1)/6: V, E0, F0, E1, F1, E2.
        let expected = [-4.0, -1.0, 1.0, 4.0, 1.0, -1.0].map(|w| w / 6.0);
        assert!(m.row(2).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{:?}", m.row(2));
    }

    #[test]
    fn valence_two_stays_finite_and_keeps_its_symmetry() {
        let m = interior(2);
        assert_eq!(m.row(1)[1], -m.row(1)[3]);
        assert_eq!(m.row(2)[2], -m.row(2)[4]);
        assert!(m.row(1)[1] > 0.0 && m.row(2)[2] > 0.0 && m.row(1)[2] == 0.0);
    }
}
