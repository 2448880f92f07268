//! Where the surface is looked at from.

use glam::dcamera::rh;
use glam::{DMat4, DQuat, DVec3};
use osculate_cage::Bounds;

use crate::CageSpace;

/// A perspective camera in the cage's own coordinates, right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: DVec3,
    /// What it looks at.
    pub at: DVec3,
    /// Roughly upwards.
    pub up: DVec3,
    /// Vertical field of view in radians.
    pub fovy: f64,
    /// Nearest distance shown.
    pub near: f64,
    /// Farthest distance shown.
    pub far: f64,
}

/// Why a camera cannot look.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// Eye and target coincide, or a number is not finite.
    #[error("the camera's eye {0} and target {1} must be two different points")]
    NoDirection(DVec3, DVec3),
    /// The up vector is parallel to the view direction.
    #[error("the camera's up vector {0} is zero or parallel to the view direction")]
    NoUp(DVec3),
    /// The field of view is out of range.
    #[error("the field of view of {0} degrees is not between 0 and 180")]
    FieldOfView(f64),
}

impl Camera {
    /// The camera that shows a whole box from its upper right front: 45 degrees, along (1, 0.75, 1.5).
    pub fn fit(bounds: Bounds) -> Self {
        let radius = if bounds.half_diagonal() > 0.0 { bounds.half_diagonal() } else { 1.0 };
        let fovy = 45f64.to_radians();
        let distance = radius / (fovy / 2.0).sin();
        let eye = bounds.center() + distance * DVec3::new(1.0, 0.75, 1.5).normalize();
        let near = (distance - 1.2 * radius).max(0.01 * distance);
        Self { eye, at: bounds.center(), up: DVec3::Y, fovy, near, far: distance + 1.2 * radius }
    }

    /// A camera at `eye` that looks at `at`, its near and far planes around a box.
    ///
    /// # Errors
    /// If there is no direction to look in, or `fovy` (radians) is not between 0 and pi.
    pub fn look_at(eye: DVec3, at: DVec3, up: DVec3, fovy: f64, bounds: Bounds) -> Result<Self, CameraError> {
        if !(eye.is_finite() && at.is_finite() && (at - eye).length() > 0.0) {
            return Err(CameraError::NoDirection(eye, at));
        }
        let sine = (at - eye).normalize().cross(up.normalize_or_zero()).length();
        if sine.is_nan() || sine <= 1e-9 {
            return Err(CameraError::NoUp(up));
        }
        if !(fovy > 0.0 && fovy < std::f64::consts::PI) {
            return Err(CameraError::FieldOfView(fovy.to_degrees()));
        }
        let radius = if bounds.half_diagonal() > 0.0 { bounds.half_diagonal() } else { 1.0 };
        let distance = (bounds.center() - eye).length();
        let near = (distance - 1.2 * radius).max(0.01 * distance.max(radius));
        Ok(Self { eye, at, up, fovy, near, far: (distance + 1.2 * radius).max(2.0 * near) })
    }

    /// The same camera, its near and far planes moved apart as far as it takes to show a box too: where an animated cage goes.
    #[must_use]
    pub fn reaching(self, bounds: Bounds) -> Self {
        let (radius, distance) = (bounds.half_diagonal(), (bounds.center() - self.eye).length());
        // Depths are told apart the worse the nearer the near plane is.
        let nearest = 0.01 * (self.at - self.eye).length();
        let near = self.near.min((distance - 1.2 * radius).max(nearest));
        Self { near, far: self.far.max(distance + 1.2 * radius), ..self }
    }

    /// The views of a full turn about what is looked at, this one first: `count` of them, about the up axis, coming to half the distance in the middle
    /// and back. Near and far planes are set around a box.
    #[must_use]
    pub fn orbit(&self, count: u32, bounds: Bounds) -> Vec<Self> {
        let view = |i: u32| {
            let turn = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            let sight = DQuat::from_axis_angle(self.up.normalize(), turn) * (self.eye - self.at);
            let nearness = 0.75 + 0.25 * turn.cos();
            Self { eye: self.at + nearness * sight, ..*self }.reaching(bounds)
        };
        (0..count).map(view).collect()
    }

