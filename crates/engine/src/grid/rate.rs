//! How one edge is divided: number of segments and parameters of their ends.

use crate::Spacing;

/// Most segments of an edge.
const MAX_SEGMENTS: u32 = 64;

/// Fractional levels between two whole ones.
const LEVEL_STEPS: f32 = 256.0;

/// Division of an edge by the rules of the tessellator (Vulkan specification, "Tessellator Spacing"): equal segments, or with a fractional level f and n
/// segments, n - 2 of length 1/f and two shorter ones at the ends.
///
/// Parameters are multiples of 2^-24 and mirror each other, `t(n - i) = 1 - t(i)` without rounding, so that both patches of an edge find the same ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rate {
    segments: u32,
    /// One over the length of all segments but the first and the last.
    level: f32,
}

impl Rate {
    /// Both halves of an edge: the least that an inner row of vertices needs.
    pub(crate) const HALVES: Self = Self { segments: 2, level: 2.0 };

    /// The division by a tessellation factor. Factors out of the spacing's range are clamped to it; what is not a number counts as 1. Fractional levels are
    /// rounded up to multiples of 1 / 256, so that a surface has a limited number of rates however many edges it has.
    pub(crate) fn new(factor: f32, spacing: Spacing) -> Self {
        let [least, most] = match spacing {
            Spacing::Equal => [1, MAX_SEGMENTS],
            Spacing::Odd => [1, MAX_SEGMENTS - 1],
            Spacing::Even => [2, MAX_SEGMENTS],
        };
        // `max` and `min` drop what is not a number, `clamp` would keep it.
        let factor = factor.max(least as f32).min(most as f32);
        let whole = factor.ceil() as u32;
        let level = (factor * LEVEL_STEPS).ceil() / LEVEL_STEPS;
        match spacing {
            Spacing::Equal => Self { segments: whole, level: whole as f32 },
            Spacing::Odd => Self { segments: whole | 1, level },
            Spacing::Even => Self { segments: whole.next_multiple_of(2), level },
        }
    }

    /// Number of segments.
    pub(crate) fn segments(self) -> u32 {
        self.segments
    }

    /// Orders rates by level, and tells them apart. Levels are positive, so their bits are in order.
    pub(crate) fn key(self) -> (u32, u32) {
        (self.level.to_bits(), self.segments)
    }

    /// Parameter of end `i` of the segments, `0..=segments`: strictly increasing from 0 to 1.
    pub(crate) fn parameter(self, i: u32) -> f32 {
        let n = self.segments;
        debug_assert!(i <= n, "an edge of {n} segments has no end {i}");
        // Floats from 1/2 to 1 are multiples of 2^-24, so mirroring them is exact.
        if 2 * i < n { 1.0 - self.upper(n - i) } else { self.upper(i) }
    }

    /// Parameter of an end in the upper half.
    fn upper(self, i: u32) -> f32 {
        let n = self.segments;
        if i == n {
            1.0
        } else if self.level == n as f32 {
            i as f32 / n as f32
        } else {
            (0.5 + (f64::from(i) - 0.5 * f64::from(n)) / f64::from(self.level)) as f32
        }
    }

    /// All parameters.
    pub(crate) fn parameters(self) -> impl Iterator<Item = f32> {
        (0..=self.segments).map(move |i| self.parameter(i))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACINGS: [Spacing; 3] = [Spacing::Equal, Spacing::Odd, Spacing::Even];

    /// Factors around every whole number, and beyond the ends.
    fn factors() -> impl Iterator<Item = f32> {
        let near = |whole: f32| {
            [whole.next_down(), whole, whole.next_up(), whole + 1e-6, whole + 1e-3, whole + 0.5, whole + 0.999]
        };
        (0..=66).flat_map(move |whole| near(whole as f32)).chain([-3.0, 1e30, f32::INFINITY, f32::NAN])
    }

    fn rates() -> impl Iterator<Item = Rate> {
        factors().flat_map(|factor| SPACINGS.map(|spacing| Rate::new(factor, spacing)))
    }

    #[test]
    fn parameters_rise_from_0_to_1_and_mirror_each_other() {
        for rate in rates() {
            let t: Vec<f32> = rate.parameters().collect();
            assert_eq!((t[0], t[t.len() - 1], t.len() as u32), (0.0, 1.0, rate.segments() + 1), "{rate:?}");
            assert!(t.is_sorted_by(|a, b| a < b), "{rate:?}: {t:?}");
            for (a, b) in t.iter().zip(t.iter().rev()) {
                assert_eq!((1.0 - a).to_bits(), b.to_bits(), "{rate:?}: {t:?}");
            }
        }
    }

    #[test]
    fn counts_are_those_of_the_specification() {
        let segments = |factor: f32| SPACINGS.map(|spacing| Rate::new(factor, spacing).segments());
        assert_eq!(segments(0.2), [1, 1, 2]);
        assert_eq!(segments(1.0), [1, 1, 2]);
        assert_eq!(segments(1.5), [2, 3, 2]);
        assert_eq!(segments(2.0), [2, 3, 2]);
        assert_eq!(segments(3.4), [4, 5, 4]);
        assert_eq!(segments(5.0), [5, 5, 6]);
        assert_eq!(segments(63.5), [64, 63, 64]);
        assert_eq!(segments(1e9), [64, 63, 64]);
        assert_eq!(segments(f32::NAN), [1, 1, 2]);
    }

    #[test]
    fn whole_levels_are_equal_segments() {
        for n in 1..=MAX_SEGMENTS {
            for (i, t) in Rate::new(n as f32, Spacing::Equal).parameters().enumerate() {
                assert!((f64::from(t) - i as f64 / f64::from(n)).abs() <= f64::from(f32::EPSILON) / 4.0);
            }
            let fractional = if n % 2 == 1 { Spacing::Odd } else { Spacing::Even };
            assert_eq!(Rate::new(n as f32, fractional), Rate::new(n as f32, Spacing::Equal));
        }
    }

    #[test]
    fn all_segments_but_the_ends_have_the_length_of_the_level() {
        for (level, spacing, ends) in [(3.5, Spacing::Odd, 0.5 / 7.0), (4.5, Spacing::Even, 0.5 / 9.0)] {
            let t: Vec<f32> = Rate::new(level, spacing).parameters().collect();
            let lengths: Vec<f32> = t.windows(2).map(|w| w[1] - w[0]).collect();
            assert!((lengths[0] - ends).abs() < 1e-6, "{lengths:?}");
            assert!(lengths[1..lengths.len() - 1].iter().all(|l| (l - 1.0 / level).abs() < 1e-6), "{lengths:?}");
        }
    }

    #[test]
    fn a_surface_has_a_limited_number_of_rates() {
        let mut levels: Vec<u32> =
            (0..100_000).map(|i| Rate::new(i as f32 * 0.000_7, Spacing::Odd).level.to_bits()).collect();
        levels.dedup();
        assert!(levels.len() <= 62 * 256 + 1, "{}", levels.len());
        // The shortest segments are still far from nothing.
        let shortest = Rate::new(61f32.next_up(), Spacing::Odd).parameter(1);
        assert!(shortest > 2f32.powi(-16), "{shortest:e}");
    }
}
