//! The axis-aligned box of a set of points.

use glam::DVec3;

/// An axis-aligned box in the units of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: DVec3,
    /// The largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The smallest box around `points`; the empty set gives a box of size zero at the origin.
    #[must_use]
    pub fn of(points: &[DVec3]) -> Self {
        let Some(&first) = points.first() else {
            return Self { min: DVec3::ZERO, max: DVec3::ZERO };
        };
        points.iter().fold(Self { min: first, max: first }, |b, &p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The centre of the box. Halves are added, so that no finite box overflows.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Half the length of the diagonal: the radius of the sphere around the box.
    #[must_use]
    pub fn half_diagonal(&self) -> f64 {
        let half = self.max * 0.5 - self.min * 0.5;
        // Squares of very large or very small sides would overflow or vanish.
        half.x.hypot(half.y).hypot(half.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_of_points() {
        let b = Bounds::of(&[DVec3::new(1.0, -2.0, 3.0), DVec3::new(-3.0, 2.0, 3.0), DVec3::ZERO]);
        assert_eq!(b.min, DVec3::new(-3.0, -2.0, 0.0));
        assert_eq!(b.max, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(b.center(), DVec3::new(-1.0, 0.0, 1.5));
        assert!((b.half_diagonal() - 10.25_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn extreme_sizes() {
        for scale in [1e-300, 1e300] {
            let b = Bounds::of(&[DVec3::ZERO, DVec3::new(6.0, 8.0, 0.0) * scale]);
            assert!((b.half_diagonal() / scale - 5.0).abs() < 1e-12, "{scale}");
        }
        assert!(Bounds::of(&[DVec3::MIN, DVec3::MAX]).center().is_finite());
    }

    #[test]
    fn box_of_nothing_is_a_point() {
        assert_eq!(Bounds::of(&[]).half_diagonal(), 0.0);
    }
}
