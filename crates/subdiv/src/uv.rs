//! Texture coordinates of patches, and those that patches share.
//!
//! Texture coordinates belong to the corners of faces and are interpolated linearly: bilinearly on quads and on the sub-faces of other faces, in barycentric
//! coordinates on triangles that are patches. Where the faces of an edge disagree runs a seam. What moves points, a displacement, must not depend on the side
//! that they are looked at from, so every edge record has texture coordinates of its own, those of the side that owns it, and every vertex record names an edge
//! record that it takes its own from.

use glam::DVec2;
use osculate_cage::FaceVarying;
use rayon::prelude::*;

use crate::{NONE, PatchRecord, SubFace, SurfacePlan};

/// Texture coordinates of an edge record, in its direction.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EdgeUv {
    /// Where it begins and where it ends.
    pub ends: [[f32; 2]; 2],
    /// Their change per unit of the record's cross field, there.
    pub across: [[f32; 2]; 2],
}

/// Texture coordinates of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct UvTables {
    /// Of the corners of each patch; zero for the fourth of a triangle.
    pub patches: Vec<[[f32; 2]; 4]>,
    /// Of each edge record.
    pub edges: Vec<EdgeUv>,
    /// For each vertex record twice the number of an edge record that has it as an end, plus one if it ends there.
    pub vertices: Vec<u32>,
    /// Edge records whose two patches disagree.
    pub seams: usize,
}

impl UvTables {
    /// The tables for texture coordinates of the cage that `plan` was made of. `place` is applied to each of them.
    ///
    /// # Panics
    /// If they are of another cage, or faces are left unrefined ([`crate::Refinement::WhereNeeded`]): edges of these have ends that no vertex record stands for.
    pub fn new(plan: &SurfacePlan, uv: &FaceVarying, place: impl Fn(DVec2) -> DVec2 + Sync) -> Self {
        let values: Vec<DVec2> = uv.values.iter().map(|&value| place(value)).collect();
        let corner = |c: u32| values[uv.indices[c as usize] as usize];
        let patches = (0..plan.patches.len())
            .into_par_iter()
            .map(|patch| patch_corners(plan, patch, &corner).map(|value| value.as_vec2().to_array()));
        let patches: Vec<_> = patches.collect();
        let (edges, seams) = edges(plan, &patches);
        Self { vertices: edge_of_vertices(plan), patches, edges, seams }
    }

    /// Texture coordinates at (u,v) of a patch.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn at(&self, plan: &SurfacePlan, patch: u32, [u, v]: [f32; 2]) -> [f32; 2] {
        let corners = &self.patches[patch as usize];
        let weights = match plan.patches[patch as usize].sides() {
            3 => [1.0 - u - v, u, v, 0.0],
            _ => [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v],
        };
        [0, 1].map(|i| weights.iter().zip(corners).map(|(weight, corner)| weight * corner[i]).sum())
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> usize {
        size_of_val(self.patches.as_slice())
            + size_of_val(self.edges.as_slice())
            + size_of_val(self.vertices.as_slice())
    }
}

/// The corners of a patch.
fn patch_corners(plan: &SurfacePlan, patch: usize, corner: &impl Fn(u32) -> DVec2) -> [DVec2; 4] {
    let (face, locator) = (plan.quads[patch], &plan.locator);
    if plan.patches[patch].sides() == 3 {
        let mut corners = [DVec2::ZERO; 4];
        locator.face_corners(face).zip(&mut corners).for_each(|(c, value)| *value = corner(c));
        return corners;
    }
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|uv| {
        let place = locator.place(face, uv);
        let [a, b, c, d] = sub_face_corners(plan, place.sub_face, corner);
        let [s, t] = place.st;
        // On a side two terms are left, and their sum is the same from both sides.
        ((1.0 - t) * ((1.0 - s) * a + s * b)) + t * ((1.0 - s) * d + s * c)
    })
}

/// The corners of a base quad, or of the child at a corner of any other face.
fn sub_face_corners(plan: &SurfacePlan, SubFace { face, sub }: SubFace, corner: &impl Fn(u32) -> DVec2) -> [DVec2; 4] {
    let corners = plan.locator.face_corners(face);
    let n = corners.len() as u32;
    let at = |i: u32| corner(corners.start + i % n);
    let Ok(sub) = u32::try_from(sub) else { return [0, 1, 2, 3].map(at) };
    let centre = corners.clone().map(corner).sum::<DVec2>() / f64::from(n);
    [at(sub), 0.5 * (at(sub) + at(sub + 1)), centre, 0.5 * (at(sub) + at(sub + n - 1))]
}

