//! Curvature-continuous patches: one bidegree 7 Bezier patch per quad at an interior extraordinary vertex, as a linear
//! map of its net.
//!
//! Loop, *Hardware Subdivision and Tessellation of Catmull-Clark Surfaces* (2010), section 4.3, draws such patches from
//! 64 x (2n+8) matrices that it takes from Loop and Schaefer, *G2 Tensor Product Splines over Extraordinary Vertices*
//! (2008). Differs from Loop and Schaefer 2008: the conditions below are derived from the chain rule of second order
//! and from locality alone, so that correspondence and energy need not be theirs.
//!
//! # Derivation
//! Coefficient `b(i,j)` of a patch is row `i + 8 j`, i along u. Patch p has spoke 0 (V to E0) on v = 0; its clockwise
//! neighbour q has the same spoke on its side u = 0, walked by its v. Write `p_u` and `p_v` for the derivatives of p
//! along and across the spoke, and for q likewise `q_y` along and `q_x` across.
//!
//! **Outer sides.** `b(i,j)` with i >= 5 or j >= 5 are those of the bicubic B-spline of the net, raised to degree 7:
//! they hold the second-order jet on u = 1 and v = 1, so every neighbour there, bicubic or biseptic, meets the patch
//! with equal second derivatives. The point that the net lacks has no weight in them. 25 coefficients (i, j <= 4) are
//! left.
//!
//! **Spokes.** p and q join with continuous curvature when some change of parameters makes their second-order jets
//! equal. Taking one that treats both sides alike, with polynomials alpha, gamma and epsilon of the spoke's parameter:
//! ```text
//! (G0)  p = q
//! (G1)  alpha (p_v + q_x)  = gamma p_u
//! (G2)  alpha (p_vv - q_xx) = gamma (p_uv - q_xy) + epsilon (p_v - q_x)
//! ```
//! Split the pair into its halves that are equal and opposite on both sides. The even half meets G0 and G2 by symmetry
//! and needs `2 alpha P_v = gamma P'`; the odd half meets G1 and needs `P = 0` and
//! `alpha P_vv = gamma P_v' + epsilon P_v`. These are identities between polynomials, imposed on their Bernstein
//! coefficients.
//!
//! **At V.** n sectors of equal angle close up if `gamma / alpha = 2 cos(2 pi / n)` at 0. Then one quadratic form at V
//! meets the conditions of all spokes, but for n = 3, where it exists only if at 0 also `epsilon / alpha = (gamma / alpha)'`.
//!
//! **Locality.** A point that p's net lacks must not move p, so O1 moves the even half of two patches only: their
//! coefficients with i <= 2 stay. Near V then `P_v = O(u^3)`, hence by G1 `P' = O(u^3)`. At u = 1 the bicubic gives
//! P = 1/6, P' = 1/2, P'' = 1 and `P_v = O((1-u)^3)`, which gamma must provide. What is left of P' is `u^3 r(u)` with a
//! cubic r, three conditions at u = 1 and hence one parameter tau:
//! ```text
//! r(u) = (2 u^2 - 5 u + 4) / 2 + tau (1-u)^2 (4 - 7 u)
//! ```
//! With the least gamma, `2 cos(2 pi / n) alpha(0) (1-u)^3`, alpha divides r, and must be quadratic for P_v to have
//! degree 7: it is the factor of r without real zeros. Epsilon is 0, but valence 3 needs it: see `correspondence`.
//!
//! **Freedom.** 6 to 12 coefficients remain per Fourier mode of the ring. Least squares of the fourth differences of
//! the Bezier points along i and j choose them: zero exactly for bicubics, so that n = 4 is the bicubic B-spline patch.
//! The columns of O0..O6 are fair by themselves. Those of V, E and F are not: a single point's bump is no shape a
//! surface has, and the columns would sum to 1 within 1 % only. Instead the ring is made fair for the 2n+1 eigenvectors
//! of Catmull-Clark subdivision, and the columns follow from these by linear algebra. The constant is one of them, so
//! that points sum to 1.
//!
//! **Pins.** The position and the tangent plane at V are those of the limit surface, so the vertex record is that of
//! every other scheme. From valence 9 on the energy alone stretches the first derivative at V, and at valence 3 it
//! leaves cube corners pointed: these are set (see `correspondence` and `ring`).
//!
//! # Watertightness
//! The sides u = 1 and v = 1 are cubics: their records are those of [`gregory::edge`](crate::gregory::edge). Spokes
//! have records of degree 7 ([`edge`]). Both answer the question that section 4.3 of the report leaves open.

