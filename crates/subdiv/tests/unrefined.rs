//! Plans that leave regular faces as they are, beside those of the same cages that refine all.

use glam::Vec3;
use osculate_cage::{BoundaryRule, Cage};
use osculate_subdiv::{NONE, PatchKind, PatchRecord, PlanDesc, PlanError, Refinement, Scheme, SurfacePlan, twin};

mod common;

const NEEDED: PlanDesc = PlanDesc { boundary: None, scheme: Scheme::Gregory2, refinement: Refinement::WhereNeeded };

/// A cage, the plan that refines what must be, and the one that refines all.
struct Case {
    name: String,
    cage: Cage,
    needed: SurfacePlan,
    everywhere: SurfacePlan,
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (i, (name, cage)) in common::zoo().into_iter().enumerate() {
        let scheme = [Scheme::Gregory2, Scheme::Stam, Scheme::Biseptic][i % 3];
        for rule in [BoundaryRule::EdgeAndCorner, BoundaryRule::None] {
            let desc = PlanDesc { boundary: Some(rule), scheme, ..NEEDED };
            let plan = |desc: &PlanDesc| SurfacePlan::build(&cage, desc);
            match plan(&desc) {
                Ok(needed) => cases.push(Case {
                    name: format!("{name}, {scheme}, {rule:?}"),
                    cage: cage.clone(),
                    needed,
                    everywhere: plan(&PlanDesc { refinement: Refinement::Everywhere, ..desc }).unwrap(),
                }),
                Err(PlanError::NothingToDraw { .. }) => {}
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    let unrefined: u32 = cases.iter().map(|case| case.needed.unrefined_count()).sum();
    assert!(unrefined > 500, "the cages have {unrefined} such faces");
    let of_second_step = |case: &&Case| case.needed.steps() == 2 && case.needed.unrefined_count() > 0;
    assert!(cases.iter().filter(of_second_step).count() > 1, "too few cages have such faces after a first step");
    cases
}

/// A grid of quads without boundary is its own patches.
#[test]
fn a_regular_torus_is_not_refined() {
    let (columns, rows) = (5, 4);
    let at = |i: u32, j: u32| i % columns + columns * (j % rows);
    let faces: Vec<[u32; 4]> = (0..columns * rows)
        .map(|f| (f % columns, f / columns))
        .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let faces: Vec<&[u32]> = faces.iter().map(|face| &face[..]).collect();
    let plan = SurfacePlan::build(&common::cage(20, &faces), &NEEDED).unwrap();
    let lists: Vec<_> = plan.lists.iter().map(|list| (list.kind, list.count)).collect();
    assert_eq!(lists, [(PatchKind::Unrefined, 20)]);
    assert_eq!((plan.vertex_record_count(), plan.edge_record_count()), (20, 40));
    assert_eq!(plan.point_count, 20, "no new points");
    // The points of the cage, in rows from (-1,-1) on.
    let net: Vec<u32> = (0..16).map(|i| at(columns + i % 4 - 1, rows + i / 4 - 1)).collect();
    assert_eq!(plan.nets[..16], net);
}

/// A 5 x 5 sheet: what touches its boundary is refined, what touches only that is not.
#[test]
fn the_rest_of_a_sheet_is_refined() {
    let at = |i: u32, j: u32| i + 6 * j;
    let faces: Vec<[u32; 4]> = (0..25)
        .map(|f| (f % 5, f / 5))
        .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let faces: Vec<&[u32]> = faces.iter().map(|face| &face[..]).collect();
    let plan = SurfacePlan::build(&common::cage(36, &faces), &NEEDED).unwrap();
    let lists: Vec<_> = plan.lists.iter().map(|list| (list.kind, list.count)).collect();
    assert_eq!(lists, [(PatchKind::Unrefined, 9), (PatchKind::Regular, 64)]);
    // Of 60 edges 24 are edges of unrefined faces, 12 of those beside refined ones.
    let inside_refined = 4 * 16;
    assert_eq!(plan.edge_record_count(), 24 + 2 * 36 + inside_refined);
    assert_eq!(plan.vertex_record_count(), 36 + 36 + 16);
    // Not made are points about the four vertices in the middle, which lie between unrefined faces alone: theirs, those of edges and the face between them.
    let step = &plan.levels[0];
    assert_eq!([step.face_count(), step.edge_count(), step.vertex_count()], [25 - 1, 60 - 4, 36 - 4]);
    let halves = plan.patches.iter().map(|patch| [0, 3].iter().filter(|&&side| patch.is_half(side)).count());
    assert_eq!(halves.sum::<usize>(), 24);
}

#[test]
fn each_edge_has_one_record_and_two_patches_or_three() {
    for Case { name, needed: plan, .. } in cases() {
        let mut uses = vec![Vec::new(); plan.edge_record_count()];
        for (patch, record) in plan.patches.iter().enumerate() {
            for side in 0..4 {
                let sort = if record.is_half(side) { 'h' } else { 'w' };
                uses[(record.edge[side] / 2) as usize].push((record.edge[side] & 1, sort, side, patch));
            }
        }
        for (edge, mut uses) in uses.into_iter().enumerate() {
            uses.sort_unstable();
            let sorts: Vec<_> = uses.iter().map(|&(flip, sort, _, _)| (flip, sort)).collect();
            match sorts[..] {
                [(0, 'w')] => assert!(plan.boundary_edges[edge], "{name}: edge {edge}"),
                [(0, 'w'), (1, 'w')] => {}
                [(0, 'w'), (1, 'h'), (1, 'h')] => {
                    assert!(plan.patches[uses[0].3].is_unrefined(), "{name}: edge {edge}");
                    assert_eq!([uses[1].2, uses[2].2], [0, 3], "{name}: edge {edge}");
                }
                _ => panic!("{name}: edge {edge} has {uses:?}"),
            }
        }
    }
}

#[test]
fn corners_without_a_record_are_the_middles_of_edges() {
    for Case { name, needed: plan, .. } in cases() {
        let mut used = vec![false; plan.vertex_record_count()];
        for patch in &plan.patches {
            let middles = [false, patch.is_half(0), false, patch.is_half(3)];
            assert_eq!(patch.vertex.map(|vertex| vertex == NONE), middles, "{name}: {patch:?}");
            patch.vertex.iter().filter(|&&v| v != NONE).for_each(|&v| used[v as usize] = true);
        }
        assert!(used.iter().all(|&used| used), "{name}");
    }
}

#[test]
fn unrefined_faces_stand_for_their_four_children() {
    for Case { name, needed, everywhere, .. } in cases() {
        let saved = 3 * needed.unrefined_count() as usize;
        assert_eq!(needed.patches.len() + saved, everywhere.patches.len(), "{name}");
        for (quad, (&patch, &child)) in (0..).zip(needed.patch_of_quad.iter().zip(&everywhere.patch_of_quad)) {
            assert_eq!(patch == NONE, child == NONE, "{name}: quad {quad}");
            if patch == NONE {
                continue;
            }
            let record = &needed.patches[patch as usize];
            let place = everywhere.locator.place(quad, [0.25, 0.5]);
            let found = needed.locator.find(place.sub_face, place.st).unwrap();
            assert_eq!(needed.patch_of_quad[found.face as usize], patch, "{name}: quad {quad}");
            let back = needed.locator.place(needed.quads[patch as usize], found.uv);
            assert_eq!((back.sub_face, back.st), (place.sub_face, place.st), "{name}: quad {quad}");
            if record.is_unrefined() {
                assert_eq!(everywhere.patches[child as usize].kind(), PatchKind::Regular, "{name}");
                assert_eq!(needed.locator.base_face(quad), needed.locator.base_face(found.face), "{name}");
            } else {
                assert_eq!((needed.quads[patch as usize], found.uv), (quad, [0.25, 0.5]), "{name}");
            }
        }
    }
}

/// The points that are made have the bits that they have where all are.
#[test]
fn points_that_are_made_are_those_of_the_refined_cage() {
    for Case { name, cage, needed, everywhere } in cases() {
        let start: Vec<Vec3> = cage.positions().iter().map(|p| p.as_vec3()).collect();
        let (some, all) = (twin::points(&needed, &start), twin::points(&everywhere, &start));
        assert!(some.len() <= all.len() && needed.point_count as usize == some.len(), "{name}");
        let regular = |patch: &PatchRecord| patch.kind() == PatchKind::Regular;
        for (patch, &quad) in needed.patches.iter().zip(&needed.quads).filter(|(patch, _)| regular(patch)) {
            let child = &everywhere.patches[everywhere.patch_of_quad[quad as usize] as usize];
            let net = |plan: &SurfacePlan, points: &[Vec3], patch: &PatchRecord| {
                [0, 5, 15].map(|i| points[plan.nets[patch.net as usize + i] as usize])
            };
            assert_eq!(net(&needed, &some, patch), net(&everywhere, &all, child), "{name}: {patch:?}");
        }
    }
}

/// A point of the curve of a record.
fn on_curve(record: &[Vec3; 8], t: f32) -> Vec3 {
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| record[i]);
    let s = 1.0 - t;
    s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d
}

/// Where a place on a side of a patch is on the edge record, by the words of [`PatchRecord::is_half`].
fn along_record(patch: &PatchRecord, side: usize, x: f32) -> f32 {
    let x = match (patch.is_half(side), side) {
        (false, _) => x,
        (true, 0) => 0.5 * x,
        (true, _) => 0.5 + 0.5 * x,
    };
    if patch.edge[side] & 1 == 1 { 1.0 - x } else { x }
}

/// The records that refined patches have are those that they have where all is refined: also halves of longer ones.
#[test]
fn records_are_those_of_the_refined_cage() {
    for Case { name, cage, needed, everywhere } in cases() {
        let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
        let start: Vec<Vec3> = cage.positions().iter().map(|&p| ((p - centre) / scale).as_vec3()).collect();
        let records = |plan: &SurfacePlan| {
            let points = twin::points(plan, &start);
            (twin::vertex_records(plan, &points), twin::edge_records(plan, &points))
        };
        let ((vertices, edges), (all_vertices, all_edges)) = (records(&needed), records(&everywhere));
        for (patch, &quad) in needed.patches.iter().zip(&needed.quads) {
            let child = &everywhere.patches[everywhere.patch_of_quad[quad as usize] as usize];
            let corners = if patch.is_unrefined() { 0..1 } else { 0..4 };
            for k in corners.filter(|&k| patch.vertex[k] != NONE) {
                let pair = [vertices[patch.vertex[k] as usize], all_vertices[child.vertex[k] as usize]];
                let gap = (0..2).map(|i| (pair[0][i] - pair[1][i]).length()).fold(0.0, f32::max);
                assert!(gap < 2e-5, "{name}: corner {k} of {patch:?}: {gap:e}");
            }
            let sides = if patch.is_unrefined() { 0..0 } else { 0..4 };
            for (side, x) in sides.flat_map(|side| [0.0, 0.3, 1.0].map(|x| (side, x))) {
                let here = on_curve(&edges[(patch.edge[side] / 2) as usize], along_record(patch, side, x));
                let there = on_curve(&all_edges[(child.edge[side] / 2) as usize], along_record(child, side, x));
                let gap = (here - there).length();
                assert!(gap < 2e-6, "{name}: side {side} of {patch:?} at {x}: {gap:e}");
            }
        }
    }
}

#[test]
fn parts_of_cages_are_not_planned_so() {
    let (_, cage) = common::zoo().into_iter().find(|(name, _)| name == "torus").unwrap();
    let faces: Vec<u32> = (0..cage.face_count() as u32 / 2).collect();
    let part = osculate_cage::CagePart::cut(&cage, &faces, 2);
    assert!(matches!(SurfacePlan::build_part(&part, &NEEDED), Err(PlanError::UnrefinedParts)));
}