/// One side of an edge record: the texture coordinates at its ends, and their change from there into the patch.
fn side_uv(record: &PatchRecord, corners: &[[f32; 2]; 4], side: usize) -> EdgeUv {
    let n = record.sides();
    let at = |i: usize| corners[i % n];
    let minus = |a: [f32; 2], b: [f32; 2]| [a[0] - b[0], a[1] - b[1]];
    let (from, to) = (at(side), at(side + 1));
    let across = [minus(at(side + n - 1), from), minus(at(side + 2), to)];
    match record.edge[side] & 1 {
        0 => EdgeUv { ends: [from, to], across },
        _ => EdgeUv { ends: [to, from], across: [across[1], across[0]] },
    }
}

/// Texture coordinates of all edge records, and the number of seams.
fn edges(plan: &SurfacePlan, patches: &[[[f32; 2]; 4]]) -> (Vec<EdgeUv>, usize) {
    let mut edges = vec![EdgeUv::default(); plan.edge_record_count()];
    for_each_side(plan, |patch, side, edge, flipped| {
        if !flipped {
            edges[edge] = side_uv(&plan.patches[patch], &patches[patch], side);
        }
    });
    let (mut joined, mut seams) = (vec![false; edges.len()], 0);
    for_each_side(plan, |patch, side, edge, flipped| {
        if flipped {
            let (own, other) = (&mut edges[edge], side_uv(&plan.patches[patch], &patches[patch], side));
            joined[edge] = own.ends == other.ends;
            seams += usize::from(!joined[edge]);
            if joined[edge] {
                // As the cross field: half the difference of what leads to the left and to the right.
                own.across = [0, 1].map(|end| [0, 1].map(|i| 0.5 * (own.across[end][i] - other.across[end][i])));
            }
        }
    });
    let cosines = cosines(plan);
    for_each_side(plan, |patch, side, edge, flipped| {
        if !flipped && !joined[edge] {
            let ends = ends_of(&plan.patches[patch], side);
            straighten(&mut edges[edge], ends.map(|vertex| cosines[vertex as usize]));
        }
    });
    (edges, seams)
}

/// Makes of what leads into a patch what leads straight across its side: the other patch, were it a mirror image, would lead as far along the edge.
fn straighten(edge: &mut EdgeUv, [first, last]: [f32; 2]) {
    let along = [0, 1].map(|i| edge.ends[1][i] - edge.ends[0][i]);
    for (across, cosine) in edge.across.iter_mut().zip([first, -last]) {
        *across = [0, 1].map(|i| across[i] - cosine * along[i]);
    }
}

/// Calls `visit` with patch, side, edge record, and whether the side is walked against the record.
fn for_each_side(plan: &SurfacePlan, mut visit: impl FnMut(usize, usize, usize, bool)) {
    for (patch, record) in plan.patches.iter().enumerate() {
        for side in 0..record.sides() {
            let edge = record.edge[side];
            visit(patch, side, (edge / 2) as usize, edge & 1 == 1);
        }
    }
}

/// The vertex records of a side.
fn ends_of(record: &PatchRecord, side: usize) -> [u32; 2] {
    [record.vertex[side], record.vertex[(side + 1) % record.sides()]]
}

/// The cosine of the angle between neighbouring edges of each vertex record; 0 on the boundary.
fn cosines(plan: &SurfacePlan) -> Vec<f32> {
    let mut patches = vec![0u32; plan.vertex_record_count()];
    let mut boundary = vec![false; patches.len()];
    for_each_side(plan, |patch, side, edge, _| {
        let ends = ends_of(&plan.patches[patch], side).map(|vertex| vertex as usize);
        patches[ends[0]] += 1;
        ends.into_iter().for_each(|vertex| boundary[vertex] |= plan.boundary_edges[edge]);
    });
    let cosine = |(&n, &boundary): (&u32, &bool)| match n {
        4 => 0.0,
        _ if boundary => 0.0,
        n => (std::f64::consts::TAU / f64::from(n)).cos() as f32,
    };
    patches.iter().zip(&boundary).map(cosine).collect()
}

/// See [`UvTables::vertices`]: of the edge records at a vertex the first.
fn edge_of_vertices(plan: &SurfacePlan) -> Vec<u32> {
    let mut edges = vec![NONE; plan.vertex_record_count()];
    for_each_side(plan, |patch, side, edge, flipped| {
        for (end, vertex) in (0..).zip(ends_of(&plan.patches[patch], side)) {
            let known = &mut edges[vertex as usize];
            *known = (2 * edge as u32 + (end ^ u32::from(flipped))).min(*known);
        }
    });
    edges
}

#[cfg(test)]
mod tests {
    use osculate_cage::{Cage, read_obj};

    use super::*;
    use crate::{PlanDesc, Scheme};

    /// Two squares side by side with the uv of each corner given, joined or not.
    fn sheet(second: &str) -> Cage {
        let text = format!(
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n\
             vt 0 0\nvt 0.5 0\nvt 1 0\nvt 0 1\nvt 0.5 1\nvt 1 1\nvt 0.25 0.75\n\
             f 1/1 2/2 5/5 4/4\nf {second}\n"
        );
        read_obj(text.as_bytes(), "sheet.obj").unwrap()
    }

