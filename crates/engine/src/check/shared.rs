//! The proof that grids with shared vertices close by index: their triangles are those of the grids in which each patch has its own vertices, which
//! [`super::Proof`] looks at, between vertices with the same bits; and every edge between patches of a chunk has a triangle on either side.

use std::collections::HashMap;
use std::ops::Range;

use osculate_subdiv::{PatchRecord, SurfacePlan};

use super::{CheckReport, bits};
use crate::CapturedVertex;
use crate::keys::{common_side, edge_parameter};

/// Vertices and triangles of a chunk in one layout.
pub(super) struct Mesh<'a> {
    pub(super) vertices: &'a [CapturedVertex],
    /// Three for each triangle.
    pub(super) indices: &'a [u32],
}

/// Adds to `report` what is wrong with the shared vertices of a chunk of `patches`.
pub(super) fn compare(
    plan: &SurfacePlan,
    patches: Range<u32>,
    own: &Mesh<'_>,
    shared: &Mesh<'_>,
    report: &mut CheckReport,
) {
    // Vertices that nothing has written hold anything.
    let is_strange = |vertex: &CapturedVertex| !patches.contains(&vertex.patch);
    if own.indices.len() != shared.indices.len() || own.vertices.iter().any(is_strange) {
        report.wrong_patches += 1;
        return;
    }
    compare_vertices(own, shared, report);
    let mut edges: HashMap<Edge, u32> = HashMap::new();
    for (triangle, own_triangle) in shared.indices.as_chunks::<3>().0.iter().zip(own.indices.as_chunks::<3>().0) {
        let corners = own_triangle.map(|vertex| &own.vertices[vertex as usize]);
        for k in 0..3 {
            let next = (k + 1) % 3;
            let place = Place::of(plan, corners[k], corners[next]);
            *edges.entry((place, triangle[k], triangle[next])).or_default() += 1;
        }
    }
    let patches_of_edge = patches_of_sides(plan, patches);
    for (&(place, a, b), &count) in &edges {
        report.over_shared += u64::from(count - 1);
        let ends_here = patches_of_edge.get(&place) == Some(&1);
        report.open += u64::from(!ends_here && !edges.contains_key(&(place, b, a)));
    }
}

/// A directed edge of a triangle: where it lies, and the vertices that it joins. Two patches that meet in two sides may join the same vertices inside, too.
type Edge = (Place, u32, u32);

/// Where an edge of a triangle lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Place {
    /// On an edge record: on its first half or the second, if it is the edge of an unrefined face, since patches may have one of them; else on the first.
    Side(u32, usize),
    /// In a patch.
    Inside(u32),
}

impl Place {
    /// Of the edge between two vertices of a patch.
    fn of(plan: &SurfacePlan, from: &CapturedVertex, to: &CapturedVertex) -> Self {
        let record = &plan.patches[from.patch as usize];
        match common_side(record, &[from.uv, to.uv]) {
            Some(side) if record.is_unrefined() => {
                let middle = [0, 1].map(|i| 0.5 * (from.uv[i] + to.uv[i]));
                Self::Side(record.edge[side] / 2, usize::from(edge_parameter(record, side, middle) > 0.5))
            }
            Some(side) => Self::Side(record.edge[side] / 2, half_of(record, side)),
            None => Self::Inside(from.patch),
        }
    }
}

/// The half of an edge record that a side of a refined patch is: the record is walked the other way.
fn half_of(record: &PatchRecord, side: usize) -> usize {
    usize::from(record.is_half(side) && side == 0)
}

/// How many patches of a chunk each edge record has, or each half of it: on the border of the chunk, as on that of the surface, one.
fn patches_of_sides(plan: &SurfacePlan, patches: Range<u32>) -> HashMap<Place, u32> {
    let mut count = HashMap::new();
    for record in &plan.patches[patches.start as usize..patches.end as usize] {
        for side in 0..record.sides() {
            let half = half_of(record, side);
            let halves = if record.is_unrefined() { 0..2 } else { half..half + 1 };
            halves.for_each(|half| *count.entry(Place::Side(record.edge[side] / 2, half)).or_default() += 1);
        }
    }
    count
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

#[cfg(test)]
mod tests {
    use osculate_cage::read_obj;
    use osculate_subdiv::PlanDesc;

    use super::*;

    /// One patch on its own side: a plan of four, of which the first is drawn as two triangles with shared vertices.
    fn plan() -> SurfacePlan {
        let cage = read_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "sheet.obj").unwrap();
        SurfacePlan::build(&cage, &PlanDesc::default()).unwrap()
    }

    fn vertices() -> Vec<CapturedVertex> {
        let at = |u: f32, v: f32| CapturedVertex { position: [u, v, 0.0], uv: [u, v], ..CapturedVertex::default() };
        vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]
    }

    const INDICES: [u32; 6] = [0, 1, 2, 0, 2, 3];

    fn compared(shared_vertices: &[CapturedVertex], shared_indices: &[u32]) -> CheckReport {
        let own = vertices();
        let mut report = CheckReport::default();
        let own = Mesh { vertices: &own, indices: &INDICES };
        let shared = Mesh { vertices: shared_vertices, indices: shared_indices };
        compare(&plan(), 0..1, &own, &shared, &mut report);
        report
    }

    #[test]
    fn the_same_triangles_are_closed() {
        assert_eq!(compared(&vertices(), &INDICES), CheckReport::default());
    }

    #[test]
    fn a_wrong_index_is_noticed() {
        for at in 0..INDICES.len() {
            let mut indices = INDICES;
            indices[at] = (indices[at] + 1) % 4;
            let report = compared(&vertices(), &indices);
            assert!(report.split_positions > 0 || report.open > 0, "{at}: {report:?}");
        }
    }

    #[test]
    fn a_vertex_that_is_not_shared_is_noticed() {
        let mut vertices = vertices();
        vertices.push(vertices[2]);
        let report = compared(&vertices, &[0, 1, 2, 0, 4, 3]);
        assert_eq!((report.open, report.split_positions), (2, 0));
    }

    #[test]
    fn other_bits_are_noticed() {
        let mut vertices = vertices();
        vertices[1].position[0] = 1f32.next_up();
        vertices[3].normal[1] = -0.0;
        let report = compared(&vertices, &INDICES);
        assert_eq!((report.split_positions, report.split_normals), (1, 1));
    }

    #[test]
    fn vertices_of_no_patch_are_noticed() {
        let mut own = vertices();
        own[2].patch = u32::MAX;
        let mut report = CheckReport::default();
        let own = Mesh { vertices: &own, indices: &INDICES };
        compare(&plan(), 0..1, &own, &Mesh { vertices: &vertices(), indices: &INDICES }, &mut report);
        assert_eq!(report.wrong_patches, 1);
    }

    #[test]
    fn missing_triangles_are_noticed() {
        assert_eq!(compared(&vertices(), &INDICES[..3]).wrong_patches, 1);
    }
}
