//! The eye: it circles around a point, or flies.

use std::fmt;
use std::str::FromStr;

use glam::{DQuat, DVec2, DVec3};
use osculate::{Camera, CameraError};
use osculate_cage::Bounds;

/// Steepest angle to the horizon, short of straight up or down.
const STEEPEST: f64 = 89.5 * std::f64::consts::PI / 180.0;
/// Angle of a drag over the height of the picture.
const ORBIT_ANGLE: f64 = std::f64::consts::PI;
/// Angle of a look over the height of the picture while flying.
const LOOK_ANGLE: f64 = 1.2;
/// Change of distance of one notch of the wheel.
const NOTCH: f64 = 0.88;

/// A camera as it is written on the command line, without its depth range: eye, point looked at, up, vertical angle of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// Where the eye is.
    pub eye: DVec3,
    /// What it looks at.
    pub at: DVec3,
    /// Roughly upwards.
    pub up: DVec3,
    /// Vertical angle of view in degrees.
    pub fovy: f64,
}

impl CameraPose {
    /// The camera for a cage in this box.
    ///
    /// # Errors
    /// If there is no direction to look in, or the angle is not between 0 and 180 degrees.
    pub fn camera(&self, bounds: Bounds) -> Result<Camera, CameraError> {
        Camera::look_at(self.eye, self.at, self.up, self.fovy.to_radians(), bounds)
    }
}

impl fmt::Display for CameraPose {
    /// What `--camera` takes, in the fewest digits that give the same camera again.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { eye, at, up, fovy } = self;
        let point = |p: &DVec3| format!("{},{},{}", p.x, p.y, p.z);
        write!(out, "{}:{}:{}:{fovy}", point(eye), point(at), point(up))
    }
}

/// A text that is no camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraPoseError {
    /// Numbers are missing, too many, or none.
    #[error("expected EYE:AT:UP:FOVY such as 3,2,4:0,0,0:0,1,0:45 (three times x,y,z, then degrees)")]
    Form,
    /// The numbers make no camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

impl FromStr for CameraPose {
    type Err = CameraPoseError;

    fn from_str(text: &str) -> Result<Self, CameraPoseError> {
        let parts: Vec<&str> = text.split(':').collect();
        let &[eye, at, up, fovy] = parts.as_slice() else { return Err(CameraPoseError::Form) };
        let point = |text| numbers::<3>(text).map(DVec3::from).ok_or(CameraPoseError::Form);
        let [fovy] = numbers::<1>(fovy).ok_or(CameraPoseError::Form)?;
        let pose = Self { eye: point(eye)?, at: point(at)?, up: point(up)?, fovy };
        pose.camera(Bounds::of(&[]))?;
        Ok(pose)
    }
}

/// `N` finite numbers with commas between, such as `0,1,0`.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    text.split(',').map(number).collect::<Option<Vec<f64>>>()?.try_into().ok()
}

/// The eye, given by the point that it circles around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Orbit {
    /// The point in the middle of the picture.
    pub(crate) at: DVec3,
    /// From the eye to that point.
    pub(crate) distance: f64,
    /// The axis that stays upright in the picture, of unit length.
    up: DVec3,
    /// Angle about that axis, from the direction of [`Self::axes`].
    yaw: f64,
    /// Angle over the horizon: positive if the eye looks down.
    pitch: f64,
    /// Vertical angle of view in radians.
    fovy: f64,
}

/// What a key moves the eye by while flying, in its own axes: right, up, forwards; each -1, 0 or 1.
pub(crate) type Thrust = DVec3;

impl Orbit {
    /// The whole box from its upper right front, as `render` shows it, further away where the picture is narrower than high.
    pub(crate) fn fit(bounds: Bounds, aspect: f64) -> Self {
        let camera = Camera::fit(bounds);
        let mut orbit = Self::looking(&CameraPose {
            eye: camera.eye,
            at: camera.at,
            up: camera.up,
            fovy: camera.fovy.to_degrees(),
        });
        orbit.fit_again(bounds, aspect);
        orbit
    }

    /// The orbit of a camera.
    pub(crate) fn looking(pose: &CameraPose) -> Self {
        let (up, forward) = (pose.up.normalize(), (pose.at - pose.eye).normalize());
        let [front, right] = axes(up);
        Self {
            at: pose.at,
            distance: pose.at.distance(pose.eye),
            up,
            yaw: forward.dot(right).atan2(forward.dot(front)),
            pitch: (-forward.dot(up)).clamp(-1.0, 1.0).asin().clamp(-STEEPEST, STEEPEST),
            fovy: pose.fovy.to_radians(),
        }
    }