    const JOINED: &str = "2/2 3/3 6/6 5/5";
    const CUT: &str = "2/7 3/3 6/6 5/5";

    fn tables(cage: &Cage, scheme: Scheme) -> (SurfacePlan, UvTables) {
        let plan = SurfacePlan::build(cage, &PlanDesc { scheme, ..PlanDesc::default() }).unwrap();
        let tables = UvTables::new(&plan, cage.uv().unwrap(), |uv| uv);
        (plan, tables)
    }

    #[test]
    fn without_seams_both_sides_have_the_records_coordinates() {
        for &scheme in Scheme::ALL {
            let (plan, tables) = tables(&sheet(JOINED), scheme);
            assert_eq!(tables.seams, 0, "{scheme}");
            for_each_side(&plan, |patch, side, edge, flipped| {
                let [from, to] = tables.edges[edge].ends;
                let corners = &tables.patches[patch];
                let own = [corners[side], corners[(side + 1) % 4]];
                assert_eq!(own, if flipped { [to, from] } else { [from, to] }, "{scheme}, patch {patch}, side {side}");
            });
        }
    }

    #[test]
    fn patches_lie_where_their_place_on_the_face_says() {
        let (plan, tables) = tables(&sheet(JOINED), Scheme::Gregory2);
        for patch in 0..plan.patches.len() as u32 {
            let place = plan.locator.place(plan.quads[patch as usize], [0.25, 0.5]);
            let [s, t] = place.st;
            let expected = [0.5 * (s + f64::from(place.sub_face.face)), t];
            let found = tables.at(&plan, patch, [0.25, 0.5]);
            assert!((0..2).all(|i| (f64::from(found[i]) - expected[i]).abs() < 1e-6), "{found:?}, not {expected:?}");
        }
    }

    /// On a regular sheet with one scale everywhere, across is as long as a patch and to the left of the edge.
    #[test]
    fn across_leads_to_the_left_whoever_owns_the_edge() {
        for &scheme in Scheme::ALL {
            let (_, tables) = tables(&sheet(JOINED), scheme);
            for EdgeUv { ends: [from, to], across } in &tables.edges {
                // The sheet is twice as wide as it is deep; its uv is not.
                let along = [2.0 * (to[0] - from[0]), to[1] - from[1]];
                for across in across.map(|[x, y]| [2.0 * x, y]) {
                    assert_eq!(across, [-along[1], along[0]], "{scheme}");
                }
            }
        }
    }

    #[test]
    fn at_a_seam_the_owner_decides() {
        for (scheme, count) in [(Scheme::Gregory2, 2), (Scheme::Gregory1, 1)] {
            let (plan, tables) = tables(&sheet(CUT), scheme);
            assert_eq!(tables.seams, count, "{scheme}");
            for_each_side(&plan, |patch, side, edge, flipped| {
                let corners = &tables.patches[patch];
                if !flipped {
                    assert_eq!(tables.edges[edge].ends, [corners[side], corners[(side + 1) % 4]], "{scheme}");
                }
            });
        }
    }

    #[test]
    fn vertices_name_edges_that_meet_them() {
        let (plan, tables) = tables(&sheet(CUT), Scheme::Gregory2);
        let mut met = vec![false; tables.vertices.len()];
        for_each_side(&plan, |patch, side, edge, flipped| {
            for (end, vertex) in (0..).zip(ends_of(&plan.patches[patch], side)) {
                met[vertex as usize] |=
                    tables.vertices[vertex as usize] == 2 * edge as u32 + (end ^ u32::from(flipped));
            }
        });
        assert!(met.iter().all(|&met| met));
    }

    #[test]
    fn other_faces_are_cut_at_their_centre() {
        let text = "v 0 0 0\nv 3 0 0\nv 0 3 0\nvt 0 0\nvt 3 0\nvt 0 3\nf 1/1 2/2 3/3\n";
        let cage = read_obj(text.as_bytes(), "triangle.obj").unwrap();
        let (plan, two) = tables(&cage, Scheme::Stam);
        let at_centre = |patch: &[[f32; 2]; 4]| patch.contains(&[1.0, 1.0]);
        assert_eq!((plan.patches.len(), two.patches.iter().filter(|patch| at_centre(patch)).count()), (12, 3));
        let (_, whole) = tables(&cage, Scheme::Gregory1);
        assert_eq!(whole.patches, [[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [0.0, 0.0]]]);
        // The middle of an edge, and straight across it; a triangle alone has no neighbours to share angles with.
        assert_eq!(whole.edges[0], EdgeUv { ends: [[0.0, 0.0], [3.0, 0.0]], across: [[0.0, 3.0], [-3.0, 3.0]] });
    }
}
