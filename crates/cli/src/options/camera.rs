//! The options of a picture's camera, shared by `render` and by adaptive tessellation.

use super::Size;
use crate::failure::Failure;
use clap::Args;
use glam::DVec3;
use osculate::Camera;
use osculate_cage::Bounds;
use std::str::FromStr;

/// Where the picture is taken from and how large it is.
#[derive(Args, Debug)]
#[command(next_help_heading = "Camera")]
pub(crate) struct CameraArgs {
    /// Size of the picture in pixels: each side from 1 to 16384, as far as the device has them.
    #[arg(long, value_name = "WxH", default_value = "1024x1024", allow_hyphen_values = true)]
    pub(crate) size: Size,

    /// Take the picture from EYE towards AT: three points or directions x,y,z in the units of the file, and the
    /// vertical angle of view in degrees.
    #[arg(long, value_name = "EYE:AT:UP:FOVY", allow_hyphen_values = true)]
    camera: Option<Stand>,

    /// Choose a camera that shows the whole cage, from the direction (1, 0.75, 1.5) with a vertical angle of 45
    /// degrees. This is the default. Pictures that are narrower than high may cut the cage off at the sides.
    #[arg(long, conflicts_with = "camera")]
    fit: bool,
}

impl CameraArgs {
    /// The camera that was asked for, for a cage with this box. `--fit` only spells out the default.
    pub(crate) fn camera(&self, bounds: Bounds) -> Result<Camera, Failure> {
        self.camera.map_or(Ok(Camera::fit(bounds)), |stand| stand.camera(bounds).map_err(Failure::usage))
    }
}

/// A camera without its depth range, which depends on the cage. Its picture exists: see [`Camera::look_at`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stand {
    eye: DVec3,
    at: DVec3,
    up: DVec3,
    fovy_degrees: f64,
}

impl Stand {
    fn camera(&self, bounds: Bounds) -> Result<Camera, String> {
        let Self { eye, at, up, fovy_degrees } = *self;
        Camera::look_at(eye, at, up, fovy_degrees.to_radians(), bounds).map_err(|error| error.to_string())
    }
}

impl FromStr for Stand {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let stand = parse(text)
            .ok_or("expected EYE:AT:UP:FOVY such as 3,2,4:0,0,0:0,1,0:45 (three times x,y,z, then degrees)")?;
        stand.camera(Bounds::of(&[])).map(|_| stand)
    }
}

fn parse(text: &str) -> Option<Stand> {
    let parts: Vec<&str> = text.split(':').collect();
    let &[eye, at, up, fovy] = parts.as_slice() else { return None };
    let point = |text| numbers::<3>(text).map(DVec3::from);
    let [fovy_degrees] = numbers::<1>(fovy)?;
    Some(Stand { eye: point(eye)?, at: point(at)?, up: point(up)?, fovy_degrees })
}

/// `N` finite numbers with commas between, such as `0,1,0`.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    text.split(',').map(number).collect::<Option<Vec<f64>>>()?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_finite_numbers_as_asked_for() {
        assert_eq!(numbers("1, -2,3e2"), Some([1.0, -2.0, 300.0]));
        for wrong in ["", "1,2", "1,2,3,4", "1,,3", "1,2,x", "1,2,nan", "1,2,inf"] {
            assert_eq!(numbers::<3>(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_given_camera_keeps_its_place_and_sees_the_whole_box() {
        let bounds = Bounds { min: DVec3::new(9.0, -2.0, 0.0), max: DVec3::new(11.0, 2.0, 4.0) };
        let stand: Stand = "-100,0,2:10,0,2:0,0,1:30".parse().unwrap();
        let camera = stand.camera(bounds).unwrap();
        assert_eq!((camera.eye, camera.up), (DVec3::new(-100.0, 0.0, 2.0), DVec3::Z));
        assert_eq!(camera.fovy, 30.0_f64.to_radians());
        assert!(camera.near < 110.0 - 3.0 && camera.far > 110.0 + 3.0);
    }

    #[test]
    fn cameras_without_a_picture_are_refused() {
        for wrong in [
            "",
            "1,2,3",
            "1,2,3:0,0,0:0,1,0",
            "1,2:0,0,0:0,1,0:45",
            "1,2,3:0,0,0:0,1,0:45:6",
            "1,2,3:1,2,3:0,1,0:45",
            "0,5,0:0,0,0:0,1,0:45",
            "1,2,3:0,0,0:0,0,0:45",
            "1,2,3:0,0,0:0,1,0:0",
            "1,2,3:0,0,0:0,1,0:180",
            "1,2,3:0,0,0:0,1,0:nan",
            "1,2,inf:0,0,0:0,1,0:45",
        ] {
            assert!(wrong.parse::<Stand>().is_err(), "{wrong}");
        }
    }
}
