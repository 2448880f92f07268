//! What a repair did.

use std::fmt;

use crate::Listed;

/// What [`repair`](crate::repair()) did. Elements are named by their index in the file, from 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RepairReport {
    /// Faces with fewer than three corners at different places, dropped.
    pub degenerate_faces: Listed<u32>,
    /// Faces that lost corners at the place of a neighbour, or that went there and back.
    pub shortened_faces: Listed<u32>,
    /// Faces with the corners of another, dropped.
    pub copied_faces: Listed<u32>,
    /// Faces that were turned over.
    pub flipped_faces: Listed<u32>,
    /// Edges with more than two faces, which were separated.
    pub crowded_edges: Listed<[u32; 2]>,
    /// Edges opened because a part has no inside and outside.
    pub opened_edges: Listed<[u32; 2]>,
    /// Vertices that became several.
    pub split_vertices: Listed<u32>,
    /// Vertices that became one with another.
    pub welded_vertices: Listed<u32>,
    /// Vertices without faces, dropped.
    pub unused_vertices: Listed<u32>,
    /// Creases, corners and holes whose elements are gone.
    pub dropped_tags: usize,
}

impl RepairReport {
    /// True if there was nothing to do.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Adds what a further pass did.
    pub(super) fn add(&mut self, other: Self) {
        self.degenerate_faces.append(other.degenerate_faces);
        self.shortened_faces.append(other.shortened_faces);
        self.copied_faces.append(other.copied_faces);
        self.flipped_faces.append(other.flipped_faces);
        self.crowded_edges.append(other.crowded_edges);
        self.opened_edges.append(other.opened_edges);
        self.split_vertices.append(other.split_vertices);
        self.welded_vertices.append(other.welded_vertices);
        self.unused_vertices.append(other.unused_vertices);
        self.dropped_tags += other.dropped_tags;
    }

    /// What was done, one phrase for each kind.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for (faces, noun, deed) in [
            (&self.degenerate_faces, "degenerate face", "dropped"),
            (&self.copied_faces, "copied face", "dropped"),
            (&self.shortened_faces, "face", "shortened to its distinct corners"),
            (&self.flipped_faces, "face", "turned over"),
        ] {
            push(&mut lines, faces, noun, deed);
        }
        let ends = |edges: &Listed<[u32; 2]>| edges.map(|[a, b]| format!("{a}-{b}"));
        push(&mut lines, &ends(&self.crowded_edges), "edge", "with more than two faces separated");
        push(&mut lines, &ends(&self.opened_edges), "edge", "opened, because its part is one-sided");
        push(&mut lines, &self.split_vertices, "vertex", "split");
        push(&mut lines, &self.welded_vertices, "vertex", "welded to another at its place");
        push(&mut lines, &self.unused_vertices, "unused vertex", "dropped");
        if self.dropped_tags > 0 {
            lines.push(format!("{} without its element dropped", crate::listed::plural(self.dropped_tags, "tag")));
        }
        lines
    }
}

fn push<T: fmt::Display>(lines: &mut Vec<String>, elements: &Listed<T>, noun: &str, deed: &str) {
    if !elements.is_empty() {
        lines.push(format!("{} {deed}: {elements}", elements.count(noun)));
    }
}

impl fmt::Display for RepairReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            f.write_str("nothing to repair")
        } else {
            write!(f, "repaired: {}", self.lines().join("; "))
        }
    }
}
