//! Joins the corners of triangles into shared vertices.

use super::Mesh;
use glam::Vec3;
use osculate::CageSpace;
use std::collections::HashMap;
use std::hash::Hash;

/// Builds a [`Mesh`] from triangles whose corners carry keys: equal keys are one vertex.
pub(crate) struct Welder<Key> {
    mesh: Mesh,
    vertices: HashMap<Key, u32>,
}

impl<Key: Hash + Eq> Welder<Key> {
    /// An empty mesh with positions in `space`.
    pub(crate) fn new(space: CageSpace) -> Self {
        Self { mesh: Mesh::empty(space), vertices: HashMap::new() }
    }

    /// Adds a triangle: key, position and normal per corner. `None` when there are more vertices than fit 32 bits.
    pub(crate) fn push(&mut self, corners: [(Key, Vec3, Vec3); 3]) -> Option<()> {
        let mut triangle = [0; 3];
        for (index, (key, position, normal)) in triangle.iter_mut().zip(corners) {
            *index = self.vertex(key, position, normal)?;
        }
        self.mesh.triangles.push(triangle);
        Some(())
    }

    fn vertex(&mut self, key: Key, position: Vec3, normal: Vec3) -> Option<u32> {
        let next = u32::try_from(self.mesh.positions.len()).ok().filter(|&next| next < u32::MAX)?;
        let vertex = *self.vertices.entry(key).or_insert(next);
        if vertex == next {
            self.mesh.positions.push(position);
            self.mesh.normals.push(normal);
        }
        Some(vertex)
    }

    /// The mesh so far.
    pub(crate) fn finish(self) -> Mesh {
        self.mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const SPACE: CageSpace = CageSpace { centre: DVec3::ONE, scale: 1.0 };

    #[test]
    fn equal_keys_become_one_vertex() {
        let mut welder = Welder::new(SPACE);
        let corner = |key: u8| (key, Vec3::splat(f32::from(key)), Vec3::Z);
        welder.push([corner(0), corner(1), corner(2)]).unwrap();
        welder.push([corner(2), corner(1), corner(3)]).unwrap();
        let mesh = welder.finish();
        assert_eq!(mesh.space, SPACE);
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(mesh.positions[3], Vec3::splat(3.0));
    }

    #[test]
    fn touching_points_with_other_keys_stay_apart() {
        let mut welder = Welder::new(SPACE);
        let corner = |key: u8| (key, Vec3::ZERO, Vec3::Z);
        welder.push([corner(0), corner(1), corner(2)]).unwrap();
        assert_eq!(welder.finish().positions.len(), 3);
    }
}