    /// View space from cage space.
    pub(crate) fn view(&self, space: &CageSpace) -> DMat4 {
        // In cage space, where lengths are near one whatever the size of the cage.
        let (eye, at) = (space.enter_exactly(self.eye), space.enter_exactly(self.at));
        rh::view::look_to_mat4(eye, (at - eye).normalize(), self.up.normalize())
    }

    /// Clip space from cage space: y down, depth 0 to 1, as Vulkan has it.
    pub(crate) fn clip(&self, space: &CageSpace, aspect: f64) -> DMat4 {
        let (near, far) = (self.near * space.scale, self.far * space.scale);
        rh::proj::vulkan::perspective(self.fovy, aspect, near, far) * self.view(space)
    }

    /// Pixels that a length spans at unit distance, in a picture of that height.
    pub(crate) fn pixels_per_length(&self, height: u32) -> f64 {
        f64::from(height) / (2.0 * (self.fovy / 2.0).tan())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reaching_camera_shows_more_and_looks_the_same() {
        let camera = Camera::fit(bounds());
        assert!((camera.reaching(bounds()).near - camera.near).abs() < 1e-12);
        let far = Bounds { min: DVec3::splat(-60.0), max: DVec3::splat(-50.0) };
        let reaching = camera.reaching(far);
        assert!(reaching.near == camera.near && reaching.far > (camera.eye - far.min).length());
        let around = camera.reaching(Bounds { min: DVec3::splat(-99.0), max: DVec3::splat(99.0) });
        assert!(around.near > 0.0 && around.near < camera.near && around.far > 99.0);
        assert_eq!(Camera { near: camera.near, far: camera.far, ..around }, camera);
    }

    #[test]
    fn an_orbit_starts_here_and_comes_nearer_on_the_far_side() {
        let camera = Camera::fit(bounds());
        let views = camera.orbit(4, bounds());
        assert_eq!(views.len(), 4);
        assert!((views[0].eye - camera.eye).length() < 1e-9 && views.iter().all(|view| view.at == camera.at));
        let (there, here) = (views[2].eye - camera.at, camera.eye - camera.at);
        assert!((there.length() - 0.5 * here.length()).abs() < 1e-9);
        assert!((there - DVec3::new(-0.5, 0.5, -0.5) * here).length() < 1e-9, "half a turn about the up axis");
        assert!(views.iter().all(|view| view.near > 0.0 && view.near < view.far));
    }

    fn bounds() -> Bounds {
        Bounds { min: DVec3::new(-1.0, 2.0, 3.0), max: DVec3::new(3.0, 4.0, 9.0) }
    }

    #[test]
    fn the_fitted_box_is_inside_the_picture() {
        let camera = Camera::fit(bounds());
        let space = CageSpace::new(bounds());
        let clip = camera.clip(&space, 1.0);
        for corner in 0..8 {
            let pick = |i: usize| if corner >> i & 1 == 0 { bounds().min[i] } else { bounds().max[i] };
            let p = clip.project_point3(space.enter_exactly(DVec3::new(pick(0), pick(1), pick(2))));
            assert!(p.x.abs() < 1.0 && p.y.abs() < 1.0 && (0.0..1.0).contains(&p.z), "{p}");
        }
        let centre = clip.project_point3(DVec3::ZERO);
        assert!(centre.x.abs() < 1e-9 && centre.y.abs() < 1e-9);
        // Up is up: y points down in the picture.
        assert!(clip.project_point3(DVec3::new(0.0, 0.1, 0.0)).y < 0.0);
    }

    #[test]
    fn cameras_without_direction_are_refused() {
        let look = |eye: DVec3, at: DVec3, up: DVec3, fovy: f64| Camera::look_at(eye, at, up, fovy, bounds());
        assert!(matches!(look(DVec3::ONE, DVec3::ONE, DVec3::Y, 1.0), Err(CameraError::NoDirection(..))));
        assert!(matches!(look(DVec3::ZERO, DVec3::Y, DVec3::Y, 1.0), Err(CameraError::NoUp(..))));
        assert!(matches!(look(DVec3::ZERO, DVec3::X, DVec3::Y, 4.0), Err(CameraError::FieldOfView(..))));
        assert!(matches!(look(DVec3::NAN, DVec3::X, DVec3::Y, 1.0), Err(CameraError::NoDirection(..))));
        assert!(look(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0).is_ok());
    }
}