    /// Moves the eye so that it sees a whole box, from the direction that it looks from.
    pub(crate) fn fit_again(&mut self, bounds: Bounds, aspect: f64) {
        let radius = if bounds.half_diagonal() > 0.0 { bounds.half_diagonal() } else { 1.0 };
        let across = ((self.fovy / 2.0).tan() * aspect.min(1.0)).atan();
        self.at = bounds.center();
        self.distance = radius / across.sin();
    }

    /// Where it looks.
    pub(crate) fn forward(&self) -> DVec3 {
        let [front, right] = axes(self.up);
        let level = self.yaw.cos() * front + self.yaw.sin() * right;
        (self.pitch.cos() * level - self.pitch.sin() * self.up).normalize()
    }

    fn right(&self) -> DVec3 {
        self.forward().cross(self.up).normalize()
    }

    /// Where the eye is.
    pub(crate) fn eye(&self) -> DVec3 {
        self.at - self.distance * self.forward()
    }

    /// Right, up and forwards as the picture has them.
    pub(crate) fn basis(&self) -> [DVec3; 3] {
        let (right, forward) = (self.right(), self.forward());
        [right, right.cross(forward), forward]
    }

    /// Circles by a drag, in parts of the picture's height, x to the right, y downwards.
    pub(crate) fn orbit(&mut self, drag: DVec2) {
        self.yaw = (self.yaw + ORBIT_ANGLE * drag.x).rem_euclid(std::f64::consts::TAU);
        self.pitch = (self.pitch + ORBIT_ANGLE * drag.y).clamp(-STEEPEST, STEEPEST);
    }

    /// Moves what is in the middle along with a drag.
    pub(crate) fn pan(&mut self, drag: DVec2) {
        let [right, up, _] = self.basis();
        let height = 2.0 * self.distance * (self.fovy / 2.0).tan();
        self.at += height * (drag.y * up - drag.x * right);
    }

    /// Comes closer by notches of the wheel.
    pub(crate) fn dolly(&mut self, notches: f64) {
        self.distance = (self.distance * NOTCH.powf(notches)).clamp(1e-200, 1e200);
    }

    /// Turns the head by a drag: the eye stays.
    pub(crate) fn look(&mut self, drag: DVec2) {
        let eye = self.eye();
        self.yaw = (self.yaw + LOOK_ANGLE * drag.x).rem_euclid(std::f64::consts::TAU);
        self.pitch = (self.pitch + LOOK_ANGLE * drag.y).clamp(-STEEPEST, STEEPEST);
        self.at = eye + self.distance * self.forward();
    }

    /// Flies: moves the eye by a length in its own directions.
    pub(crate) fn fly(&mut self, thrust: Thrust, length: f64) {
        let [right, up, forward] = self.basis();
        let direction = thrust.x * right + thrust.y * up + thrust.z * forward;
        self.at += length * direction.normalize_or_zero();
    }

    /// The pose, as the command line takes it.
    pub(crate) fn pose(&self) -> CameraPose {
        CameraPose { eye: self.eye(), at: self.at, up: self.up, fovy: self.fovy.to_degrees() }
    }

    /// The camera, its depth range around a box.
    ///
    /// # Errors
    /// If the eye is so far from the origin that it cannot be told from what it looks at.
    pub(crate) fn camera(&self, bounds: Bounds) -> Result<Camera, CameraError> {
        Camera::look_at(self.eye(), self.at, self.up, self.fovy, bounds)
    }

    /// Length of a pixel at a distance, in a picture of that height.
    pub(crate) fn pixel(&self, depth: f64, height: f64) -> f64 {
        2.0 * depth * (self.fovy / 2.0).tan() / height
    }

    /// Where a point is in a picture of that size, from its upper left corner in pixels, and how far in front of the eye; none if it
    /// is behind it.
    pub(crate) fn project(&self, p: DVec3, size: DVec2) -> Option<(DVec2, f64)> {
        let [right, up, forward] = self.basis();
        let from_eye = p - self.eye();
        let depth = from_eye.dot(forward);
        if depth <= 1e-9 * self.distance {
            return None;
        }
        let pixel = self.pixel(depth, size.y);
        Some((size / 2.0 + DVec2::new(from_eye.dot(right), -from_eye.dot(up)) / pixel, depth))
    }

    /// The direction from the eye through a place in a picture of that size, of unit length.
    pub(crate) fn ray(&self, place: DVec2, size: DVec2) -> DVec3 {
        let [right, up, forward] = self.basis();
        let offset = (place - size / 2.0) * self.pixel(1.0, size.y);
        (forward + offset.x * right - offset.y * up).normalize()
    }
}

