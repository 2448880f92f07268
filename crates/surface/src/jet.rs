//! A surface point with its derivatives, and the normal and curvature that follow from them.

use glam::DVec3;

/// Position and partial derivatives of a surface at one (u, v), in model units per unit of parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// The point.
    pub position: DVec3,
    /// First derivative along u.
    pub du: DVec3,
    /// First derivative along v.
    pub dv: DVec3,
    /// Second derivative along u.
    pub duu: DVec3,
    /// Mixed derivative.
    pub duv: DVec3,
    /// Second derivative along v.
    pub dvv: DVec3,
}

/// Curvatures of a surface at a point, in one over model units; positive mean curvature bends towards the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    /// Product of the principal curvatures.
    pub gaussian: f64,
    /// Mean of the principal curvatures.
    pub mean: f64,
}

impl Curvature {
    /// The principal curvatures, larger first.
    pub fn principal(self) -> [f64; 2] {
        let half_gap = (self.mean * self.mean - self.gaussian).max(0.0).sqrt();
        [self.mean + half_gap, self.mean - half_gap]
    }
}

impl Jet {
    /// The unit normal `du x dv`, or `None` where the derivatives are parallel or zero.
    pub fn normal(&self) -> Option<DVec3> {
        self.du.cross(self.dv).try_normalize()
    }

    /// Gaussian and mean curvature from the two fundamental forms (do Carmo, *Differential Geometry of Curves and
    /// Surfaces*, section 3-3), or `None` where there is no normal.
    pub fn curvature(&self) -> Option<Curvature> {
        let normal = self.normal()?;
        let (e, f, g) = (self.du.dot(self.du), self.du.dot(self.dv), self.dv.dot(self.dv));
        let (l, m, n) = (self.duu.dot(normal), self.duv.dot(normal), self.dvv.dot(normal));
        let area = e * g - f * f;
        Some(Curvature { gaussian: (l * n - m * m) / area, mean: (e * n - 2.0 * f * m + g * l) / (2.0 * area) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cylinder_bends_in_one_direction_only() {
        // (2 sin u, v, 2 cos u) at u = 0, skewed by v -> v + u: radius 2, bending away from the normal.
        let jet =
            Jet { du: DVec3::new(2.0, 1.0, 0.0), dv: DVec3::Y, duu: DVec3::new(0.0, 0.0, -2.0), ..Jet::default() };
        let curvature = jet.curvature().expect("regular point");
        assert!(curvature.gaussian.abs() < 1e-15 && (curvature.mean + 0.25).abs() < 1e-15);
        assert_eq!(curvature.principal().map(|k| (k * 1e12).round() / 1e12), [0.0, -0.5]);
    }

    #[test]
    fn parallel_derivatives_have_no_normal() {
        let jet = Jet { du: DVec3::X, dv: DVec3::X * 2.0, ..Jet::default() };
        assert_eq!((jet.normal(), jet.curvature()), (None, None));
    }
}
