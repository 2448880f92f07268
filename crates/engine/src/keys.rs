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

/// Corner of a patch at (u,v), if any.
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
    if record.sides() == 3 {
        return match (side + 1 - usize::from(flipped)) % 3 {
            0 => 1.0 - uv[usize::from(side != 0)],
            end => uv[end - 1],
        };
    }
    let x = uv[side & 1];
    if (side >= 2) != flipped { 1.0 - x } else { x }
}

impl VertexKey {
    /// The key of a captured vertex.
    ///
    /// # Panics
    /// If the vertex is not of this plan.
    pub fn of(plan: &SurfacePlan, vertex: &CapturedVertex) -> Self {
        let record = &plan.patches[vertex.patch as usize];
        if let Some(corner) = corner_of(record, vertex.uv) {
            return Self::Vertex(record.vertex[corner]);
        }
        match common_side(record, &[vertex.uv]) {
            Some(side) => Self::Edge(record.edge[side] / 2, edge_parameter(record, side, vertex.uv).to_bits()),
            None => Self::Inside(vertex.patch, vertex.uv[0].to_bits(), vertex.uv[1].to_bits()),
        }
    }
}
