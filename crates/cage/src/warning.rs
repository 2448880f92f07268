//! What was odd about a file but did not keep it from being read.

use crate::listed::plural;
use crate::{Listed, PolygonReport, RepairReport};

/// Something the reader ignored, dropped or made up; the cage is valid all the same.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// Vertices without faces were dropped; the indices are those of the file, from 0.
    #[error("{} dropped: {vertices}{}", .vertices.count("unused vertex"), with_corners(*.corners))]
    UnusedVertices {
        /// The vertices.
        vertices: Listed<u32>,
        /// Corner tags that went with them.
        corners: usize,
    },
    /// Tags that are kept but change nothing yet.
    #[error("tags not evaluated yet are ignored: {}", .0.join(", "))]
    TagsNotEvaluated(Vec<String>),
    /// Statements of an OBJ file that mean nothing to a cage.
    #[error("{} ignored: {name} ({reason}), first in line {line}", plural(*.statements, "statement"))]
    Statement {
        /// The first word of the statement.
        name: String,
        /// Why it is ignored.
        reason: &'static str,
        /// How often it occurs.
        statements: usize,
        /// The line of its first occurrence.
        line: u32,
    },
    /// Faces with corners without uv in a file where others have it; these corners got (0, 0).
    #[error("{} without uv, set to (0, 0)", plural(*.0, "face"))]
    MissingUv(usize),
    /// Elements of a PLY file that mean nothing to a cage.
    #[error("{count} of the element {name} ignored, which is not part of a cage")]
    Element {
        /// Their kind.
        name: String,
        /// How many there are.
        count: u64,
    },
    /// Creases that were made from the shape of the cage.
    #[error("{} made{}", plural(*.made, "crease"), already(*.tagged))]
    CreasesMade {
        /// How many there are.
        made: usize,
        /// How many edges had a tag already.
        tagged: usize,
    },
    /// Creases were to be made from something that the file does not have.
    #[error("no creases made from {0}, because the file has none")]
    NoCreasesFrom(&'static str),
    /// What a repair did before the mesh was checked.
    #[error("{0}")]
    Repaired(Box<RepairReport>),
    /// Parts of a glTF scene that mean nothing to a cage yet.
    #[error("{} ignored", plural(*.count, .what))]
    NotRead {
        /// What is ignored.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// Triangles of a glTF scene with two corners at one place were dropped.
    #[error("{} with two corners at one place dropped", plural(*.0, "triangle"))]
    DegenerateTriangles(usize),
    /// Vertices of a glTF scene at the place of others that move differently; welded, they would be torn.
    #[error("{} at the place of another that moves differently, not welded", plural(*.0, "vertex"))]
    MoveApart(usize),
    /// Polygons of a glTF file that were guessed, or triangles that may have been polygons.
    #[error("{0}")]
    Polygons(PolygonReport),
    /// The polygons that were found in a glTF scene are no manifold mesh, but its triangles are.
    #[error("polygons found among the triangles are not used, because together they are not manifold")]
    PolygonsNotUsed,
    /// The nodes of a glTF scene touch in a way that is no manifold, so they were not welded to each other.
    #[error("{} welded each by itself, because together they are not manifold", plural(*.0, "node"))]
    WeldedByNode(usize),
    /// Meshes of a USD file whose rules at boundaries, seams or triangles differ from those of the first mesh, which hold for all.
    #[error("{counted} with other rules (interpolateBoundary, faceVaryingLinearInterpolation, triangleSubdivisionRule) than the first, which hold for all: {0}", counted = .0.count("mesh"))]
    UsdRules(Listed<String>),
    /// Meshes of a USD file that are not meant to be smoothed by Catmull and Clark's scheme.
    #[error("{counted} with another subdivisionScheme than catmullClark, smoothed all the same: {0}", counted = .0.count("mesh"))]
    UsdSchemes(Listed<String>),
}

fn already(tagged: usize) -> String {
    if tagged == 0 { String::new() } else { format!(" ({} had a tag already)", plural(tagged, "edge")) }
}

fn with_corners(corners: usize) -> String {
    if corners == 0 { String::new() } else { format!(" (and {} there)", plural(corners, "corner tag")) }
}
