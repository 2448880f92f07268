//! The shape of a face.

use glam::DVec3;

use crate::Cage;

/// A face is thin if it is this many times longer than wide.
pub(super) const THIN: f64 = 100.0;
/// Area below this part of the squared perimeter is rounding.
const NO_AREA: f64 = 1e-12;

/// Area and perimeter of a face, in units of the cage's size so that squares neither overflow nor vanish.
pub(super) struct Shape {
    area: f64,
    perimeter: f64,
}

impl Shape {
    pub(super) fn of(cage: &Cage, face: u32) -> Self {
        let size = cage.bounds().half_diagonal();
        let corners = cage.face(face as usize);
        let first = cage.positions()[corners[0] as usize];
        let corner = |i: usize| (cage.positions()[corners[i % corners.len()] as usize] - first) / size;
        let (mut normal, mut perimeter) = (DVec3::ZERO, 0.0);
        for i in 0..corners.len() {
            let (a, b) = (corner(i), corner(i + 1));
            normal += a.cross(b);
            perimeter += a.distance(b);
        }
        Self { area: 0.5 * normal.length(), perimeter }
    }

    pub(super) fn is_flat(&self) -> bool {
        self.area <= NO_AREA * self.perimeter * self.perimeter
    }

    /// A rectangle of sides 1 and r has (half the perimeter)^2 / area = r + 2 + 1/r.
    pub(super) fn is_thin(&self) -> bool {
        0.25 * self.perimeter * self.perimeter > (THIN + 2.0) * self.area
    }
}
