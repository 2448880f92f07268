//! Finding equal points.

use std::collections::HashMap;

use glam::DVec3;

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

/// Numbers points of which no two of a group are closer than a tolerance: a point goes to the nearest number within it.
pub(crate) struct NearWelder {
    tolerance: f64,
    /// Numbers by group and by cells as wide as the tolerance: each holds a few, because they keep their distance.
    cells: HashMap<([i64; 3], u32), Vec<u32>>,
    known: Vec<DVec3>,
}

impl NearWelder {
    /// `None` where only equal points are within the tolerance: if it is 0, not a number, or below the spacing of numbers as large as
    /// those of the points.
    pub(crate) fn new(tolerance: f64, points: &[DVec3]) -> Option<Self> {
        const EXACT: f64 = 1.0 / f64::EPSILON;
        let largest = points.iter().fold(0.0, |largest: f64, p| largest.max(p.abs().max_element()));
        let useful = tolerance > 0.0 && tolerance.is_finite() && largest / tolerance < EXACT;
        useful.then(|| Self { tolerance, cells: HashMap::new(), known: Vec::new() })
    }

    /// The number of a point among the points of `group`, and whether it is new. Numbers rise over all groups.
    pub(crate) fn weld(&mut self, point: DVec3, group: u32) -> (u32, bool) {
        let cell = (point / self.tolerance).floor().to_array().map(|x| x as i64);
        let mut nearest: Option<(f64, u32)> = None;
        for k in 0..27 {
            let beside = [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
            let key = [0, 1, 2].map(|axis| cell[axis].saturating_add(beside[axis]));
            for &number in self.cells.get(&(key, group)).into_iter().flatten() {
                let distance = self.known[number as usize].distance(point);
                let closer = nearest.is_none_or(|(least, first)| (distance, number) < (least, first));
                if distance <= self.tolerance && closer {
                    nearest = Some((distance, number));
                }
            }
        }
        if let Some((_, number)) = nearest {
            return (number, false);
        }
        let next = self.known.len() as u32;
        self.known.push(point);
        // What is not a number is near nothing.
        if point.is_finite() {
            self.cells.entry((cell, group)).or_default().push(next);
        }
        (next, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_points_are_one() {
        assert!(NearWelder::new(0.0, &[DVec3::ONE]).is_none());
        assert!(NearWelder::new(f64::NAN, &[DVec3::ONE]).is_none());
        assert!(NearWelder::new(1e-20, &[DVec3::ONE]).is_none());
        let mut welder = NearWelder::new(0.1, &[DVec3::ONE]).expect("a tolerance");
        assert_eq!(welder.weld(DVec3::ZERO, 0), (0, true));
        assert_eq!(welder.weld(DVec3::new(-0.05, 0.05, 0.05), 0), (0, false), "over the sides of cells");
        assert_eq!(welder.weld(DVec3::new(0.0, 0.0, 0.15), 0), (1, true), "not through points in between");
        assert_eq!(welder.weld(DVec3::new(0.0, 0.0, 0.09), 0), (1, false), "the nearest");
        assert_eq!(welder.weld(DVec3::ZERO, 1), (2, true));
        assert_eq!(welder.weld(DVec3::NAN, 0), (3, true));
        assert_eq!(welder.weld(DVec3::NAN, 0), (4, true));
    }

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
