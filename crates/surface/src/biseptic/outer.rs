//! What the bicubic data of the outer sides fixes: coefficients 5 to 7 of every column, and the columns of O0..O6.

use super::fair::fill;
use super::spoke::{SpokeConditions, binomial};
use super::{Coefficients, combine, transposed};
use crate::bspline;
use crate::net::NetKind;

/// Columns of a net of `valence`, with the coefficients with i >= 5 or j >= 5 those of the bicubic B-spline and zeros
/// elsewhere.
pub(super) fn fixed_columns(valence: u32) -> Vec<Coefficients> {
    let kind = NetKind::Interior { valence };
    let raised = raised_bspline();
    let mut columns = vec![[0.0; 64]; kind.net_size()];
    for k in (0..64).filter(|k| k % 8 >= 5 || k / 8 >= 5) {
        let mut row = vec![0.0; kind.net_size()];
        // The point (-1,-1) that the net lacks would have weight zero.
        for (x, y) in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))).filter(|&at| at != (0, 0)) {
            kind.grid(x as i32 - 1, y as i32 - 1).add_to(&mut row, raised[k % 8][x] * raised[k / 8][y]);
        }
        for (column, weight) in columns.iter_mut().zip(row) {
            column[k] = weight;
        }
    }
    columns
}

/// Row i gives Bezier point i of degree 7 of a cubic B-spline segment.
fn raised_bspline() -> [[f64; 4]; 8] {
    let share = |i: usize, k: usize| {
        if (k..=k + 4).contains(&i) { binomial(3, k) * binomial(4, i - k) / binomial(7, i) } else { 0.0 }
    };
    std::array::from_fn(|i| {
        std::array::from_fn(|a| (0..4).map(|k| share(i, k) * bspline::TO_BEZIER[k][a]).sum::<f64>())
    })
}

/// Fills in the columns of O0..O6, each alone. O0, O1, O2 move the two patches beside spoke 0 and no other:
/// coefficients with i <= 2 stay zero. O3 moves one patch only. O4, O5, O6 mirror O2, O1, O0.
pub(super) fn fill_outer_columns(columns: &mut [Coefficients], conditions: &SpokeConditions) {
    let first = columns.len() - 7;
    let free = |least_j: usize| -> Vec<usize> { (least_j..=4).flat_map(|j| [3 + 8 * j, 4 + 8 * j]).collect() };
    let zero = |rows: &[Coefficients]| -> Vec<_> { rows.iter().map(|&weights| (weights, 0.0)).collect() };
    let (beside, even, odd) = (free(0), zero(&conditions.even), zero(&conditions.odd));
    let (right, centre, left) = (columns[first], columns[first + 1], columns[first + 2]);
    // Spoke 0 exchanges O0 and O2: their sum moves the even half of the two patches, their difference the odd half.
    let sum = fill(&combine([(1.0, &left), (1.0, &right)]), &beside, &even);
    let difference = fill(&combine([(1.0, &left), (-1.0, &right)]), &beside, &odd);
    columns[first] = combine([(0.5, &sum), (-0.5, &difference)]);
    columns[first + 1] = fill(&centre, &beside, &even);
    columns[first + 2] = combine([(0.5, &sum), (0.5, &difference)]);
    let corner = fill(&columns[first + 3], &free(3), &[]);
    columns[first + 3] = combine([(0.5, &corner), (0.5, &transposed(&corner))]);
    for o in 0..3 {
        columns[first + 6 - o] = transposed(&columns[first + o]);
    }
}
