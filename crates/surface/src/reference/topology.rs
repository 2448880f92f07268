//! Half-edges of a mesh. A half-edge is a face corner: half-edge `h` runs from its vertex to the
//! next vertex of the face, with the face on its left.

use std::collections::HashMap;

use super::{Mesh, MeshError};

/// Who is across each half-edge. Built only for valid meshes, so walking around a vertex always
/// ends.
#[derive(Debug)]
pub(super) struct Topology {
    faces: Vec<u32>,
    twins: Vec<Option<u32>>,
}

/// The half-edges that leave a vertex, counter-clockwise.
#[derive(Debug)]
pub(super) struct Fan {
    /// Half-edges out of the vertex, one per face. At a boundary the first has no twin.
    pub(super) outgoing: Vec<u32>,
    /// Whether the faces go all the way round.
    pub(super) closed: bool,
    /// Index in `outgoing` of the half-edge that was asked for.
    pub(super) core: usize,
}

impl Topology {
    /// The half-edges of `mesh`.
    ///
    /// # Errors
    /// If the mesh is not valid.
    pub(super) fn new(mesh: &Mesh) -> Result<Self, MeshError> {
        check_arrays(mesh)?;
        let mut faces = Vec::with_capacity(mesh.face_vertices.len());
        for (face, ring) in mesh.faces().enumerate() {
            check_face(mesh, face, ring)?;
            faces.extend(std::iter::repeat_n(face as u32, ring.len()));
        }
        let mut topology = Self { twins: vec![None; faces.len()], faces };
        topology.pair_up(mesh)?;
        topology.check_fans(mesh)?;
        Ok(topology)
    }

    fn pair_up(&mut self, mesh: &Mesh) -> Result<(), MeshError> {
        let mut by_ends = HashMap::with_capacity(self.faces.len());
        for half_edge in 0..self.faces.len() as u32 {
            let (from, to) = self.ends(mesh, half_edge);
            if let Some(first) = by_ends.insert((from, to), half_edge) {
                return Err(MeshError::EdgeUsedTwice {
                    first: self.face(first),
                    second: self.face(half_edge),
                    from,
                    to,
                });
            }
        }
        for (&(from, to), &half_edge) in &by_ends {
            self.twins[half_edge as usize] = by_ends.get(&(to, from)).copied();
        }
        Ok(())
    }

    /// Every vertex must be reached by one walk over all of its faces.
    fn check_fans(&self, mesh: &Mesh) -> Result<(), MeshError> {
        let mut corners = vec![0usize; mesh.positions.len()];
        for &vertex in &mesh.face_vertices {
            corners[vertex as usize] += 1;
        }
        for (half_edge, &vertex) in (0..).zip(&mesh.face_vertices) {
            let unseen = std::mem::take(&mut corners[vertex as usize]);
            if unseen > 0 && self.fan(mesh, half_edge).outgoing.len() != unseen {
                return Err(MeshError::SeveralFans { vertex });
            }
        }
        Ok(())
    }

    /// The face on the left of a half-edge.
    pub(super) fn face(&self, half_edge: u32) -> usize {
        self.faces[half_edge as usize] as usize
    }

    /// The half-edge across a half-edge's edge, `None` at the boundary.
    pub(super) fn twin(&self, half_edge: u32) -> Option<u32> {
        self.twins[half_edge as usize]
    }

    /// The first half-edge of the face and its number of sides.
    fn loop_of(&self, mesh: &Mesh, half_edge: u32) -> (u32, u32) {
        let face = self.face(half_edge);
        (mesh.face_offsets[face], mesh.face_offsets[face + 1] - mesh.face_offsets[face])
    }

    fn next(&self, mesh: &Mesh, half_edge: u32) -> u32 {
        let (first, sides) = self.loop_of(mesh, half_edge);
        first + (half_edge - first + 1) % sides
    }

    /// The half-edge before this one in its face.
    pub(super) fn previous(&self, mesh: &Mesh, half_edge: u32) -> u32 {
        let (first, sides) = self.loop_of(mesh, half_edge);
        first + (half_edge - first + sides - 1) % sides
    }

    /// The vertices that a half-edge runs from and to.
    pub(super) fn ends(&self, mesh: &Mesh, half_edge: u32) -> (u32, u32) {
        (mesh.face_vertices[half_edge as usize], mesh.face_vertices[self.next(mesh, half_edge) as usize])
    }

    fn clockwise(&self, mesh: &Mesh, half_edge: u32) -> Option<u32> {
        self.twin(half_edge).map(|twin| self.next(mesh, twin))
    }

    fn counter_clockwise(&self, mesh: &Mesh, half_edge: u32) -> Option<u32> {
        self.twin(self.previous(mesh, half_edge))
    }

