//! Faces around faces.

use crate::{NONE, Topology};

/// Faces with rings around them.
pub(super) struct Halo {
    /// The faces, rising.
    pub(super) faces: Vec<u32>,
    /// The ring of each: 0 for those in the middle.
    pub(super) rings: Vec<u8>,
    /// For each face of the topology its place in `faces`, [`NONE`] if it is not there.
    pub(super) numbers: Vec<u32>,
}

impl Halo {
    /// Adds to faces those that share a vertex with them, and so on, as many times as there are to be rings.
    pub(super) fn grow(topology: &Topology, own: &[u32], rings: u8) -> Self {
        // While it grows, the number of a face is that of its ring.
        let mut numbers = vec![NONE; topology.face_count()];
        own.iter().for_each(|&f| numbers[f as usize] = 0);
        let mut faces = own.to_vec();
        let mut first = 0;
        for ring in 1..=rings {
            let last = faces.len();
            for i in first..last {
                for &v in topology.face_vertices(faces[i]) {
                    for f in topology.ring(v).map(|h| topology.face(h)) {
                        if numbers[f as usize] == NONE {
                            numbers[f as usize] = u32::from(ring);
                            faces.push(f);
                        }
                    }
                }
            }
            first = last;
        }
        faces.sort_unstable();
        faces.dedup();
        let rings = faces.iter().map(|&f| numbers[f as usize] as u8).collect();
        (0..).zip(&faces).for_each(|(i, &f)| numbers[f as usize] = i);
        Self { faces, rings, numbers }
    }
}
