//! Triangle meshes and the files they are written to.

pub(crate) mod glb;
pub(crate) mod obj;
pub(crate) mod ply;
pub(crate) mod soup;
pub(crate) mod stl;
mod weld;

use glam::{DVec3, Vec3};
pub(crate) use weld::Welder;

/// Triangles over shared vertices, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mesh {
    /// What the positions are relative to, in the units of the cage.
    pub(crate) center: DVec3,
    /// Positions less `center`.
    pub(crate) positions: Vec<Vec3>,
    /// Unit normals, or zero where there is none; one per position.
    pub(crate) normals: Vec<Vec3>,
    /// Three vertices per triangle.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The position of a vertex in the units of the cage.
    fn position(&self, vertex: usize) -> DVec3 {
        object_space(self.center, self.positions[vertex])
    }
}

/// A position relative to `center` in the units of the cage, without negative zeros.
fn object_space(center: DVec3, position: Vec3) -> DVec3 {
    center + position.as_dvec3() + DVec3::ZERO
}

/// The same numbers with +0 for -0: the sum of zeros of either sign is +0.
fn positive_zeros(v: Vec3) -> Vec3 {
    v + Vec3::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles with a common edge, away from the origin, with negative zeros.
    pub(super) fn square() -> Mesh {
        Mesh {
            center: DVec3::new(10.0, 0.0, -3.0),
            positions: vec![Vec3::new(0.0, -0.0, 0.0), Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::new(-0.0, 1.5, 0.0)],
            normals: vec![Vec3::new(-0.0, 0.0, 1.0); 4],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    #[test]
    fn no_negative_zero_is_written() {
        let position = object_space(DVec3::new(-0.0, 1.0, -0.0), Vec3::new(-0.0, -1.0, 0.0));
        assert!(position.to_array().iter().all(|x| x.to_bits() == 0), "{position:?}");
        assert!(positive_zeros(Vec3::splat(-0.0)).to_array().iter().all(|x| x.to_bits() == 0));
    }
}
