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

/// Corner of a patch at (u,v), if any.
pub(crate) fn corner_of(uv: [f32; 2]) -> Option<usize> {
    match (uv[0], uv[1]) {
        (0.0, 0.0) => Some(0),
        (1.0, 0.0) => Some(1),
        (1.0, 1.0) => Some(2),
        (0.0, 1.0) => Some(3),
        _ => None,
    }
}

/// Whether (u,v) lies on a side of the patch, corners included.
pub(crate) fn is_on_side(side: usize, [u, v]: [f32; 2]) -> bool {
    match side {
        0 => v == 0.0,
        1 => u == 1.0,
        2 => v == 1.0,
        _ => u == 0.0,
    }
}

/// Parameter on the edge record of a side: as the record is walked.
pub(crate) fn edge_parameter(record: &PatchRecord, side: usize, uv: [f32; 2]) -> f32 {
    let x = uv[side & 1];
    let reversed = (side >= 2) != (record.edge[side] & 1 == 1);
    if reversed { 1.0 - x } else { x }
}

impl VertexKey {
    /// The key of a captured vertex.
    ///
    /// # Panics
    /// If the vertex is not of this plan.
    pub fn of(plan: &SurfacePlan, vertex: &CapturedVertex) -> Self {
        let record = &plan.patches[vertex.patch as usize];
        if let Some(corner) = corner_of(vertex.uv) {
            return Self::Vertex(record.vertex[corner]);
        }
        match (0..4).find(|&side| is_on_side(side, vertex.uv)) {
            Some(side) => Self::Edge(record.edge[side] / 2, edge_parameter(record, side, vertex.uv).to_bits()),
            None => Self::Inside(vertex.patch, vertex.uv[0].to_bits(), vertex.uv[1].to_bits()),
        }
    }
}
