//! Parts of cages: some faces of a cage with what their surface depends on, as a cage of its own.
//!
//! The surface of a face depends on the faces that share a vertex with it, and what a face shares with its neighbours, the curve of an edge say, may be
//! computed from any of those. So a part is its **own** faces and two rings of faces around them: the first ring for what is shared, the second for what the
//! first depends on. What is computed of the own faces and the first ring is then what it is in the whole cage, operand by operand, because a part keeps
//! everything that decides about operands and their order: the order of the faces and the order of the corners of each, positions, tags, and the box.
//! What lies on the outer border of the second ring looks like a boundary and is none; nothing that is used depends on it.

mod divide;
mod halo;
mod tags;

pub use divide::divide;

use crate::{Cage, FaceVarying, Topology};

/// Some faces of a cage and the rings around them, as a cage.
#[derive(Clone, Debug)]
pub struct CagePart {
    cage: Cage,
    /// The ring of each face: 0 for own faces.
    rings: Vec<u8>,
    /// Face in the whole cage of each face, rising.
    faces: Vec<u32>,
    /// First half-edge in the whole cage of each face.
    first_half_edges: Vec<u32>,
    /// Vertex in the whole cage of each vertex.
    vertices: Vec<u32>,
    is_of_quads: bool,
    is_of_quads_and_triangles: bool,
}

impl CagePart {
    /// The rings that a part needs.
    pub const RINGS: u8 = 2;

    /// Cuts faces out of a cage, with as many rings of faces around them: [`Self::RINGS`], unless one wants to know what fewer do. A ring is all faces that
    /// share a vertex with those before it. Takes time for the size of the whole cage's face list, and memory for it while it runs.
    ///
    /// Groups, materials, rigs and warnings stay behind.
    ///
    /// # Panics
    /// If a face does not exist.
    #[must_use]
    pub fn cut(cage: &Cage, own: &[u32], rings: u8) -> Self {
        let halo::Halo { faces, rings, numbers } = halo::Halo::grow(cage.topology(), own, rings);
        let (topology, vertices) = cage.topology.restricted(&faces, &numbers);
        let first_half_edges = faces.iter().map(|&f| cage.topology.face_half_edges(f).start).collect();
        let tags = tags::restricted(cage, &topology, &numbers);
        let cage_part = Cage {
            positions: vertices.iter().map(|&v| cage.positions[v as usize]).collect(),
            source_vertices: vertices.iter().map(|&v| cage.source_vertices[v as usize]).collect(),
            source_faces: faces.iter().map(|&f| cage.source_face(f)).collect(),
            uv: cage.uv.as_ref().map(|uv| restricted_uv(uv, &cage.topology, &faces)),
            topology,
            tags,
            face_sets: Vec::new(),
            appearance: None,
            rig: None,
            polygons: None,
            warnings: Vec::new(),
            // That of the whole, so that coordinates are relative to the same point.
            bounds: cage.bounds,
        };
        let sizes = |most: usize| cage.face_offsets().windows(2).all(|pair| (pair[1] - pair[0]) as usize <= most);
        Self {
            cage: cage_part,
            rings,
            faces,
            first_half_edges,
            vertices,
            is_of_quads: cage.is_quads(),
            is_of_quads_and_triangles: sizes(4),
        }
    }

    /// The part as a cage. Its box is that of the whole cage.
    #[must_use]
    pub fn cage(&self) -> &Cage {
        &self.cage
    }

    /// The ring that a face of the part is in: 0 for own faces.
    #[must_use]
    pub fn ring(&self, face: u32) -> u8 {
        self.rings[face as usize]
    }

    /// Whether a face belongs to the part itself.
    #[must_use]
    pub fn is_own(&self, face: u32) -> bool {
        self.ring(face) == 0
    }

    /// The faces in the whole cage, rising.
    #[must_use]
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// The vertex in the whole cage of each vertex. A vertex whose faces in the part do not form one fan stands here once for each.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// The half-edge in the whole cage of a half-edge of the part.
    #[must_use]
    pub fn whole_half_edge(&self, h: u32) -> u32 {
        let face = self.cage.topology.face(h);
        self.first_half_edges[face as usize] + (h - self.cage.topology.face_half_edges(face).start)
    }

    /// Whether all faces of the whole cage are quads.
    #[must_use]
    pub fn is_of_quads(&self) -> bool {
        self.is_of_quads
    }

    /// Whether all faces of the whole cage are quads or triangles.
    #[must_use]
    pub fn is_of_quads_and_triangles(&self) -> bool {
        self.is_of_quads_and_triangles
    }
}

/// The values of some faces' corners.
fn restricted_uv(uv: &FaceVarying, topology: &Topology, faces: &[u32]) -> FaceVarying {
    let corners = faces.iter().flat_map(|&f| topology.face_half_edges(f));
    let mut indices: Vec<u32> = corners.map(|h| uv.indices[h as usize]).collect();
    let mut used = indices.clone();
    used.sort_unstable();
    used.dedup();
    indices.iter_mut().for_each(|i| *i = used.partition_point(|old| old < i) as u32);
    FaceVarying { values: used.iter().map(|&i| uv.values[i as usize]).collect(), indices }
}

#[cfg(test)]
mod tests;
