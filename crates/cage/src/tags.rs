//! The subdivision tags of a cage: what OpenSubdiv's `t` lines say about creases, corners, holes and boundaries.

use crate::Topology;
use crate::listed::{numbered, plural};

/// How the surface meets the boundary of the cage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BoundaryRule {
    /// Boundary edges are sharp, and so are vertices with a single face: the surface passes through them.
    #[default]
    EdgeAndCorner,
    /// Boundary edges are sharp; vertices with a single face are smoothed like the rest of the boundary.
    EdgeOnly,
    /// Faces that touch the boundary are not drawn.
    None,
}

/// How the sharpness of a crease falls from level to level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CreaseMethod {
    /// By one per level.
    #[default]
    Normal,
    /// Averaged along the crease (Chaikin).
    Chaikin,
}

/// A sharp or semi-sharp edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// The end points of the edge, in the order of the file.
    pub vertices: [u32; 2],
    /// Sharpness, at least 0; from 10 on the edge is infinitely sharp.
    pub sharpness: f32,
}

/// A sharp or semi-sharp vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The vertex.
    pub vertex: u32,
    /// Sharpness, at least 0; from 10 on the vertex is infinitely sharp.
    pub sharpness: f32,
}

/// All tags of a cage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tags {
    /// Creases, in the order of the file.
    pub creases: Vec<Crease>,
    /// Corners, in the order of the file.
    pub corners: Vec<Corner>,
    /// Faces that are part of the topology but not of the surface, in the order of the file.
    pub holes: Vec<u32>,
    /// The boundary rule, if the file names one.
    pub boundary: Option<BoundaryRule>,
    /// The rule for boundaries of face-varying data, 0 to 5: none, corners only, corners plus 1, corners plus 2, boundaries, all.
    pub face_varying_boundary: Option<u8>,
    /// How creases soften.
    pub crease_method: CreaseMethod,
    /// True if triangles get their own smoother weights.
    pub smooth_triangles: bool,
}

/// A tag that does not fit its cage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TagError {
    /// A crease between vertices that no edge joins.
    #[error("crease {index} is between vertices {} and {}, but no edge joins them", .vertices[0], .vertices[1])]
    NoSuchEdge {
        /// The crease.
        index: usize,
        /// Its vertices.
        vertices: [u32; 2],
    },
    /// A corner at a vertex that does not exist.
    #[error("corner {index} is at vertex {vertex}, but {}", numbered(*.vertices, "vertex"))]
    NoSuchVertex {
        /// The corner.
        index: usize,
        /// Its vertex.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A hole in a face that does not exist.
    #[error("hole {index} is face {face}, but {}", numbered(*.faces, "face"))]
    NoSuchFace {
        /// The hole.
        index: usize,
        /// Its face.
        face: u32,
        /// How many faces there are.
        faces: usize,
    },
    /// A sharpness below 0 or not a number.
    #[error("{tag} {index} has sharpness {sharpness}, but sharpness is at least 0")]
    Sharpness {
        /// `crease` or `corner`.
        tag: &'static str,
        /// The crease or corner.
        index: usize,
        /// Its sharpness.
        sharpness: f32,
    },
    /// A rule for face-varying boundaries beyond 5.
    #[error("the face-varying boundary rule is {0}, but the rules are 0 to 5")]
    FaceVaryingBoundary(u8),
}

impl Tags {
    /// Checks every tag against the mesh it belongs to.
    pub(crate) fn check(&self, topology: &Topology) -> Result<(), TagError> {
        for (index, crease) in self.creases.iter().enumerate() {
            check_sharpness("crease", index, crease.sharpness)?;
            let [a, b] = crease.vertices;
            let exists = |v: u32| (v as usize) < topology.vertex_count();
            if !(exists(a) && exists(b) && topology.find_edge(a, b).is_some()) {
                return Err(TagError::NoSuchEdge { index, vertices: crease.vertices });
            }
        }
        for (index, &Corner { vertex, sharpness }) in self.corners.iter().enumerate() {
            check_sharpness("corner", index, sharpness)?;
            let vertices = topology.vertex_count();
            if vertex as usize >= vertices {
                return Err(TagError::NoSuchVertex { index, vertex, vertices });
            }
        }
        let faces = topology.face_count();
        if let Some((index, &face)) = self.holes.iter().enumerate().find(|&(_, &face)| face as usize >= faces) {
            return Err(TagError::NoSuchFace { index, face, faces });
        }
        match self.face_varying_boundary {
            Some(rule) if rule > 5 => Err(TagError::FaceVaryingBoundary(rule)),
            _ => Ok(()),
        }
    }

    /// Renumbers vertices after some were dropped: `kept[new]` is the old index, in rising order. Corners of dropped vertices go with them.
    pub(crate) fn renumber_vertices(&mut self, kept: &[u32]) {
        // Creases name edges that exist, so their vertices were kept.
        let renumbered = |old: u32| kept.binary_search(&old).ok().map(|new| new as u32);
        for crease in &mut self.creases {
            crease.vertices = crease.vertices.map(|v| renumbered(v).unwrap_or(v));
        }
        self.corners.retain_mut(|corner| {
            let new = renumbered(corner.vertex);
            corner.vertex = new.unwrap_or(corner.vertex);
            new.is_some()
        });
    }

    /// The tags that no evaluator knows yet, in words; empty if there are none.
    pub(crate) fn not_evaluated(&self) -> Vec<String> {
        let mut found = Vec::new();
        if !self.creases.is_empty() {
            found.push(plural(self.creases.len(), "crease"));
        }
        if !self.corners.is_empty() {
            found.push(plural(self.corners.len(), "corner"));
        }
        if self.crease_method == CreaseMethod::Chaikin {
            found.push("creasemethod chaikin".into());
        }
        if let Some(rule) = self.face_varying_boundary {
            found.push(format!("facevaryinginterpolateboundary {rule}"));
        }
        if self.smooth_triangles {
            found.push("smoothtriangles".into());
        }
        found
    }
}

fn check_sharpness(tag: &'static str, index: usize, sharpness: f32) -> Result<(), TagError> {
    if sharpness >= 0.0 { Ok(()) } else { Err(TagError::Sharpness { tag, index, sharpness }) }
}
