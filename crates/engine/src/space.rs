//! The coordinates that the device computes in.

use glam::{DVec3, Vec3};
use osculate_cage::Bounds;

/// Cage space: relative to the centre of the cage's box, scaled by a power of two to a half diagonal between 1/2 and 1. Both are applied in f64, and
/// scaling by a power of two is exact, so cages far from the origin and very small or large ones lose nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CageSpace {
    /// Centre of the cage's box.
    pub centre: DVec3,
    /// Cage space units per unit, a power of two.
    pub scale: f64,
}

impl CageSpace {
    /// The space of a cage with these bounds.
    pub fn new(bounds: Bounds) -> Self {
        let half_diagonal = bounds.half_diagonal();
        // Exponents near the ends of the range of f64 stop where the scale and its reciprocal are normal numbers.
        let exponent = (-half_diagonal.log2().ceil()).clamp(-1000.0, 1000.0);
        let scale = if half_diagonal > 0.0 { exponent.exp2() } else { 1.0 };
        Self { centre: bounds.center(), scale }
    }

    /// A point in cage space.
    pub fn enter(&self, p: DVec3) -> Vec3 {
        self.enter_exactly(p).as_vec3()
    }

    /// A point in cage space, not rounded to f32.
    pub fn enter_exactly(&self, p: DVec3) -> DVec3 {
        (p - self.centre) * self.scale
    }

    /// A point of cage space in the cage's own coordinates.
    pub fn leave(&self, p: Vec3) -> DVec3 {
        p.as_dvec3() / self.scale + self.centre
    }

    /// A vector of cage space in the cage's own coordinates.
    pub fn leave_vector(&self, v: Vec3) -> DVec3 {
        v.as_dvec3() / self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_size_maps_near_one_by_a_power_of_two() {
        for size in [1e-30, 1e-3, 0.7, 1.0, 1.0001, 1e5] {
            let bounds = Bounds { min: DVec3::splat(-size), max: DVec3::splat(size) };
            let space = CageSpace::new(bounds);
            let half = space.enter_exactly(bounds.max).length();
            assert!(half > 0.499 && half <= 1.0 + 1e-12, "{size}: {half}");
            assert_eq!(space.scale.log2().fract(), 0.0);
            assert!((space.leave(space.enter(bounds.max)) - bounds.max).length() < 1e-6 * size);
        }
    }

    #[test]
    fn a_point_has_a_space_too() {
        let bounds = Bounds { min: DVec3::ONE, max: DVec3::ONE };
        assert_eq!(CageSpace::new(bounds).enter(DVec3::ONE), Vec3::ZERO);
    }
}
