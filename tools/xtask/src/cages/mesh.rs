//! The polygon mesh that generators build.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

/// A polygon mesh, faces counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    /// One position per vertex.
    pub(super) points: Vec<DVec3>,
    /// Vertices of each face.
    pub(super) faces: Vec<Vec<usize>>,
    /// Texture coordinates, if the cage has any.
    pub(super) uv: Option<Uv>,
    /// OBJ lines that follow the faces: the `t` tags of OpenSubdiv's regression shapes.
    pub(super) tags: Vec<&'static str>,
}

/// Face-varying texture coordinates.
#[derive(Clone, Debug, Default)]
pub(super) struct Uv {
    /// The distinct coordinates.
    pub(super) points: Vec<DVec2>,
    /// One index into `points` per corner, face by face as in [`Mesh::faces`].
    pub(super) faces: Vec<Vec<usize>>,
}

impl Mesh {
    /// A mesh without texture coordinates.
    pub(super) fn new(points: Vec<DVec3>, faces: Vec<Vec<usize>>) -> Self {
        Self { points, faces, uv: None, tags: Vec::new() }
    }

    /// Twice the area of a face as a vector along its normal (Newell's formula).
    pub(super) fn face_normal(&self, face: usize) -> DVec3 {
        corner_pairs(&self.faces[face]).map(|(a, b)| self.points[a].cross(self.points[b])).sum()
    }
}

/// The directed edges of a face: each corner's vertex with the next one's.
pub(super) fn corner_pairs(face: &[usize]) -> impl Iterator<Item = (usize, usize)> + Clone + '_ {
    (0..face.len()).map(|corner| (face[corner], face[(corner + 1) % face.len()]))
}

/// Gives every key one index, in the order of first use, and keeps what belongs to it.
pub(super) struct Welder<K, P> {
    index_of: BTreeMap<K, usize>,
    /// What belongs to each index.
    pub(super) points: Vec<P>,
}

impl<K: Ord, P> Welder<K, P> {
    /// A welder that knows no key.
    pub(super) fn new() -> Self {
        Self { index_of: BTreeMap::new(), points: Vec::new() }
    }

    /// The index of `key`; `point` is called when the key is new.
    pub(super) fn index(&mut self, key: K, point: impl FnOnce() -> P) -> usize {
        *self.index_of.entry(key).or_insert_with(|| {
            self.points.push(point());
            self.points.len() - 1
        })
    }
}
