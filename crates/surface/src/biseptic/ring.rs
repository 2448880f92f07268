//! The columns of all points: the fairest surfaces around the vertex for the eigenvectors of subdivision, turned into
//! responses to single points.

use glam::{DMat3, DVec3};

use super::correspondence::{self, Correspondence};
use super::fair::fill;
use super::mode::{Eigenvector, Mode};
use super::outer::{fill_outer_columns, fixed_columns};
use super::spoke::SpokeConditions;
use super::{Coefficients, combine, transposed};

/// A linear condition on the coefficients of a patch: weights and the value of their sum.
type Condition = (Coefficients, f64);

/// The columns of the patch matrix, in net order.
pub(super) fn columns(valence: u32) -> Vec<Coefficients> {
    let n = valence as usize;
    let conditions = SpokeConditions::new(&Correspondence::of_valence(valence));
    let mut columns = fixed_columns(valence);
    let fixed = columns.clone();
    fill_outer_columns(&mut columns, &conditions);
    columns[..=2 * n].fill([0.0; 64]);
    for mode in Mode::all(valence) {
        let [vertex, edge, face] = responses(mode, &conditions, &fixed, &columns[2 * n + 1..]);
        columns[0] = combine([(1.0, &columns[0]), (1.0, &turned(&vertex, 1.0, 0.0))]);
        for half_sectors in 0..2 * n {
            // A unit point has amplitude 1/n in each mode, conjugate to its phase.
            let response = if half_sectors % 2 == 0 { &edge } else { &face };
            let (cos, sin) = mode.phase(half_sectors as i64 - 1);
            let share = mode.multiplicity() / n as f64;
            let column = &mut columns[1 + half_sectors];
            *column = combine([(1.0, column), (share, &turned(response, cos, sin))]);
        }
    }
    columns
}

/// `Re cos + Im sin` of the complex coefficients that `b` holds: exactly mirrored if `sin` changes sign.
fn turned(b: &Coefficients, cos: f64, sin: f64) -> Coefficients {
    let mirrored = transposed(b);
    std::array::from_fn(|k| 0.5 * ((b[k] + mirrored[k]) * cos + (b[k] - mirrored[k]) * sin))
}

/// What unit amplitudes of V, the E and the F of a mode contribute to patch 0 without the points O.
fn responses(
    mode: Mode,
    conditions: &SpokeConditions,
    fixed: &[Coefficients],
    outer: &[Coefficients],
) -> [Coefficients; 3] {
    let spoke = spoke_conditions(mode, conditions);
    let mut surfaces = Vec::new();
    let mut amplitudes = Vec::new();
    for (rank, at) in mode.eigenvectors().into_iter().enumerate() {
        let net = mode.net(at);
        let border = weighted_sum(fixed, &net);
        let conditions = [spoke.clone(), pins(mode, at, rank)].concat();
        let surface = fill(&border, &inner(), &conditions);
        let rest = weighted_sum(outer, &net[net.len() - 7..]);
        surfaces.push(combine([(1.0, &surface), (-1.0, &rest)]));
        amplitudes.push(DVec3::new(at.vertex, at.edge, at.face));
    }
    if mode.k != 0 {
        // V takes no part: it alone completes the basis.
        surfaces.push([0.0; 64]);
        amplitudes.push(DVec3::X);
    }
    let inverse = DMat3::from_cols(amplitudes[0], amplitudes[1], amplitudes[2]).inverse();
    [inverse.x_axis, inverse.y_axis, inverse.z_axis]
        .map(|share| combine([(share.x, &surfaces[0]), (share.y, &surfaces[1]), (share.z, &surfaces[2])]))
}

/// Indices of the coefficients that the outer sides do not fix.
fn inner() -> Vec<usize> {
    (0..64).filter(|k| k % 8 <= 4 && k / 8 <= 4).collect()
}

fn weighted_sum(columns: &[Coefficients], weights: &[f64]) -> Coefficients {
    assert_eq!(columns.len(), weights.len(), "one weight per column");
    let mut sum = [0.0; 64];
    for (column, &weight) in columns.iter().zip(weights) {
        sum = combine([(1.0, &sum), (weight, column)]);
    }
    sum
}

/// The conditions across spoke 0 on a patch of this mode. Seen from the spoke its coefficients are turned by half a
/// sector, and those of the other patch are their conjugates: the even half is the real part, the odd half the
/// imaginary part.
fn spoke_conditions(mode: Mode, conditions: &SpokeConditions) -> Vec<Condition> {
    let even = conditions.even.iter().map(|weights| (real_part(mode, weights), 0.0));
    let odd = conditions.odd.iter().map(|weights| (imaginary_part(mode, weights), 0.0));
    even.chain(odd).collect()
}

/// Weights on a patch of this mode that apply `weights` to the real part seen from spoke 0.
fn real_part(mode: Mode, weights: &Coefficients) -> Coefficients {
    let (cos, sin) = mode.phase(1);
    turned(weights, cos, -sin)
}

/// Likewise for the imaginary part.
fn imaginary_part(mode: Mode, weights: &Coefficients) -> Coefficients {
    let (cos, sin) = mode.phase(1);
    turned(weights, sin, cos)
}

/// What is set at V rather than left to the energy: position and tangent plane of the limit, and where the energy
/// alone makes a poor shape the size of a derivative.
fn pins(mode: Mode, at: Eigenvector, rank: usize) -> Vec<Condition> {
    let row = |weights: [f64; 3]| {
        let along: Coefficients = std::array::from_fn(|k| weights.get(k).copied().unwrap_or(0.0));
        real_part(mode, &along)
    };
    let (first, valence) = (row([-7.0, 7.0, 0.0]), mode.n as u32);
    match (mode.k, rank) {
        (0, _) => {
            let n = mode.n as f64;
            let limit = (n * at.vertex + 4.0 * at.edge + at.face) / (n + 5.0);
            let round = (mode.n == 3).then(|| (row([42.0, -84.0, 42.0]), second_derivative_of_three(at)));
            std::iter::once((row([1.0, 0.0, 0.0]), limit)).chain(round).collect()
        }
        (1, 0) => {
            correspondence::first_derivative(valence).map(|length| (first, length * at.edge)).into_iter().collect()
        }
        (1, _) => vec![(first, 0.0)],
        _ => Vec::new(),
    }
}

/// The second derivative along a spoke at V of valence 3, when all sectors are equal: chosen so that the corners of
/// cubes and the bottoms of bowls are round (the mean curvature over a cube's corner stays within 0.99 to 1.43, where
/// a sphere of that size has 1.16; left to the energy it does not).
fn second_derivative_of_three(at: Eigenvector) -> f64 {
    -0.517_125 * at.vertex - 0.0785 * at.edge + 0.595_625 * at.face
}
