//! The mesh that the reference evaluates, and what can be wrong with it.

use glam::DVec3;

use super::topology::Topology;

/// A polygon mesh: manifold, consistently wound, every face with three or more distinct vertices.
/// [`Mesh::validate`] says whether it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// One point per vertex. Vertices that no face uses are allowed and ignored.
    pub positions: Vec<DVec3>,
    /// Start of each face in `face_vertices`, and after the last face the total: one more entry
    /// than faces, the first is 0.
    pub face_offsets: Vec<u32>,
    /// The vertices of all faces, counter-clockwise seen from outside.
    pub face_vertices: Vec<u32>,
}

/// Why a mesh has no limit surface.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// `face_offsets` does not cut `face_vertices` into faces.
    #[error(
        "face offsets must start at 0, never decrease and end at the number of face vertices, {face_vertices}; entry {entry} does not"
    )]
    Offsets {
        /// Index into `face_offsets`.
        entry: usize,
        /// Length of `face_vertices`.
        face_vertices: usize,
    },
    /// A face with fewer than three vertices.
    #[error("face {face} has {sides} vertices; it needs at least 3")]
    FaceTooSmall {
        /// The face.
        face: usize,
        /// Its number of vertices.
        sides: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but the mesh has only {vertices} vertices")]
    VertexOutOfRange {
        /// The face.
        face: usize,
        /// The missing vertex.
        vertex: u32,
        /// Number of vertices of the mesh.
        vertices: usize,
    },
    /// A face meets the same vertex twice.
    #[error("face {face} uses vertex {vertex} more than once")]
    RepeatedVertex {
        /// The face.
        face: usize,
        /// The repeated vertex.
        vertex: u32,
    },
    /// Two faces run along an edge in the same direction.
    #[error(
        "faces {first} and {second} both run from vertex {from} to vertex {to}; the edge is non-manifold or the faces are wound differently"
    )]
    EdgeUsedTwice {
        /// The face that came first.
        first: usize,
        /// The other face.
        second: usize,
        /// Start of the directed edge.
        from: u32,
        /// End of the directed edge.
        to: u32,
    },
    /// The faces around a vertex fall apart into several fans (a bow-tie).
    #[error("the faces around vertex {vertex} form more than one fan; split the vertex")]
    SeveralFans {
        /// The vertex.
        vertex: u32,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
}

impl Mesh {
    /// A mesh from points and a list of faces.
    pub fn from_faces<F: AsRef<[u32]>>(positions: Vec<DVec3>, faces: impl IntoIterator<Item = F>) -> Self {
        let mut mesh = Self { positions, face_offsets: vec![0], face_vertices: Vec::new() };
        for face in faces {
            mesh.face_vertices.extend_from_slice(face.as_ref());
            mesh.face_offsets.push(mesh.face_vertices.len() as u32);
        }
        mesh
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.face_offsets.len().saturating_sub(1)
    }

    /// The vertices of face `face`, counter-clockwise.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.face_vertices[self.face_offsets[face] as usize..self.face_offsets[face + 1] as usize]
    }

    /// All faces in order.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.face_count()).map(|face| self.face(face))
    }

    /// Whether the mesh has a limit surface.
    ///
    /// # Errors
    /// The first defect found.
    pub fn validate(&self) -> Result<(), MeshError> {
        Topology::new(self).map(|_| ())
    }
}
