//! The proof that grids with shared vertices close by index: their triangles are those of the grids in which each patch has its own vertices, which
//! [`super::Proof`] looks at, between vertices with the same bits; and every edge between patches of a chunk has a triangle on either side.

use std::collections::HashMap;

use osculate_subdiv::SurfacePlan;

use super::{CheckReport, bits};
use crate::CapturedVertex;
use crate::keys::common_side;

/// Vertices and triangles of a chunk in one layout.
pub(super) struct Mesh<'a> {
    pub(super) vertices: &'a [CapturedVertex],
    /// Three for each triangle.
    pub(super) indices: &'a [u32],
}

/// Adds to `report` what is wrong with the shared vertices of a chunk of `patches`.
pub(super) fn compare(
    plan: &SurfacePlan,
    patches: std::ops::Range<u32>,
    own: &Mesh<'_>,
    shared: &Mesh<'_>,
    report: &mut CheckReport,
) {
    if own.indices.len() != shared.indices.len() {
        report.wrong_patches += 1;
        return;
    }
    compare_vertices(own, shared, report);
    let mut edges: HashMap<(u32, u32), [u32; 2]> = HashMap::new();
    for (triangle, own) in shared.indices.as_chunks::<3>().0.iter().zip(own.indices.as_chunks::<3>().0) {
        for k in 0..3 {
            let next = (k + 1) % 3;
            let again = edges.insert((triangle[k], triangle[next]), [own[k], own[next]]);
            report.over_shared += u64::from(again.is_some());
        }
    }
    let sharing = Sharing::new(plan, patches);
    for (&(a, b), own_edge) in &edges {
        let [from, to] = own_edge.map(|vertex| &own.vertices[vertex as usize]);
        report.open += u64::from(!edges.contains_key(&(b, a)) && !sharing.may_be_open(from, to));
    }
}

/// Vertices of triangles that stand for each other have the same bits.
fn compare_vertices(own: &Mesh<'_>, shared: &Mesh<'_>, report: &mut CheckReport) {
    let mut seen = vec![false; own.vertices.len()];
    for (&own_vertex, &shared_vertex) in own.indices.iter().zip(shared.indices) {
        if std::mem::replace(&mut seen[own_vertex as usize], true) {
            continue;
        }
        let (own, shared) = (&own.vertices[own_vertex as usize], &shared.vertices[shared_vertex as usize]);
        let split = u64::from(bits(own.position) != bits(shared.position));
        report.split_positions += split;
        report.split_normals += u64::from(bits(own.normal) != bits(shared.normal));
    }
}

/// How many patches of a chunk each edge record has.
struct Sharing<'a> {
    plan: &'a SurfacePlan,
    patches_of_edge: HashMap<u32, u32>,
}

impl<'a> Sharing<'a> {
    fn new(plan: &'a SurfacePlan, patches: std::ops::Range<u32>) -> Self {
        let mut patches_of_edge = HashMap::new();
        for record in &plan.patches[patches.start as usize..patches.end as usize] {
            for edge in &record.edge[..record.sides()] {
                *patches_of_edge.entry(edge / 2).or_default() += 1;
            }
        }
        Self { plan, patches_of_edge }
    }

    /// Whether the edge between two vertices of a patch may have a triangle on one side only: it lies on a side of the patch, and nothing lies beyond that
    /// in this chunk.
    fn may_be_open(&self, from: &CapturedVertex, to: &CapturedVertex) -> bool {
        let record = &self.plan.patches[from.patch as usize];
        common_side(record, &[from.uv, to.uv]).is_some_and(|side| self.patches_of_edge[&(record.edge[side] / 2)] == 1)
    }
}
