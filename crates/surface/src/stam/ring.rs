//! Eigenvectors of the rules on the ring of V, in closed form.
//!
//! Around V the rules commute with turning the ring, so a discrete Fourier transform splits them into blocks of size 2
//! (3 for the constant mode): A. A. Ball and D. J. T. Storry, *Conditions for tangent plane continuity over recursively
//! generated B-spline surfaces* (1988). A sector between sharp edges has the odd modes of a ring of twice as many faces,
//! and four more for its boundary curve.

use crate::angle::turn;

use super::refine::Fan;

/// A vector y over the ring with `S y = lambda y`, or `S y = lambda (y + factor * receiver)` if `chain` says so.
pub(super) struct RingMode {
    /// The eigenvalue.
    pub(super) lambda: f64,
    /// Values on V, E0, F0, E1, ...
    pub(super) vector: Vec<f64>,
    /// Index of the receiving mode in the list, which comes earlier, and the factor.
    pub(super) chain: Option<(usize, f64)>,
}

impl RingMode {
    fn eigen(lambda: f64, vector: Vec<f64>) -> Self {
        let largest = vector.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
        Self { lambda, vector: vector.iter().map(|y| y / largest).collect(), chain: None }
    }
}

/// Eigenvalue and ratio of faces to edges of both modes at the angle `2 pi num / den` from edge to edge, larger
/// eigenvalue first.
///
/// With `h` the cosine of half the angle and `g = sqrt(4 + h^2)`, `lambda = (2 + h^2 +- h g)/8` and the ratio
/// `(h/2) / (lambda - 1/4)` is `g - h` or `-(g + h)`: written so, nothing cancels at any valence. The product of the
/// eigenvalues is 1/16.
fn wave(num: i64, den: i64) -> [(f64, f64); 2] {
    let h = turn(num, 2 * den).0;
    let g = (4.0 + h * h).sqrt();
    // A quarter turn must give exactly 1/2 and 1/8: the latter is an eigenvalue of the outer points as well.
    let high = if 4 * num == den { 0.5 } else { (2.0 + h * h + h * g) / 8.0 };
    [(high, g - h), (0.0625 / high, -(g + h))]
}

/// A full set of modes of the ring, the constant one first. For a closed ring the modes are even or odd about the axis
/// at `axis` half steps from edge 0 (0: edge 0, 1: the diagonal of face 0, 2: edge 1).
pub(super) fn modes(fan: Fan, axis: i64) -> Vec<RingMode> {
    let mut modes = vec![RingMode::eigen(1.0, vec![1.0; fan.size()])];
    if fan.closed {
        closed_modes(fan, axis, &mut modes);
    } else {
        sector_modes(fan, &mut modes);
        boundary_modes(fan, &mut modes);
    }
    modes
}

/// Values on the ring from those at edges and faces by half steps: edge i is at 2i, face i at 2i+1.
fn over_ring(fan: Fan, vertex: f64, value: impl Fn(i64) -> f64) -> Vec<f64> {
    std::iter::once(vertex).chain((0..fan.size() as i64 - 1).map(value)).collect()
}

/// Cosine and sine waves m = 1..=n/2 with V = 0, then the two modes that are constant on edges and on faces.
fn closed_modes(fan: Fan, axis: i64, modes: &mut Vec<RingMode>) {
    let n = fan.faces as i64;
    for m in 1..=n / 2 {
        for (branch, (lambda, ratio)) in wave(m, n).into_iter().enumerate() {
            let amplitude = |step: i64| if step % 2 == 1 { ratio } else { 1.0 };
            let angle = |step: i64| turn(m * (step - axis), 2 * n);
            let cosine = over_ring(fan, 0.0, |step| amplitude(step) * angle(step).0);
            let sine = over_ring(fan, 0.0, |step| amplitude(step) * angle(step).1);
            if 2 * m < n {
                modes.push(RingMode::eigen(lambda, cosine));
                modes.push(RingMode::eigen(lambda, sine));
            } else {
                // Alternating values, on edges alone or on faces alone: both branches have eigenvalue 1/4.
                let parity = i64::try_from(branch).expect("0 or 1");
                let alternating = |step: i64| if step % 2 == parity { 1.0 - 2.0 * (step / 2 % 2) as f64 } else { 0.0 };
                modes.push(RingMode::eigen(lambda, over_ring(fan, 0.0, alternating)));
            }
        }
    }
    for lambda in constant_roots(fan.faces as f64) {
        // Rows E and F of (S - lambda) (1, e, f) = 0.
        let (ee, ff) = (0.5 - lambda, 0.25 - lambda);
        let det = ee * ff - 0.125 * 0.5;
        let (e, f) = ((0.125 * 0.25 - 0.375 * ff) / det, (0.5 * 0.375 - 0.25 * ee) / det);
        modes.push(RingMode::eigen(lambda, over_ring(fan, 1.0, |step| if step % 2 == 0 { e } else { f })));
    }
}

/// The roots of `x^2 - (3n-7)/(4n) x + (n-3)/(16n)`, the smaller in magnitude without cancellation: exactly 0 at n = 3,
/// exactly 1/8 at n = 2 (the other is -1/4).
fn constant_roots(n: f64) -> [f64; 2] {
    let (half, product) = ((3.0 * n - 7.0) / (8.0 * n), (n - 3.0) / (16.0 * n));
    let large = half + (half * half - product).sqrt().copysign(half);
    [large, product / large]
}