mod correspondence;
mod degree7;
mod fair;
mod mode;
mod outer;
mod ring;
mod spoke;
pub mod twin;

pub use degree7::{curve, evaluate};

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use crate::masks;
use crate::matrix::Matrix;

/// Valences whose shape has been examined, and whose nets fit the 32 points of a tessellation patch.
pub const VALENCES: RangeInclusive<u32> = 3..=12;

/// The valences that [`patch`] has constants for. 13 and 14 keep every continuity, but with more curvature along their
/// spokes the more they are stretched; beyond, a dimple appears at V.
pub const POSSIBLE_VALENCES: RangeInclusive<u32> = 3..=14;

/// The 64 Bezier points of the patch, row `i + 8 j` with i along u: 64 x (2n+8), over the net of
/// [`NetKind::Interior`](crate::NetKind::Interior).
///
/// Rows sum to 1. Exchanging u and v mirrors the net bit for bit, and the rows of a spoke are bit for bit those that
/// the patch on its other side has for it. Valence 4 is the bicubic B-spline patch but for rounding.
///
/// Generated when a valence is first asked for, in some milliseconds, and kept.
///
/// # Panics
/// If `valence` is not in [`POSSIBLE_VALENCES`].
pub fn patch(valence: u32) -> Matrix {
    assert!(
        POSSIBLE_VALENCES.contains(&valence),
        "biseptic patches exist for valences {POSSIBLE_VALENCES:?}, not {valence}; use another scheme there"
    );
    generated(valence).clone()
}

/// The matrix of a valence, generated once.
fn generated(valence: u32) -> &'static Matrix {
    static MATRICES: [OnceLock<Matrix>; 12] = [const { OnceLock::new() }; 12];
    MATRICES[(valence - POSSIBLE_VALENCES.start()) as usize].get_or_init(|| generate(valence))
}

fn generate(valence: u32) -> Matrix {
    let columns = ring::columns(valence);
    let mut matrix = Matrix::from_fn(64, columns.len(), |row, col| columns[col][row]);
    share_spokes(valence, &mut matrix);
    matrix
}

/// The record of spoke 0 (`side` 0, walked from V) or spoke 1 (`side` 3, walked towards V): 16 x (2n+8). Rows 0..8 are
/// the Bezier points of the curve C of degree 7, rows 8..16 those of the cross derivative D. The surface normal on the
/// spoke is C' x D.
///
/// As in [`gregory::edge`](crate::gregory::edge), D is half the difference (left - right)/2 of the derivatives of the
/// two patches across the edge per unit parameter, left being into this patch; the sum of the two is parallel to C' by
/// G1. The neighbour's C is reversed, its D reversed and negated, both bit for bit. The outer sides 1 and 2 are cubics,
/// recorded by `gregory::edge`.
///
/// # Panics
/// If `side` is neither 0 nor 3, or `valence` is not in [`POSSIBLE_VALENCES`].
pub fn edge(valence: u32, side: usize) -> Matrix {
    assert!(side == 0 || side == 3, "sides 0 and 3 are spokes, side {side} is not: use gregory::edge");
    let patch = patch(valence);
    let mirror = mirror_across_spoke(valence);
    let cross = |i: usize, col: usize| 3.5 * (patch.get(i + 8, col) - patch.get(i, col));
    let spoke0 = |row: usize, col: usize| match mirror[col] {
        None => 0.0,
        Some(_) if row < 8 => patch.get(row, col),
        Some(mirrored) => cross(row - 8, col) - cross(row - 8, mirrored),
    };
    let diagonal = mirror_across_diagonal(valence);
    Matrix::from_fn(16, patch.cols(), |row, col| {
        if side == 0 { spoke0(row, col) } else { spoke0((7 - row % 8) + 8 * (row / 8), diagonal[col]) }
    })
}

