//! Views by matrices, and what follows from them for a surface that stands somewhere in a world.

use glam::dcamera::rh;
use glam::{DAffine3, DMat4, DVec3, DVec4};

use crate::{CageSpace, Camera, EngineError};

/// A view of a world, as a renderer has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// View space from the world: a rotation and a translation. The eye is at the origin and looks along -z.
    pub view_from_world: DMat4,
    /// Clip space from view space, as Vulkan has it: depth from 0 to 1, or from 1 to 0, or to infinity. May be parallel, off its axis, or jittered.
    pub clip_from_view: DMat4,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
}

impl View {
    /// What a camera in the world sees.
    pub fn of(camera: &Camera, size: [u32; 2]) -> Self {
        let direction = (camera.at - camera.eye).normalize();
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        Self {
            view_from_world: rh::view::look_to_mat4(camera.eye, direction, camera.up.normalize()),
            clip_from_view: rh::proj::vulkan::perspective(camera.fovy, aspect, camera.near, camera.far),
            size,
        }
    }

    /// Whether things get smaller with distance.
    fn is_perspective(&self) -> bool {
        let last = self.clip_from_view.row(3);
        last.truncate().truncate() == DVec3::ZERO.truncate() && last.z < 0.0 && last.w == 0.0
    }

    /// The nearest distance shown, be it at depth 0 or 1.
    fn near(&self) -> f64 {
        let (slope, offset) = (self.clip_from_view.z_axis.z, self.clip_from_view.w_axis.z);
        let w = -self.clip_from_view.z_axis.w;
        let planes = [offset / slope, offset / (w + slope)].into_iter().filter(|near| near.is_finite() && *near > 0.0);
        planes.reduce(f64::min).unwrap_or(0.0)
    }

    fn is_finite(&self) -> bool {
        self.view_from_world.is_finite()
            && self.clip_from_view.is_finite()
            && self.size.iter().all(|&pixels| pixels > 0)
    }
}

/// A surface that stands in a world, and a view of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    pub(crate) world_from_own: DAffine3,
    pub(crate) view: View,
}

/// What must hold of a placement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Demands {
    /// Lengths are measured: adaptive factors.
    pub(crate) lengths: bool,
    /// There is an eye: adaptive factors, and backs that are left out.
    pub(crate) eye: bool,
}

/// How far axes may be from being equally long and at right angles.
const UNEVEN: f64 = 1e-6;

impl Placement {
    /// Fails if it cannot be drawn, or not as demanded.
    pub(crate) fn check(&self, demands: Demands) -> Result<(), EngineError> {
        let refuse = |reason: &str| Err(EngineError::Placement { reason: reason.to_owned() });
        if !(self.world_from_own.is_finite() && self.view.is_finite()) {
            return refuse("a matrix is not finite, or the picture has no pixels");
        }
        if self.world_from_own.matrix3.determinant() <= 0.0 {
            return refuse("the transform mirrors the surface or flattens it: outside and inside would be exchanged");
        }
        if demands.lengths && self.uneven() > UNEVEN {
            return refuse(
                "adaptive factors need a transform that scales all directions alike; choose a uniform level",
            );
        }
        if demands.eye && !self.view.is_perspective() {
            return refuse(
                "adaptive factors and culled backs need a perspective; choose a uniform level and keep backs",
            );
        }
        Ok(())
    }

    /// How far the transform is from scaling all directions alike, relative to the scale.
    fn uneven(&self) -> f64 {
        let axes = self.world_from_own.matrix3;
        let gram = axes.transpose() * axes;
        let square = self.scale() * self.scale();
        let deviation = |i: usize, j: usize| (gram.col(i)[j] / square - if i == j { 1.0 } else { 0.0 }).abs();
        (0..9).map(|at| deviation(at / 3, at % 3)).fold(0.0, f64::max)
    }

    fn scale(&self) -> f64 {
        self.world_from_own.matrix3.determinant().abs().cbrt()
    }

    /// The eye as a camera in the surface's own coordinates. Its planes and its outline in the picture are those of the view only as far as factors
    /// need them.
    pub(crate) fn camera(&self) -> Camera {
        let world = self.view.view_from_world.inverse();
        let own = self.world_from_own.inverse();
        let direction = |v: DVec3| own.transform_vector3(world.transform_vector3(v));
        let eye = own.transform_point3(world.transform_point3(DVec3::ZERO));
        let near = self.view.near() / self.scale();
        let fovy = 2.0 * (-self.view.clip_from_view.z_axis.w / self.view.clip_from_view.y_axis.y.abs()).atan();
        Camera { eye, at: eye + direction(DVec3::NEG_Z), up: direction(DVec3::Y), fovy, near, far: 2.0 * near }
    }

