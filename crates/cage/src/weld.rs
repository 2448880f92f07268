//! Finding equal points.

use std::collections::HashMap;

/// Numbers distinct points. Equal means equal coordinates, whatever the sign of zero; points that are not numbers equal those
/// with the same bits.
pub(crate) struct Welder<const N: usize> {
    known: HashMap<([u64; N], u32), u32>,
}

impl<const N: usize> Default for Welder<N> {
    fn default() -> Self {
        Self { known: HashMap::new() }
    }
}

impl<const N: usize> Welder<N> {
    /// The number of a point among the points of `group`, and whether it is new. Numbers rise over all groups.
    pub(crate) fn weld(&mut self, point: [f64; N], group: u32) -> (u32, bool) {
        let next = self.known.len() as u32;
        // Adding zero turns -0 into +0 and leaves everything else alone.
        let number = *self.known.entry((point.map(|x| (x + 0.0).to_bits()), group)).or_insert(next);
        (number, number == next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_are_one() {
        let mut welder = Welder::default();
        assert_eq!(welder.weld([0.0, 1.0], 0), (0, true));
        assert_eq!(welder.weld([1.0, 0.0], 0), (1, true));
        assert_eq!(welder.weld([-0.0, 1.0], 0), (0, false));
        assert_eq!(welder.weld([0.0, 1.0 + f64::EPSILON], 0), (2, true));
        assert_eq!(welder.weld([0.0, 1.0], 1), (3, true));
    }
}