/// Makes the rows of both spokes exactly what the construction makes them but for rounding: symmetric under reflection
/// in the spoke, without points that only one of its patches has, and at V the limit mask.
fn share_spokes(valence: u32, matrix: &mut Matrix) {
    let (across, diagonal) = (mirror_across_spoke(valence), mirror_across_diagonal(valence));
    for i in 1..8 {
        let row = matrix.row(i).to_vec();
        let shared: Vec<f64> =
            (0..row.len()).map(|col| across[col].map_or(0.0, |mirrored| (row[col] + row[mirrored]) / 2.0)).collect();
        for col in 0..row.len() {
            matrix.set(i, col, shared[col]);
            matrix.set(8 * i, col, shared[diagonal[col]]);
        }
    }
    let limit = masks::interior(valence);
    for col in 0..matrix.cols() {
        matrix.set(0, col, if col < limit.cols() { limit.get(0, col) } else { 0.0 });
    }
}

/// Where each net point goes when spoke 0 is the mirror; `None` for those that the patch beyond lacks.
fn mirror_across_spoke(valence: u32) -> Vec<Option<usize>> {
    let n = valence as usize;
    let ring = (0..2 * n).map(|half_step| Some(1 + (2 * n - half_step) % (2 * n)));
    let outer = [Some(2), Some(1), Some(0), None, None, None, None].map(|o| o.map(|o: usize| 2 * n + 1 + o));
    std::iter::once(Some(0)).chain(ring).chain(outer).collect()
}

/// Where each net point goes when u and v are exchanged.
fn mirror_across_diagonal(valence: u32) -> Vec<usize> {
    let n = valence as usize;
    let ring = (0..2 * n).map(|half_step| 1 + (2 * n + 2 - half_step) % (2 * n));
    std::iter::once(0).chain(ring).chain((0..7).map(|o| 2 * n + 7 - o)).collect()
}

/// Values of the 64 coefficients of a patch under one unit of something, or weights on them; index `i + 8 j`.
type Coefficients = [f64; 64];

/// Coefficients with u and v exchanged.
fn transposed(b: &Coefficients) -> Coefficients {
    std::array::from_fn(|k| b[k / 8 + 8 * (k % 8)])
}

/// The combination `sum factor * b`.
fn combine<const K: usize>(terms: [(f64, &Coefficients); K]) -> Coefficients {
    std::array::from_fn(|k| terms.iter().map(|(factor, b)| factor * b[k]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generation_repeats_bit_for_bit() {
        for n in POSSIBLE_VALENCES {
            assert_eq!(&generate(n), generated(n));
        }
    }

    #[test]
    fn mirrors_are_involutions_that_keep_their_axis() {
        for n in POSSIBLE_VALENCES {
            let (across, diagonal) = (mirror_across_spoke(n), mirror_across_diagonal(n));
            assert_eq!((across.len(), diagonal.len()), (2 * n as usize + 8, 2 * n as usize + 8));
            for (i, &m) in diagonal.iter().enumerate() {
                assert_eq!(diagonal[m], i);
                assert!(across[i].is_none_or(|m| across[m] == Some(i)));
            }
            // E0 and O1 lie on spoke 0; F0 and O3 on the diagonal, E0 and E1 are each other's images.
            assert_eq!((across[1], across[2 * n as usize + 2]), (Some(1), Some(2 * n as usize + 2)));
            assert_eq!((diagonal[2], diagonal[2 * n as usize + 4], diagonal[1]), (2, 2 * n as usize + 4, 3));
        }
    }
}