/// Two unit vectors across an axis and each other: where yaw is 0 and a quarter turn.
fn axes(up: DVec3) -> [DVec3; 2] {
    // For the y axis: -z and x, so that yaw 0 looks as cameras do.
    let turn = if up.y < -0.999_999 {
        DQuat::from_rotation_x(std::f64::consts::PI)
    } else {
        DQuat::from_rotation_arc(DVec3::Y, up)
    };
    [turn * DVec3::NEG_Z, turn * DVec3::X]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds() -> Bounds {
        Bounds { min: DVec3::new(-1.0, 2.0, 3.0), max: DVec3::new(3.0, 4.0, 9.0) }
    }

    const SIZE: DVec2 = DVec2::new(800.0, 600.0);

    #[test]
    fn the_first_view_is_that_of_render() {
        let (orbit, camera) = (Orbit::fit(bounds(), 4.0 / 3.0), Camera::fit(bounds()));
        assert!(orbit.eye().distance(camera.eye) < 1e-9 && orbit.at.distance(camera.at) < 1e-9);
        assert!(orbit.camera(bounds()).is_ok());
        assert!(Orbit::fit(bounds(), 0.5).distance > 1.5 * orbit.distance, "narrow pictures need more room");
    }

    #[test]
    fn printed_cameras_come_back() {
        for text in ["3,2,4:0,0,0:0,1,0:45", "-100,0,2:10,0,2:0,0,1:30", "1,2,3:-4,5,0.25:0,-1,0:60"] {
            let pose: CameraPose = text.parse().unwrap();
            assert_eq!(pose.to_string(), text);
            let again: CameraPose = Orbit::looking(&pose).pose().to_string().parse().unwrap();
            assert!(again.eye.distance(pose.eye) < 1e-9 && again.at == pose.at, "{again}");
            assert!((again.fovy - pose.fovy).abs() < 1e-9);
        }
    }

    #[test]
    fn texts_that_are_no_cameras_are_refused() {
        for wrong in
            ["", "1,2,3", "1,2,3:0,0,0:0,1,0", "1,2:0,0,0:0,1,0:45", "0,5,0:0,0,0:0,1,0:45", "1,2,inf:0,0,0:0,1,0:45"]
        {
            assert!(wrong.parse::<CameraPose>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn circling_keeps_the_distance_and_never_turns_over() {
        let mut orbit = Orbit::fit(bounds(), 1.0);
        let before = orbit;
        for _ in 0..50 {
            orbit.orbit(DVec2::new(0.1, 0.3));
            assert!((orbit.eye().distance(orbit.at) - before.distance).abs() < 1e-9);
            let [right, up, forward] = orbit.basis();
            assert!(up.dot(DVec3::Y) > 0.0 && right.dot(DVec3::Y).abs() < 1e-12);
            assert!((right.cross(up) + forward).length() < 1e-12, "right-handed");
        }
        assert_eq!(orbit.at, before.at);
    }

    #[test]
    fn a_drag_to_the_right_shows_the_left_side() {
        let mut orbit = Orbit::looking(&"0,0,5:0,0,0:0,1,0:45".parse().unwrap());
        orbit.orbit(DVec2::new(0.1, 0.0));
        assert!(orbit.eye().x < 0.0);
        orbit.orbit(DVec2::new(-0.1, 0.1));
        assert!(orbit.eye().x.abs() < 1e-9 && orbit.eye().y > 0.0, "a drag downwards shows the top");
    }

    #[test]
    fn panned_points_stay_under_the_pointer() {
        let mut orbit = Orbit::fit(bounds(), 1.0);
        let (place, _) = orbit.project(orbit.at, SIZE).unwrap();
        assert!(place.distance(SIZE / 2.0) < 1e-9);
        let point = orbit.at;
        orbit.pan(DVec2::new(0.25, -0.1));
        let (place, _) = orbit.project(point, SIZE).unwrap();
        assert!(place.distance(SIZE / 2.0 + DVec2::new(150.0, -60.0)) < 1e-6, "{place}");
    }

    #[test]
    fn rays_go_through_what_is_seen_there() {
        let orbit = Orbit::fit(bounds(), 1.0);
        let place = DVec2::new(123.0, 456.0);
        let point = orbit.eye() + 7.0 * orbit.ray(place, SIZE);
        assert!(orbit.project(point, SIZE).unwrap().0.distance(place) < 1e-6);
        assert_eq!(orbit.project(orbit.eye() - orbit.forward(), SIZE), None, "behind the eye");
    }

    #[test]
    fn flying_moves_the_eye_and_looking_does_not() {
        let mut orbit = Orbit::fit(bounds(), 1.0);
        let (eye, forward) = (orbit.eye(), orbit.forward());
        orbit.fly(DVec3::new(0.0, 0.0, 1.0), 2.0);
        assert!(orbit.eye().distance(eye + 2.0 * forward) < 1e-9);
        let eye = orbit.eye();
        orbit.look(DVec2::new(0.2, 0.1));
        assert!(orbit.eye().distance(eye) < 1e-9 && orbit.forward().distance(forward) > 0.1);
    }
}
