//! How much room the tables of a cage take.

use osculate_cage::Cage;
use osculate_gpu::Limits;
use osculate_shaders::constant;

use crate::Scheme;

/// Estimates for a closed cage.
pub(super) struct Needs {
    /// Bytes of the largest table.
    largest: u64,
    /// Vectors, or numbers, of the longest table that is read as an array of them.
    longest: u64,
    /// Bytes of all tables.
    all: u64,
}

/// Edges of a mesh of quads for each face of it.
const EDGES: u64 = 2;
/// Bytes of a vector in the coefficient buffer.
const VECTOR: u64 = 12;
/// Vectors of a whole face that is a Gregory patch: its control points, and the fan of one vertex of valence 4.
const WHOLE_FACE_VECTORS: u64 = 20 + 13;
/// Numbers in the nets for each final face; the vectors of edge records are as many.
const NET: u64 = 16;
/// Bytes of all tables for each final face, edge records included.
const ALL: u64 = 420;
/// What a part may take of what there is for a table; the rest is for the rings around it.
const SHARE: f64 = 0.85;

impl Needs {
    pub(super) fn of(cage: &Cage, scheme: Scheme) -> Self {
        let (faces, corners) = (cage.face_count() as u64, cage.topology().half_edge_count() as u64);
        let whole = scheme == Scheme::Gregory1;
        let final_faces = match (whole, cage.is_quads(), (0..cage.face_count()).all(|f| cage.face(f).len() <= 4)) {
            (true, _, true) => faces,
            (true, _, false) | (false, true, _) => corners,
            (false, false, _) => 4 * corners,
        };
        let edges = EDGES * 4 * u64::from(constant::EDGE_RECORD_FLOATS);
        let coefficients = if whole { WHOLE_FACE_VECTORS * VECTOR } else { 0 };
        let longest = NET.max(if whole { WHOLE_FACE_VECTORS } else { 0 });
        Self {
            largest: final_faces * edges.max(coefficients),
            longest: final_faces * longest,
            all: final_faces * (ALL + coefficients),
        }
    }

    /// How many parts make their tables fit. A cage that would just fit as a whole is one part.
    pub(super) fn parts(&self, limits: &Limits) -> usize {
        let needed = |size: u64, room: u64| {
            if size <= room { 1 } else { (size as f64 / (SHARE * room as f64)).ceil() as usize }
        };
        // Half of the memory is for pictures, vertices of the compute evaluator, and others.
        let memory = if limits.device_memory == 0 { u64::MAX } else { limits.device_memory / 2 };
        [(self.largest, limits.max_storage_buffer_range), (self.longest, limits.max_texels), (self.all, memory)]
            .into_iter()
            .map(|(size, room)| needed(size, room))
            .max()
            .unwrap_or(1)
    }
}

#[cfg(test)]
mod tests {
    use osculate_cage::read_obj;

    use super::*;

    fn limits(range: u64, texels: u64, memory: u64) -> Limits {
        let mut limits = Limits::default();
        (limits.max_storage_buffer_range, limits.max_texels, limits.device_memory) = (range, texels, memory);
        limits
    }

    #[test]
    fn parts_are_as_many_as_the_scarcer_room_asks_for() {
        let needs = Needs { largest: 1000, longest: 80, all: 5000 };
        assert_eq!(needs.parts(&limits(1000, 80, 0)), 1);
        assert_eq!(needs.parts(&limits(999, 80, 0)), 2);
        assert_eq!(needs.parts(&limits(1000, 79, 0)), 2);
        assert_eq!(needs.parts(&limits(100, 80, 0)), 12);
        assert_eq!(needs.parts(&limits(100, 80, 200)), 59);
        assert_eq!(needs.parts(&limits(1000, 80, 10_000)), 1);
    }

    /// The table in docs/measurements.md: 768 bytes of edge records for each quad.
    #[test]
    fn quads_take_as_many_bytes_as_measured() {
        let quad = read_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "quad.obj").unwrap();
        assert_eq!(Needs::of(&quad, Scheme::Gregory2).largest, 768);
        assert_eq!(Needs::of(&quad, Scheme::Gregory1).largest, 396);
        let triangle = read_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "triangle.obj").unwrap();
        assert_eq!(Needs::of(&triangle, Scheme::Stam).largest, 12 * 192);
    }
}