    /// World, view and clip space from cage space.
    pub(crate) fn matrices(&self, space: &CageSpace) -> [DMat4; 3] {
        let world = DMat4::from(self.world_from_own) * space.leaving();
        let view = self.view.view_from_world * world;
        [world, view, self.view.clip_from_view * view]
    }
}

impl CageSpace {
    /// The cage's own coordinates from cage space.
    pub(crate) fn leaving(&self) -> DMat4 {
        let unit = 1.0 / self.scale;
        DMat4::from_cols(
            DVec4::new(unit, 0.0, 0.0, 0.0),
            DVec4::new(0.0, unit, 0.0, 0.0),
            DVec4::new(0.0, 0.0, unit, 0.0),
            self.centre.extend(1.0),
        )
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use osculate_cage::Bounds;

    use super::*;

    const SIZE: [u32; 2] = [640, 480];
    const ALL: Demands = Demands { lengths: true, eye: true };

    fn bounds() -> Bounds {
        Bounds { min: DVec3::new(-1.0, 2.0, 3.0), max: DVec3::new(3.0, 4.0, 9.0) }
    }

    fn placed(scale: f64) -> Placement {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
        let world_from_own =
            DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, DVec3::new(9.0, -4.0, 2.5));
        Placement { world_from_own, view: View::of(&Camera::fit(bounds()), SIZE) }
    }

    /// A camera that moves with the surface sees what the matrices show.
    #[test]
    fn the_camera_of_a_placement_is_where_the_matrices_say() {
        let (space, placement) = (CageSpace::new(bounds()), placed(2.5));
        let camera = placement.camera();
        let camera = Camera { far: camera.near * 7.0, ..camera };
        let [world, _, clip] = placement.matrices(&space);
        let points = [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.5), DVec3::new(-0.6, 0.1, 0.2)];
        for p in points {
            let (found, expected) = (camera.clip(&space, 4.0 / 3.0) * p.extend(1.0), clip * p.extend(1.0));
            let (found, expected) = (found / found.w, expected / expected.w);
            assert!((found - expected).truncate().truncate().length() < 1e-9, "{found} {expected}");
            let own = p / space.scale + space.centre;
            assert!((world.transform_point3(p) - placement.world_from_own.transform_point3(own)).length() < 1e-9);
        }
        assert!((camera.near * 2.5 - Camera::fit(bounds()).near).abs() < 1e-9);
        assert!((camera.fovy - Camera::fit(bounds()).fovy).abs() < 1e-12);
    }

    #[test]
    fn the_nearest_distance_is_read_from_any_projection() {
        let near = |clip_from_view| View { clip_from_view, ..placed(1.0).view }.near();
        let plain = rh::proj::vulkan::perspective(0.8, 1.5, 0.25, 90.0);
        assert!((near(plain) - 0.25).abs() < 1e-12);
        // Depths turned round: z' = w - z.
        let turn =
            DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0, 0.0), DVec4::new(0.0, 0.0, 1.0, 1.0));
        assert!((near(turn * plain) - 0.25).abs() < 1e-12);
        let mut endless = plain;
        (endless.z_axis.z, endless.w_axis.z) = (0.0, 0.25);
        assert!((near(endless) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn placements_that_cannot_be_drawn_are_refused() {
        assert!(placed(3.0).check(ALL).is_ok());
        let none = Demands { lengths: false, eye: false };
        let uneven = DAffine3::from_scale(DVec3::new(1.0, 1.0, 1.1)) * placed(1.0).world_from_own;
        let uneven = Placement { world_from_own: uneven, ..placed(1.0) };
        assert!(uneven.check(none).is_ok());
        let reason = |placement: Placement, demands| placement.check(demands).unwrap_err().to_string();
        assert!(reason(uneven, ALL).contains("all directions alike"));
        let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        assert!(reason(Placement { world_from_own: mirror, ..uneven }, none).contains("mirrors"));
        let parallel = rh::proj::vulkan::orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 9.0);
        let parallel = Placement { view: View { clip_from_view: parallel, ..uneven.view }, ..placed(1.0) };
        assert!(parallel.check(none).is_ok());
        assert!(reason(parallel, ALL).contains("perspective"));
        let nowhere = DAffine3::from_translation(DVec3::NAN);
        assert!(reason(Placement { world_from_own: nowhere, ..uneven }, none).contains("not finite"));
    }
}
