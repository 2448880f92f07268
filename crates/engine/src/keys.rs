//! Where a vertex of a patch lies: on a vertex record, on an edge record, or inside.

use osculate_subdiv::{PatchRecord, SurfacePlan};

use crate::CapturedVertex;

/// What identifies a vertex of the tessellated surface. Equal keys mean the same point of the surface, whichever patch drew it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum VertexKey {
    /// A vertex record.
    Vertex(u32),
    /// An edge record and the bits of its parameter.
    Edge(u32, u32),
    /// A patch and the bits of its parameters.
    Inside(u32, u32, u32),
}

/// The barycentric coordinate of a triangle's corner 0, as the shaders find it: on the side opposite it exactly zero.
fn first_coordinate([u, v]: [f32; 2]) -> f32 {
    (1.0 - u) - v
}

/// Corner of a patch at (u,v), if any, with a vertex record or without.
pub(crate) fn corner_of(record: &PatchRecord, uv: [f32; 2]) -> Option<usize> {
    match (uv[0], uv[1]) {
        (0.0, 0.0) => Some(0),
        (0.0, 1.0) if record.sides() == 3 => Some(2),
        (1.0, 0.0) => Some(1),
        (1.0, 1.0) => Some(2),
        (0.0, 1.0) => Some(3),
        _ => None,
    }
}

/// Whether (u,v) lies on a side of the patch, corners included.
pub(crate) fn is_on_side(record: &PatchRecord, side: usize, [u, v]: [f32; 2]) -> bool {
    match (record.sides(), side) {
        (_, 0) => v == 0.0,
        (3, 1) => first_coordinate([u, v]) == 0.0,
        (3, _) => u == 0.0,
        (_, 1) => u == 1.0,
        (_, 2) => v == 1.0,
        _ => u == 0.0,
    }
}

/// The side of a patch that all of these points lie on, if there is one.
pub(crate) fn common_side(record: &PatchRecord, points: &[[f32; 2]]) -> Option<usize> {
    (0..record.sides()).find(|&side| points.iter().all(|&uv| is_on_side(record, side, uv)))
}

/// Parameter on the edge record of a side: as the record is walked.
pub(crate) fn edge_parameter(record: &PatchRecord, side: usize, uv: [f32; 2]) -> f32 {
    let flipped = record.edge[side] & 1 == 1;
    if record.is_unrefined() || record.is_half(side) {
        let along = if side >= 2 { 1.0 - uv[side & 1] } else { uv[side & 1] };
        let along = match (record.is_half(side), side) {
            (false, _) => along,
            (true, 0) => 0.5 * along,
            (true, _) => 0.5 + 0.5 * along,
        };
        return end_of_segment(if flipped { 1.0 - along } else { along });
    }
    if record.sides() == 3 {
        return match (side + 1 - usize::from(flipped)) % 3 {
            0 => 1.0 - uv[usize::from(side != 0)],
            end => uv[end - 1],
        };
    }
    let x = uv[side & 1];
    if (side >= 2) != flipped { 1.0 - x } else { x }
}

/// Most segments of an edge.
const MOST_SEGMENTS: u32 = 64;

/// The end of a segment, of an edge that is divided into at most 64 equal ones, that a parameter stands for: the patches of an edge get it in other units, and
/// tessellators round it. Fractions with such denominators are 1/4032 or more apart.
fn end_of_segment(t: f32) -> f32 {
    let end = |n: u32| (t * n as f32).round() / n as f32;
    (1..=MOST_SEGMENTS).map(end).find(|end| (end - t).abs() < 1e-4).unwrap_or(t)
}

impl VertexKey {
    /// The key of a captured vertex.
    ///
    /// # Panics
    /// If the vertex is not of this plan.
    pub fn of(plan: &SurfacePlan, vertex: &CapturedVertex) -> Self {
        let record = &plan.patches[vertex.patch as usize];
        let side = match corner_of(record, vertex.uv).map(|corner| (corner, record.half_to(corner))) {
            Some((corner, None)) => return Self::Vertex(record.vertex[corner]),
            Some((_, half)) => half,
            None => common_side(record, &[vertex.uv]),
        };
        match side {
            Some(side) => Self::Edge(record.edge[side] / 2, edge_parameter(record, side, vertex.uv).to_bits()),
            None => Self::Inside(vertex.patch, vertex.uv[0].to_bits(), vertex.uv[1].to_bits()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_segments_are_found_again_and_told_apart() {
        for (n, rounding) in (1..=MOST_SEGMENTS).flat_map(|n| [-3e-5, 0.0, 3e-5].map(|rounding| (n, rounding))) {
            for i in 0..=n {
                let exact = i as f32 / n as f32;
                assert_eq!(end_of_segment(exact + rounding), exact, "{i} of {n}");
            }
        }
        assert_eq!(end_of_segment(0.503), 0.503, "no such segments");
    }

    #[test]
    fn halves_have_the_keys_of_the_whole_edge() {
        let whole = PatchRecord { edge: [6, 0, 0, 0], tag: PatchRecord::UNREFINED, ..PatchRecord::default() };
        let tag = PatchRecord::HALF_0 | PatchRecord::HALF_3;
        let halves = PatchRecord { edge: [7, 0, 0, 7], tag, ..PatchRecord::default() };
        for (x, half) in [(0.0, 0.0), (1.0 / 6.0, 1.0 / 3.0), (0.5, 1.0)] {
            let first = edge_parameter(&whole, 0, [x, 0.0]);
            assert_eq!(first, edge_parameter(&halves, 3, [0.0, half]), "{x}");
            let second = edge_parameter(&whole, 0, [1.0 - x, 0.0]);
            assert_eq!(second, edge_parameter(&halves, 0, [half, 0.0]), "{x}");
        }
    }
}
