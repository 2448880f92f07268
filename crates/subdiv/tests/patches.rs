//! Patches, records and locations of plans, but for those that `whole` looks at.

use glam::{DVec3, Vec3};
use osculate_cage::{BoundaryRule, Cage};
use osculate_subdiv::{NONE, PatchForm, PatchKind, Place, PlanDesc, PlanError, Scheme, SurfacePlan, twin};

mod common;

const RULES: [BoundaryRule; 3] = [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None];

/// Plans of the schemes that isolate extraordinary vertices.
fn plans() -> Vec<(String, Cage, SurfacePlan)> {
    let mut plans = Vec::new();
    let schemes = Scheme::ALL.iter().copied().filter(|&scheme| scheme != Scheme::Gregory1);
    for (scheme, rule) in schemes.flat_map(|scheme| RULES.map(|rule| (scheme, rule))) {
        for (name, cage) in common::zoo() {
            match SurfacePlan::build(&cage, &PlanDesc { boundary: Some(rule), scheme, ..PlanDesc::default() }) {
                Ok(plan) => plans.push((format!("{name}, {scheme}, {rule:?}"), cage, plan)),
                Err(PlanError::NothingToDraw { .. }) if rule == BoundaryRule::None => {}
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    plans
}

#[test]
fn every_drawn_quad_is_exactly_one_patch() {
    for (name, cage, plan) in plans() {
        let mut seen = vec![0; plan.patch_of_quad.len()];
        for (patch, &quad) in plan.quads.iter().enumerate() {
            seen[quad as usize] += 1;
            assert_eq!(plan.patch_of_quad[quad as usize], patch as u32, "{name}");
        }
        for (quad, &patch) in plan.patch_of_quad.iter().enumerate() {
            assert_eq!(seen[quad], u32::from(patch != NONE), "{name}: quad {quad}");
            let face = plan.locator.base_face(quad as u32) as usize;
            let touches = cage.face(face).iter().any(|&v| cage.topology().is_boundary_vertex(v));
            assert_eq!(patch == NONE, plan.rule == BoundaryRule::None && touches, "{name}: quad {quad}");
        }
        let total: u32 = plan.lists.iter().map(|list| list.count).sum();
        assert_eq!(total as usize, plan.patches.len(), "{name}");
    }
}

#[test]
fn lists_follow_each_other_and_hold_whole_nets() {
    for (name, _, plan) in plans() {
        let (mut patch, mut index) = (0, 0);
        for list in &plan.lists {
            assert_eq!((list.first_patch, list.first_index), (patch, index), "{name}: {:?}", list.kind);
            for record in &plan.patches[patch as usize..][..list.count as usize] {
                assert_eq!(record.kind(), list.kind, "{name}");
                match list.kind {
                    PatchKind::Unrefined | PatchKind::Regular => {
                        assert_eq!((record.net, record.net_size), (index, 16), "{name}")
                    }
                    PatchKind::Extraordinary { valence, .. } => {
                        assert_eq!((record.net, record.net_size), (index, 2 * valence + 8), "{name}");
                        assert!(record.valence() == valence && record.net_size <= 32, "{name}");
                    }
                    PatchKind::Stored { form } => {
                        let source = plan.projections.iter().find(|source| source.first == record.net).unwrap();
                        assert_eq!((source.net, source.columns), (index, record.net_size), "{name}");
                        assert_eq!(source.absolute_rows, if form == PatchForm::Stam { 1 } else { 20 }, "{name}");
                    }
                }
                index += record.net_size;
            }
            patch += list.count;
        }
        assert_eq!(index as usize, plan.nets.len(), "{name}");
        assert!(plan.nets.iter().all(|&i| i < plan.point_count), "{name}");
    }
}

#[test]
fn every_record_is_named_and_edges_are_shared_by_two_patches_or_one() {
    for (name, _, plan) in plans() {
        let mut vertex_uses = vec![0; plan.vertex_records.count()];
        let mut edge_uses = vec![[0; 2]; plan.edge_records.count()];
        for patch in &plan.patches {
            patch.vertex.iter().for_each(|&v| vertex_uses[v as usize] += 1);
            patch.edge.iter().for_each(|&e| edge_uses[(e / 2) as usize][(e & 1) as usize] += 1);
        }
        assert!(vertex_uses.iter().all(|&n| n > 0), "{name}");
        for (edge, uses) in edge_uses.iter().enumerate() {
            // The owner walks it forwards, the other patch, if there is one, backwards.
            assert_eq!(*uses, [1, u32::from(!plan.boundary_edges[edge])], "{name}: edge {edge}");
        }
    }
}

/// Records agree with each other: an edge's curve ends in the limit positions of its two vertices, from whichever patch it was taken.
#[test]
fn edge_records_end_in_vertex_records() {
    for (name, cage, plan) in plans() {
        let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
        let start: Vec<Vec3> = cage.positions().iter().map(|&p| ((p - centre) / scale).as_vec3()).collect();
        let points = twin::points(&plan, &start);
        let (vertices, edges) = (twin::vertex_records(&plan, &points), twin::edge_records(&plan, &points));
        for patch in &plan.patches {
            for side in 0..4 {
                let [from, to] = [side, (side + 1) % 4].map(|k| vertices[patch.vertex[k] as usize][0]);
                let record = &edges[(patch.edge[side] / 2) as usize];
                let (first, last) = if patch.edge[side] & 1 == 0 { (from, to) } else { (to, from) };
                let gap = (record[0] - first).length().max((record[3] - last).length());
                assert!(gap < 2e-6, "{name}: side {side} of {patch:?}: {gap:e}");
            }
        }
    }
}

#[test]
fn locations_map_there_and_back() {
    for (name, cage, plan) in plans() {
        for (patch, &quad) in plan.quads.iter().enumerate() {
            for uv in [[0.25, 0.125], [0.75, 0.5], [0.375, 0.875]] {
                let place = plan.locator.place(quad, uv);
                assert_eq!(place.sub_face.face, plan.locator.base_face(quad), "{name}");
                let found = plan.locator.find(place.sub_face, place.st).unwrap();
                assert_eq!((found.face, found.uv), (quad, uv), "{name}: patch {patch}");
            }
        }
        // One step cuts a quad into 4, two steps a quad into 16 and the part of any other face into 4.
        let count = |f: u32| match (plan.steps(), cage.face(f as usize).len()) {
            (1, _) => 4,
            (_, 4) => 16,
            (_, corners) => 4 * corners,
        };
        let quads: usize = (0..cage.face_count() as u32).map(count).sum();
        assert_eq!(plan.patch_of_quad.len(), quads, "{name}");
    }
}

/// Every patch's corners, by base face and (s,t), are where the exact surface has them.
#[test]
fn vertex_records_lie_on_the_exact_surface() {
    use osculate_surface::reference::{Boundary, Mesh, Reference};
    for (name, cage, plan) in plans() {
        let boundary = Boundary::from(plan.rule);
        let mesh = Mesh::from(&cage);
        let reference = Reference::new(&mesh, boundary).unwrap();
        let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
        let start: Vec<Vec3> = cage.positions().iter().map(|&p| ((p - centre) / scale).as_vec3()).collect();
        let points = twin::points(&plan, &start);
        let vertices = twin::vertex_records(&plan, &points);
        // A sample of patches is enough in large cages.
        for patch in (0..plan.patches.len()).step_by(plan.patches.len() / 500 + 1) {
            for (corner, uv) in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].into_iter().enumerate() {
                let Place { sub_face, st: [s, t], .. } = plan.locator.place(plan.quads[patch], uv);
                let exact = reference.eval(sub_face.face as usize, sub_face.sub, s, t).unwrap();
                let [position, normal] = vertices[plan.patches[patch].vertex[corner] as usize].map(|v| v.as_dvec3());
                let error = (position - (exact.position - centre) / scale).length();
                assert!(error < 2e-6, "{name}: corner {corner} of patch {patch} is off by {error:e}");
                if exact.normal != DVec3::ZERO && normal != DVec3::ZERO && !is_valence_two(&plan, patch) {
                    let turn = (normal - exact.normal).length();
                    assert!(turn < 5e-5, "{name}: normal at corner {corner} of patch {patch} is off by {turn:e}");
                }
            }
        }
    }
}

/// Inner vertices of valence 2 have no tangent plane.
fn is_valence_two(plan: &SurfacePlan, patch: usize) -> bool {
    plan.patches[patch].valence() == 2 && !plan.patches[patch].is_boundary()
}

/// The nets about a vertex of valence n have n (2n + 8) points: a cone is refused long before its faces are too many.
#[test]
fn nets_that_overflow_their_indices_are_refused() {
    let sides = 50_000;
    let faces: Vec<[u32; 3]> = (0..sides).map(|i| [sides, i, (i + 1) % sides]).collect();
    let cone = common::cage(sides as usize + 1, &faces.iter().map(|face| &face[..]).collect::<Vec<_>>());
    let error = SurfacePlan::build(&cone, &PlanDesc::default()).err().expect("a refusal").to_string();
    assert!(error.contains("points of nets would number 50") && error.contains("split the cage"), "{error}");
}

/// A polygon with very many corners is refused before its tables fill the memory.
#[test]
fn very_high_valence_is_refused() {
    let corners: Vec<u32> = (0..12_000).collect();
    let error = SurfacePlan::build(&common::cage(12_000, &[&corners]), &PlanDesc::default()).err().expect("too much");
    assert!(matches!(error, PlanError::HighValence { valence: 12_000, .. }), "{error}");
    assert!(error.to_string().contains("12000 edges"), "{error}");
    let corners: Vec<u32> = (0..300).collect();
    assert!(SurfacePlan::build(&common::cage(300, &[&corners]), &PlanDesc::default()).is_ok());
}

/// The host's side of the promise that the same cage gives the same bits: work is split by the number of threads, results are not.
#[test]
fn plans_do_not_depend_on_the_number_of_threads() {
    let arrays = |plan: &SurfacePlan| {
        let (vertices, edges) = (&plan.vertex_records, &plan.edge_records);
        let tables = plan.levels.iter().flat_map(|level| [level.face_indices.clone(), level.vertex_indices.clone()]);
        let plain = [&plan.nets, &plan.quads, &plan.patch_of_quad, &vertices.regular, &edges.regular];
        let general = [&vertices.general, &edges.general].map(|sources| sources.clone());
        let general = (general, plan.projections.clone(), plan.spokes.clone());
        let lists: Vec<Vec<u32>> = tables.chain(plain.into_iter().cloned()).collect();
        (lists, plan.patches.clone(), general, plan.reflections.clone(), plan.boundary_edges.clone())
    };
    let with_threads = |threads, cage: &Cage| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        arrays(&pool.install(|| {
            SurfacePlan::build(cage, &PlanDesc { scheme: Scheme::Biseptic, ..PlanDesc::default() }).unwrap()
        }))
    };
    for (name, cage) in common::zoo() {
        assert!(with_threads(1, &cage) == with_threads(3, &cage), "{name}");
    }
}
