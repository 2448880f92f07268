//! Which level, sub-patch and local parameters a point of the patch has.

/// A place in the ring of sub-patches around V: `m = level` steps after the first, the square `[1/2, 1)` of that
/// level's patch holds it.
///
/// ```text
///  v +---+---+      sub-patch 0: u >= 1/2 > v, 1: both >= 1/2, 2: v >= 1/2 > u,
///    | 2 | 1 |      of the patch scaled by 2^-level; the quarter at V is the next level
///    +---+---+
///    | V | 0 |
///    +---+---+ u
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Steps m of subdivision before the one that makes the sub-patch.
    pub(super) level: i32,
    /// Which of the three.
    pub(super) sub_patch: usize,
    /// Parameters in the sub-patch, in 0..=1.
    pub(super) u: f64,
    /// As `u`.
    pub(super) v: f64,
}

impl Place {
    /// The place of (u, v), or `None` at V. Scaling by powers of two and subtracting 1 is exact.
    ///
    /// 1 belongs to level 0, where it is the end of a sub-patch.
    pub(super) fn of(u: f64, v: f64) -> Option<Self> {
        let largest = u.max(v);
        // Subnormal parameters are below any difference in position.
        if largest < f64::MIN_POSITIVE {
            return None;
        }
        let exponent = (largest.to_bits() >> 52) as i32 - 1023;
        let level = (-1 - exponent).max(0);
        let scale = scale(level);
        let (a, b) = (u * scale, v * scale);
        let (sub_patch, u, v) = match (a >= 1.0, b >= 1.0) {
            (true, false) => (0, a - 1.0, b),
            (true, true) => (1, a - 1.0, b - 1.0),
            _ => (2, a, b - 1.0),
        };
        Some(Self { level, sub_patch, u, v })
    }

    /// `2^(level + 1)`: by how much derivatives over the sub-patch are smaller than those over the patch.
    pub(super) fn scale(self) -> f64 {
        scale(self.level)
    }
}

fn scale(level: i32) -> f64 {
    2.0_f64.powi(level + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_in_their_sub_patch_and_lead_back() {
        for (u, v) in [(1.0, 1.0), (0.5, 0.0), (0.0, 1.0), (0.3, 0.2), (0.0, 1e-9), (0.7, 0.6), (1e-300, 2e-300)] {
            let place = Place::of(u, v).expect("not at V");
            assert!((0.0..=1.0).contains(&place.u) && (0.0..=1.0).contains(&place.v), "{place:?}");
            let corner = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][place.sub_patch];
            assert_eq!(((place.u + corner.0) / place.scale(), (place.v + corner.1) / place.scale()), (u, v));
        }
        assert_eq!(Place::of(0.0, 0.0), None);
        assert_eq!(Place::of(0.5, 0.25), Some(Place { level: 0, sub_patch: 0, u: 0.0, v: 0.5 }));
        assert_eq!(Place::of(0.125, 0.125), Some(Place { level: 2, sub_patch: 1, u: 0.0, v: 0.0 }));
    }
}