/// Sine waves m = 1..k-1, and faces alternating: zero on V and on the sharp edges.
fn sector_modes(fan: Fan, modes: &mut Vec<RingMode>) {
    let k = fan.faces as i64;
    for m in 1..k {
        for (lambda, ratio) in wave(m, 2 * k) {
            let sine = |step: i64| turn(m * step, 4 * k).1 * if step % 2 == 1 { ratio } else { 1.0 };
            modes.push(RingMode::eigen(lambda, over_ring(fan, 0.0, sine)));
        }
    }
    let alternating = |step: i64| if step % 2 == 1 { sign(step / 2) } else { 0.0 };
    modes.push(RingMode::eigen(0.25, over_ring(fan, 0.0, alternating)));
}

fn sign(i: i64) -> f64 {
    if i % 2 == 0 { 1.0 } else { -1.0 }
}

/// The modes that move the boundary curve: eigenvalues 1/2 and 1/4 of the rules (1,6,1)/8, (1,1)/2.
///
/// With eigenvalue 1/2 the coordinates x and y of a grid whose every quad turns by a right angle are eigenvectors for
/// any k, where the boundary allows them: it needs E0 = -Ek. With eigenvalue 1/4 the curve has V = -1, E0 = Ek = 2.
/// Where a wave of [`sector_modes`] has the same eigenvalue and is excited, a chain vector takes the place of an
/// eigenvector: at 1/2 for k = 0 mod 4 (wave k/2), at 1/4 for k odd (alternating faces).
fn boundary_modes(fan: Fan, modes: &mut Vec<RingMode>) {
    let k = fan.faces as i64;
    let ratio = |step: i64| if step % 2 == 1 { std::f64::consts::SQRT_2 } else { 1.0 };
    let x = |step: i64| ratio(step) * turn(step, 8).0;
    let y = |step: i64| ratio(step) * turn(step, 8).1;
    let fade = |step: i64| 1.0 - step as f64 / k as f64;
    let along = match k % 4 {
        0 => {
            let skew = |step: i64| if step % 2 == 1 { y(step) / (3.0 * k as f64) } else { 0.0 };
            let vector = over_ring(fan, 0.0, |step| fade(step) * x(step) - skew(step));
            // (S - 1/2) vector = y / (3k), and y is the larger mode of wave k/2.
            let wave = 1 + 2 * (fan.faces / 2 - 1);
            RingMode { lambda: 0.5, vector, chain: Some((wave, 2.0 / (3.0 * k as f64))) }
        }
        2 => RingMode::eigen(0.5, over_ring(fan, 0.0, x)),
        _ => RingMode::eigen(0.5, over_ring(fan, 0.0, |step| x(step) - turn(k, 4).1 * y(step))),
    };
    let curvature = |step: i64| match (step % 2, k % 2) {
        (1, _) => 2.0,
        (_, 0) => 0.5 + 1.5 * sign(step / 2),
        _ => 0.5 + 1.5 * sign(step / 2) * fade(step),
    };
    let mut bend = RingMode::eigen(0.25, over_ring(fan, -1.0, curvature));
    if k % 2 == 1 {
        // (S - 1/4) of the vector before scaling, whose largest value is 2, is 3/(4k) times alternating faces.
        let alternating = modes.len() - 1;
        bend.chain = Some((alternating, 3.0 / (2.0 * k as f64)));
    }
    modes.push(along);
    modes.push(bend);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest |S y - lambda (y + factor receiver)| of all modes.
    fn residual(fan: Fan, axis: i64) -> f64 {
        let (step, modes) = (fan.step(), modes(fan, axis));
        assert_eq!(modes.len(), fan.size());
        modes.iter().fold(0.0_f64, |worst, mode| {
            (0..fan.size()).fold(worst, |worst, r| {
                let image: f64 = step.row(r).iter().zip(&mode.vector).map(|(s, y)| s * y).sum();
                let chained = mode.chain.map_or(0.0, |(to, factor)| factor * modes[to].vector[r]);
                worst.max((image - mode.lambda * (mode.vector[r] + chained)).abs())
            })
        })
    }

    #[test]
    fn closed_rings_satisfy_their_eigenvalue_equations() {
        for faces in (2..=24).chain([64, 200]) {
            for axis in 0..3 {
                let error = residual(Fan { faces, closed: true }, axis);
                assert!(error < 1e-14, "valence {faces}, axis {axis}: {error:e}");
            }
        }
    }

    #[test]
    fn sectors_satisfy_their_eigenvalue_equations() {
        for faces in (1..=24).chain([64, 100]) {
            let error = residual(Fan { faces, closed: false }, 0);
            assert!(error < 1e-14, "{faces} faces: {error:e}");
        }
    }

    #[test]
    fn chains_occur_where_the_theory_says() {
        for faces in 1..=24 {
            let chains: Vec<f64> = modes(Fan { faces, closed: false }, 0)
                .iter()
                .filter_map(|mode| mode.chain.map(|_| mode.lambda))
                .collect();
            let expected: &[f64] = match faces % 4 {
                0 => &[0.5],
                2 => &[],
                _ => &[0.25],
            };
            assert_eq!(chains, expected, "{faces} faces");
        }
    }

    #[test]
    fn eigenvalues_that_meet_those_of_other_blocks_are_exact() {
        assert_eq!(constant_roots(3.0)[1], 0.0);
        assert_eq!(constant_roots(2.0), [-0.25, 0.125]);
        assert_eq!(constant_roots(4.0), [0.25, 0.0625]);
        for quarter in 1..50 {
            assert_eq!(wave(quarter, 4 * quarter).map(|(lambda, _)| lambda), [0.5, 0.125]);
        }
    }
}
