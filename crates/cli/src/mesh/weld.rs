//! Joins the corners of triangles into shared vertices.

use super::{Mesh, MeshUv};
use glam::Vec3;
use osculate::{CageSpace, UvOrigin};
use std::collections::HashMap;
use std::hash::Hash;

/// A corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner<Key> {
    /// Equal keys are one vertex.
    pub(crate) key: Key,
    /// Where it is.
    pub(crate) position: Vec3,
    /// Its unit normal, or zero.
    pub(crate) normal: Vec3,
    /// Its texture coordinates; not looked at in meshes without.
    pub(crate) uv: [f32; 2],
}

/// Builds a [`Mesh`] from triangles whose corners carry keys: equal keys are one vertex, which has texture coordinates for
/// each side of a seam.
pub(crate) struct Welder<Key> {
    mesh: Mesh,
    vertices: HashMap<Key, u32>,
    uv: HashMap<(u32, [u32; 2]), u32>,
}

impl<Key: Hash + Eq> Welder<Key> {
    /// An empty mesh with positions in `space`, and with texture coordinates if `uv` says where their v begins.
    pub(crate) fn new(space: CageSpace, uv: Option<UvOrigin>) -> Self {
        let mesh = Mesh { uv: uv.map(MeshUv::empty), ..Mesh::empty(space) };
        Self { mesh, vertices: HashMap::new(), uv: HashMap::new() }
    }

    /// Adds a triangle. `None` when there are more vertices than fit 32 bits.
    pub(crate) fn push(&mut self, corners: [Corner<Key>; 3]) -> Option<()> {
        let uv = [0, 1, 2].map(|i| corners[i].uv);
        let mut triangle = [0; 3];
        for (index, corner) in triangle.iter_mut().zip(corners) {
            *index = self.vertex(corner)?;
        }
        self.mesh.triangles.push(triangle);
        let Some(mesh) = &mut self.mesh.uv else { return Some(()) };
        let mut texture = [0; 3];
        for (index, (&vertex, uv)) in texture.iter_mut().zip(triangle.iter().zip(uv)) {
            *index = texture_vertex(&mut self.uv, mesh, vertex, uv)?;
        }
        mesh.triangles.push(texture);
        Some(())
    }

    fn vertex(&mut self, Corner { key, position, normal, .. }: Corner<Key>) -> Option<u32> {
        let next = next_index(self.mesh.positions.len())?;
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

/// The index that an element after so many gets, if 32 bits hold it and those of the elements after it.
fn next_index(count: usize) -> Option<u32> {
    u32::try_from(count).ok().filter(|&next| next < u32::MAX)
}

/// The texture coordinates of a vertex, equal bits once.
fn texture_vertex(
    known: &mut HashMap<(u32, [u32; 2]), u32>,
    mesh: &mut MeshUv,
    vertex: u32,
    uv: [f32; 2],
) -> Option<u32> {
    let next = next_index(mesh.values.len())?;
    let index = *known.entry((vertex, uv.map(f32::to_bits))).or_insert(next);
    if index == next {
        mesh.values.push(uv);
        mesh.vertices.push(vertex);
    }
    Some(index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const SPACE: CageSpace = CageSpace { centre: DVec3::ONE, scale: 1.0 };

    fn corner(key: u8, position: Vec3, uv: [f32; 2]) -> Corner<u8> {
        Corner { key, position, normal: Vec3::Z, uv }
    }

    #[test]
    fn equal_keys_become_one_vertex() {
        let mut welder = Welder::new(SPACE, None);
        let corner = |key: u8| corner(key, Vec3::splat(f32::from(key)), [f32::from(key); 2]);
        welder.push([corner(0), corner(1), corner(2)]).unwrap();
        welder.push([corner(2), corner(1), corner(3)]).unwrap();
        let mesh = welder.finish();
        assert_eq!(mesh.space, SPACE);
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(mesh.positions[3], Vec3::splat(3.0));
        assert_eq!(mesh.uv, None);
    }

    #[test]
    fn a_vertex_on_a_seam_has_texture_coordinates_of_both_sides() {
        let mut welder = Welder::new(SPACE, Some(UvOrigin::Top));
        let corner = |key: u8, u| corner(key, Vec3::splat(f32::from(key)), [u, 0.0]);
        welder.push([corner(0, 0.0), corner(1, 0.1), corner(2, 0.2)]).unwrap();
        welder.push([corner(2, 0.2), corner(1, 0.7), corner(3, 0.2)]).unwrap();
        let mesh = welder.finish();
        assert_eq!(mesh.positions.len(), 4);
        let uv = mesh.uv.expect("texture coordinates");
        assert_eq!((uv.origin, uv.values.len()), (UvOrigin::Top, 5));
        assert_eq!(uv.triangles, [[0, 1, 2], [2, 3, 4]]);
        assert_eq!(uv.vertices, [0, 1, 2, 1, 3]);
    }

    #[test]
    fn touching_points_with_other_keys_stay_apart() {
        let mut welder = Welder::new(SPACE, None);
        let corner = |key: u8| corner(key, Vec3::ZERO, [0.0; 2]);
        welder.push([corner(0), corner(1), corner(2)]).unwrap();
        assert_eq!(welder.finish().positions.len(), 3);
    }
}
