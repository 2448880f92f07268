//! Faces without corners at the same place as the next.

use super::report::RepairReport;
use crate::CageDesc;
use crate::progress::{Cancelled, Watch};

/// The faces that are kept, as rows of corners. A half-edge is a corner here, as in a topology, and runs to the next of its row.
pub(super) struct Loops {
    /// The rows.
    pub(super) offsets: Vec<u32>,
    /// The corner of the description that each corner here was.
    pub(super) corners: Vec<u32>,
    /// The vertex of each corner.
    pub(super) vertices: Vec<u32>,
    /// The place of each corner.
    pub(super) places: Vec<u32>,
    /// The face of each corner.
    pub(super) faces: Vec<u32>,
    /// The face of the description that each face was.
    pub(super) sources: Vec<u32>,
}

impl Loops {
    /// Takes the faces of a description, without corners that repeat the place of their neighbour and without spikes, and
    /// without those of which fewer than three corners are left.
    pub(super) fn clean(
        desc: &CageDesc,
        places: &[u32],
        watch: &Watch,
        report: &mut RepairReport,
    ) -> Result<Self, Cancelled> {
        let mut loops = Self {
            offsets: vec![0],
            corners: Vec::with_capacity(desc.face_vertices.len()),
            vertices: Vec::new(),
            places: Vec::new(),
            faces: Vec::new(),
            sources: Vec::new(),
        };
        let place = |corner: u32| places[desc.face_vertices[corner as usize] as usize];
        let mut row = Vec::new();
        for (f, pair) in (0..).zip(desc.face_offsets.windows(2)) {
            watch.at(f)?;
            row.clear();
            clean_row(pair[0]..pair[1], place, &mut row);
            if row.len() < 3 {
                report.degenerate_faces.push(desc.source_face(f));
                continue;
            }
            if row.len() < (pair[1] - pair[0]) as usize {
                report.shortened_faces.push(desc.source_face(f));
            }
            loops.push(f, &row);
        }
        loops.vertices = loops.corners.iter().map(|&corner| desc.face_vertices[corner as usize]).collect();
        loops.places = loops.vertices.iter().map(|&v| places[v as usize]).collect();
        Ok(loops)
    }

    fn push(&mut self, source: u32, row: &[u32]) {
        self.faces.extend(std::iter::repeat_n(self.sources.len() as u32, row.len()));
        self.sources.push(source);
        self.corners.extend_from_slice(row);
        self.offsets.push(self.corners.len() as u32);
    }

    /// Keeps the faces for which `keep` holds.
    pub(super) fn retain(&mut self, keep: impl Fn(u32) -> bool) {
        let mut kept = Self {
            offsets: vec![0],
            corners: Vec::with_capacity(self.corners.len()),
            vertices: Vec::with_capacity(self.corners.len()),
            places: Vec::with_capacity(self.corners.len()),
            faces: Vec::with_capacity(self.corners.len()),
            sources: Vec::with_capacity(self.sources.len()),
        };
        for f in (0..self.face_count() as u32).filter(|&f| keep(f)) {
            let row = self.row(f);
            kept.push(self.sources[f as usize], &self.corners[row.clone()]);
            kept.vertices.extend_from_slice(&self.vertices[row.clone()]);
            kept.places.extend_from_slice(&self.places[row]);
        }
        *self = kept;
    }

    pub(super) fn face_count(&self) -> usize {
        self.sources.len()
    }

    /// The corners of face `f`.
    pub(super) fn row(&self, f: u32) -> std::ops::Range<usize> {
        self.offsets[f as usize] as usize..self.offsets[f as usize + 1] as usize
    }

    /// The next corner of the same face.
    pub(super) fn next(&self, h: u32) -> u32 {
        let row = self.row(self.faces[h as usize]);
        if h as usize + 1 == row.end { row.start as u32 } else { h + 1 }
    }

    /// The previous corner of the same face.
    pub(super) fn prev(&self, h: u32) -> u32 {
        let row = self.row(self.faces[h as usize]);
        if h as usize == row.start { row.end as u32 - 1 } else { h - 1 }
    }

    /// The places that a half-edge joins, the lower one first, and whether it runs from the lower to the higher.
    pub(super) fn ends(&self, h: u32) -> ([u32; 2], bool) {
        let (a, b) = (self.places[h as usize], self.places[self.next(h) as usize]);
        ([a.min(b), a.max(b)], a < b)
    }

    /// The vertices that a half-edge joins, the lower one first.
    pub(super) fn vertex_ends(&self, h: u32) -> [u32; 2] {
        let (a, b) = (self.vertices[h as usize], self.vertices[self.next(h) as usize]);
        [a.min(b), a.max(b)]
    }
}

/// Drops corners at the place of the one before, and spikes: a corner between two at one place, with one of them.
fn clean_row(corners: impl Iterator<Item = u32>, place: impl Fn(u32) -> u32, row: &mut Vec<u32>) {
    let same = |a: u32, b: u32| place(a) == place(b);
    for corner in corners {
        match row[..] {
            [.., last] if same(last, corner) => {}
            [.., before, _] if same(before, corner) => drop(row.pop()),
            _ => row.push(corner),
        }
    }
    // What is left may meet over the end of the row.
    let mut start = 0;
    loop {
        match row[start..] {
            [first, .., last] if same(first, last) => drop(row.pop()),
            [first, .., before, _] if same(first, before) => row.truncate(row.len() - 2),
            [_, second, .., last] if same(second, last) => {
                row.pop();
                start += 1;
            }
            _ => break,
        }
    }
    row.drain(..start);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cleaned(places: &[u32]) -> Vec<u32> {
        let mut row = Vec::new();
        clean_row(0..places.len() as u32, |corner| places[corner as usize], &mut row);
        row.iter().map(|&corner| places[corner as usize]).collect()
    }

    #[test]
    fn repeated_places_and_spikes_go() {
        assert_eq!(cleaned(&[1, 2, 3, 4]), [1, 2, 3, 4]);
        assert_eq!(cleaned(&[1, 1, 2, 3, 3, 3]), [1, 2, 3]);
        assert_eq!(cleaned(&[1, 2, 3, 1]), [1, 2, 3]);
        assert_eq!(cleaned(&[1, 2, 3, 9, 3, 4]), [1, 2, 3, 4]);
        assert_eq!(cleaned(&[1, 2, 3, 9, 8, 9, 3, 4]), [1, 2, 3, 4]);
        assert_eq!(cleaned(&[9, 1, 2, 3, 1]), [1, 2, 3]);
        assert_eq!(cleaned(&[1, 2, 3, 1, 9]), [1, 2, 3]);
        assert!(cleaned(&[1, 2, 1, 2]).len() < 3);
        assert!(cleaned(&[1, 1, 1, 1]).len() < 3);
        // A figure of eight keeps its corners: the place is visited twice, not at once.
        assert_eq!(cleaned(&[1, 2, 3, 1, 4, 5]), [1, 2, 3, 1, 4, 5]);
    }
}
