//! Triangle meshes and the files they are written to.

pub(crate) mod glb;
pub(crate) mod obj;
pub(crate) mod ply;
pub(crate) mod soup;
pub(crate) mod stl;
mod weld;

use glam::{DVec3, Vec3};
use osculate::{CageSpace, UvOrigin};
pub(crate) use weld::{Corner, Welder};

/// Triangles over shared vertices, counter-clockwise seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mesh {
    /// The coordinates that positions are in.
    pub(crate) space: CageSpace,
    /// Positions in `space`.
    pub(crate) positions: Vec<Vec3>,
    /// Unit normals, or zero where there is none; one per position.
    pub(crate) normals: Vec<Vec3>,
    /// Three vertices per triangle.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Texture coordinates, if there are any.
    pub(crate) uv: Option<MeshUv>,
}

/// Texture coordinates of corners: a vertex on a seam has several.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MeshUv {
    /// Where v begins.
    pub(crate) origin: UvOrigin,
    /// Texture coordinates, those of each vertex once.
    pub(crate) values: Vec<[f32; 2]>,
    /// The vertex that each of them is of.
    pub(crate) vertices: Vec<u32>,
    /// Three of them per triangle.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl MeshUv {
    /// No texture coordinates.
    pub(crate) fn empty(origin: UvOrigin) -> Self {
        Self { origin, values: Vec::new(), vertices: Vec::new(), triangles: Vec::new() }
    }

    /// The texture coordinates where v begins at `origin`, without negative zeros.
    fn values_from(&self, origin: UvOrigin) -> impl Iterator<Item = [f32; 2]> {
        let turned = self.origin != origin;
        self.values.iter().map(move |&[u, v]| [u, if turned { 1.0 - v } else { v }].map(|x| x + 0.0))
    }
}

impl Mesh {
    /// A mesh without vertices.
    pub(crate) fn empty(space: CageSpace) -> Self {
        Self { space, positions: Vec::new(), normals: Vec::new(), triangles: Vec::new(), uv: None }
    }

    /// The position of a vertex in the units of the cage.
    fn position(&self, vertex: usize) -> DVec3 {
        object_space(&self.space, self.positions[vertex])
    }
}

/// A position in the units of the cage, without negative zeros.
fn object_space(space: &CageSpace, position: Vec3) -> DVec3 {
    space.leave(position) + DVec3::ZERO
}

/// The same numbers with +0 for -0: the sum of -0 and +0 is +0.
fn positive_zeros(v: Vec3) -> Vec3 {
    v + Vec3::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles with a common edge, away from the origin, with negative zeros.
    pub(super) fn square() -> Mesh {
        Mesh {
            space: CageSpace { centre: DVec3::new(10.0, 0.0, -3.0), scale: 0.5 },
            positions: [[0.0, -0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [-0.0, 0.75, 0.0]].map(Vec3::from).to_vec(),
            normals: vec![Vec3::new(-0.0, 0.0, 1.0); 4],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            uv: None,
        }
    }

    /// The same with a seam between the triangles.
    pub(super) fn mapped_square() -> Mesh {
        let uv = MeshUv {
            origin: UvOrigin::Bottom,
            values: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.75], [0.5, 0.0], [0.5, 0.75], [-0.0, 1.0]],
            vertices: vec![0, 1, 2, 0, 2, 3],
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        };
        Mesh { uv: Some(uv), ..square() }
    }

    #[test]
    fn no_negative_zero_is_written() {
        let space = CageSpace { centre: DVec3::new(-0.0, 1.0, -0.0), scale: 2.0 };
        let position = object_space(&space, Vec3::new(-0.0, -2.0, 0.0));
        assert!(position.to_array().iter().all(|x| x.to_bits() == 0), "{position:?}");
        assert!(positive_zeros(Vec3::splat(-0.0)).to_array().iter().all(|x| x.to_bits() == 0));
    }
}
