//! How far single precision may be from the exact surface.

use glam::DVec3;
use osculate::{Cage, Place, Surface};
use osculate_surface::reference::Reference;
use osculate_tests::exact::Pair;

/// Largest error of a position, as a part of the diagonal of the cage's box.
const POSITION: f64 = 1e-6;

/// Largest error of a unit normal where faces are large: the length of the difference.
const NORMAL: f64 = 1e-5;

/// Points of the last refined mesh are rounded to about half an eps of their coordinates, and this turns faces the more the smaller they are: errors of normals
/// in eps times the largest coordinate over the size of the face.
const TURN: f64 = 4.0;

/// The same for vertices of more than 64 edges. A face of 200 at a vertex is a wedge of less than two degrees, and towards its tip there are hundreds of waves
/// that fade hardly slower than the one that spans the tangent plane, so that the sums of their rounding errors grow; 4.04 was measured at valence 200,
/// where normals were off by up to 5.8e-5.
const TURN_OF_MANY: f64 = 8.0;

/// Valences up to here are held to [`TURN`].
const MANY: u32 = 64;

/// Largest error of a derivative, as a part of the box and of the longer derivative: towards vertices of more than four edges derivatives grow.
const DERIVATIVE: [f64; 2] = [1e-6, 1e-5];

/// Largest coordinate of a cage in cage space.
pub(super) fn largest_coordinate(cage: &Cage, surface: &Surface) -> f64 {
    let coordinates = cage.positions().iter().map(|&p| surface.space().enter_exactly(p).abs().max_element());
    coordinates.fold(0.0, f64::max)
}

/// Judges points of one surface.
pub(super) struct Judge<'a> {
    name: String,
    surface: &'a Surface,
    exact: &'a Reference<'a>,
    /// Diagonal of the box and largest coordinate, in cage space.
    box_size: f64,
    largest: f64,
}

impl<'a> Judge<'a> {
    /// A judge of a cage's surface against its exact one; `name` goes into messages.
    pub(super) fn new(name: String, cage: &Cage, surface: &'a Surface, exact: &'a Reference<'a>) -> Self {
        Self {
            name,
            surface,
            exact,
            box_size: 2.0 * cage.bounds().half_diagonal() * surface.space().scale,
            largest: largest_coordinate(cage, surface),
        }
    }

    /// Least height of a patch at its corners, in cage space.
    pub(super) fn face_size(&self, patch: u32) -> f64 {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|uv| {
            let Place { sub_face: face, st: [s, t], .. } = self.surface.place(patch, uv);
            self.surface.space().enter_exactly(self.exact.eval(face.face as usize, face.sub, s, t).unwrap().position)
        });
        let height = |i: usize| {
            let (a, b) = (corners[(i + 1) % 4] - corners[i], corners[(i + 3) % 4] - corners[i]);
            a.cross(b).length() / a.length().max(b.length()).max(f64::MIN_POSITIVE)
        };
        (0..4).map(height).fold(f64::INFINITY, f64::min)
    }

    /// What is wrong with a point of the device, if it is further from the exact surface than it may be.
    pub(super) fn judge(&self, pair: &Pair, face_size: f64) -> Result<(), String> {
        let Pair { request, device, exact, .. } = pair;
        let record = &self.surface.plan().patches[request.patch_id as usize];
        let name = || format!("{}, {:?} of valence {}, {request:?}", self.name, record.kind(), record.valence());
        let within = |what: &str, error: f64, allowed: f64| {
            // Not a number is off, too.
            if error < allowed {
                Ok(())
            } else {
                Err(format!("{}: {what} off by {error:e}, allowed {allowed:e}", name()))
            }
        };
        within("position is", (device.position - exact.position).length(), POSITION * self.box_size)?;
        if !pair.irregular {
            let error = (device.du - exact.du).length().max((device.dv - exact.dv).length());
            let length = exact.du.length().max(exact.dv.length());
            within("derivatives are", error, DERIVATIVE[0] * self.box_size + DERIVATIVE[1] * length)?;
        }
        if exact.normal == DVec3::ZERO {
            return Ok(());
        }
        let turn = if record.valence() > MANY { TURN_OF_MANY } else { TURN };
        let allowed = NORMAL + turn * f64::from(f32::EPSILON) * self.largest / face_size;
        within("normal is", (device.normal - exact.normal).length(), allowed)
    }
}
