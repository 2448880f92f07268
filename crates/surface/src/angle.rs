//! Cosine and sine of rational parts of a turn, exact where they are 0 or 1.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// `(cos, sin)` of `2 pi num / den`.
///
/// The argument is reduced to an eighth of a turn in integers, so quarter turns are exact and symmetric angles give
/// equal magnitudes: weights that must vanish or cancel do so exactly, at any valence.
pub(crate) fn turn(num: i64, den: i64) -> (f64, f64) {
    let quarters = 4 * num.rem_euclid(den);
    let (quadrant, rest) = (quarters / den, quarters % den);
    let angle = |part: i64| FRAC_PI_2 * part as f64 / den as f64;
    let (c, s) = match (2 * rest).cmp(&den) {
        std::cmp::Ordering::Less => (angle(rest).cos(), angle(rest).sin()),
        std::cmp::Ordering::Equal => (FRAC_1_SQRT_2, FRAC_1_SQRT_2),
        std::cmp::Ordering::Greater => (angle(den - rest).sin(), angle(den - rest).cos()),
    };
    match quadrant {
        0 => (c, s),
        1 => (-s, c),
        2 => (-c, -s),
        _ => (s, -c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_library_and_is_exact_at_quarters() {
        for den in 1..40 {
            for num in -80..80 {
                let x = std::f64::consts::TAU * num as f64 / den as f64;
                let (c, s) = turn(num, den);
                assert!((c - x.cos()).abs() < 2e-13 && (s - x.sin()).abs() < 2e-13, "{num}/{den}");
            }
        }
        assert_eq!(turn(1, 4), (0.0, 1.0));
        assert_eq!(turn(-1, 4), (0.0, -1.0));
        assert_eq!(turn(6, 12), (-1.0, 0.0));
        assert_eq!(turn(1, 7).0, turn(-1, 7).0);
    }
}