    /// All half-edges out of the vertex that `half_edge` leaves.
    pub(super) fn fan(&self, mesh: &Mesh, half_edge: u32) -> Fan {
        let walk = |step: &dyn Fn(u32) -> Option<u32>| {
            std::iter::successors(step(half_edge), |&h| step(h)).take_while(|&h| h != half_edge).collect::<Vec<_>>()
        };
        let ahead = walk(&|h| self.counter_clockwise(mesh, h));
        let last = ahead.last().copied().unwrap_or(half_edge);
        if self.counter_clockwise(mesh, last) == Some(half_edge) {
            return Fan { outgoing: [vec![half_edge], ahead].concat(), closed: true, core: 0 };
        }
        let mut behind = walk(&|h| self.clockwise(mesh, h));
        behind.reverse();
        Fan { core: behind.len(), outgoing: [behind, vec![half_edge], ahead].concat(), closed: false }
    }
}

fn check_arrays(mesh: &Mesh) -> Result<(), MeshError> {
    let face_vertices = mesh.face_vertices.len();
    let offsets = &mesh.face_offsets;
    let wrong = |entry| MeshError::Offsets { entry, face_vertices };
    if offsets.first() != Some(&0) {
        return Err(wrong(0));
    }
    if let Some(entry) = (1..offsets.len()).find(|&i| offsets[i] < offsets[i - 1]) {
        return Err(wrong(entry));
    }
    if offsets[offsets.len() - 1] as usize != face_vertices {
        return Err(wrong(offsets.len() - 1));
    }
    match mesh.positions.iter().position(|point| !point.is_finite()) {
        Some(vertex) => Err(MeshError::NotFinite { vertex }),
        None => Ok(()),
    }
}

fn check_face(mesh: &Mesh, face: usize, ring: &[u32]) -> Result<(), MeshError> {
    if ring.len() < 3 {
        return Err(MeshError::FaceTooSmall { face, sides: ring.len() });
    }
    let vertices = mesh.positions.len();
    if let Some(&vertex) = ring.iter().find(|&&vertex| vertex as usize >= vertices) {
        return Err(MeshError::VertexOutOfRange { face, vertex, vertices });
    }
    let mut sorted = ring.to_vec();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(MeshError::RepeatedVertex { face, vertex: pair[0] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn mesh(vertices: usize, faces: &[&[u32]]) -> Mesh {
        Mesh::from_faces((0..vertices).map(|i| DVec3::splat(i as f64)).collect(), faces)
    }

    #[test]
    fn accepts_unused_vertices_open_fans_and_valence_two() {
        assert_eq!(mesh(5, &[&[0, 1, 2, 3]]).validate(), Ok(()));
        assert_eq!(mesh(4, &[&[0, 1, 2], &[0, 2, 3]]).validate(), Ok(()));
        assert_eq!(mesh(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]).validate(), Ok(()));
    }

    #[test]
    fn names_the_defect() {
        let cases = [
            (mesh(3, &[&[0, 1]]), "face 0 has 2 vertices"),
            (mesh(3, &[&[0, 1, 3]]), "face 0 uses vertex 3, but the mesh has only 3"),
            (mesh(4, &[&[0, 1, 2], &[0, 2, 0]]), "face 1 uses vertex 0 more than once"),
            (mesh(4, &[&[0, 1, 2], &[0, 1, 3]]), "faces 0 and 1 both run from vertex 0 to vertex 1"),
            (mesh(5, &[&[0, 1, 2], &[0, 3, 4]]), "vertex 0 form more than one fan"),
            (Mesh { face_offsets: vec![0, 2], ..mesh(3, &[&[0, 1, 2]]) }, "entry 1 does not"),
            (Mesh { face_offsets: vec![0, 3, 2, 3], ..mesh(3, &[&[0, 1, 2]]) }, "entry 2 does not"),
            (Mesh { face_offsets: vec![], ..mesh(3, &[&[0, 1, 2]]) }, "entry 0 does not"),
            (Mesh { positions: vec![DVec3::NAN; 3], ..mesh(3, &[&[0, 1, 2]]) }, "vertex 0 has a coordinate"),
        ];
        for (mesh, expected) in cases {
            let message = mesh.validate().expect_err(expected).to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn fans_of_two_closed_surfaces_sharing_a_vertex_are_refused() {
        let tetrahedra: &[&[u32]] =
            &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 1], &[1, 3, 2], &[0, 4, 5], &[0, 5, 6], &[0, 6, 4], &[4, 6, 5]];
        assert_eq!(mesh(7, tetrahedra).validate(), Err(MeshError::SeveralFans { vertex: 0 }));
    }
}
