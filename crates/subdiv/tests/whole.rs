//! Plans of cages that are not isolated.

use glam::{DVec3, Vec3};
use osculate_cage::{BoundaryRule, Cage};
use osculate_subdiv::{NONE, PatchForm, PatchKind, PlanDesc, PlanError, Scheme, SurfacePlan, twin};
use osculate_surface::bezier;
use osculate_surface::reference::{Boundary, Mesh, Reference};

mod common;

const RULES: [BoundaryRule; 3] = [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None];
const GREGORY: PatchKind = PatchKind::Stored { form: PatchForm::Gregory };
const TRIANGLE: PatchKind = PatchKind::Stored { form: PatchForm::Triangle };

fn plan(cage: &Cage, rule: BoundaryRule) -> Result<SurfacePlan, PlanError> {
    SurfacePlan::build(cage, &PlanDesc { boundary: Some(rule), scheme: Scheme::Gregory1, ..PlanDesc::default() })
}

fn cages() -> Vec<(String, Cage)> {
    let mut cages = common::zoo();
    let mut add = |name: &str, cage| cages.push((name.to_owned(), cage));
    add("triangle", common::cage(3, &[&[0, 1, 2]]));
    add("heptagon", common::cage(7, &[&[0, 1, 2, 3, 4, 5, 6]]));
    add("two quads back to back", common::cage(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]));
    add("two triangles back to back", common::cage(3, &[&[0, 1, 2], &[2, 1, 0]]));
    add("quad and triangle", common::cage(5, &[&[0, 1, 2, 3], &[1, 4, 2]]));
    cages
}

fn plans() -> Vec<(String, Cage, SurfacePlan)> {
    let mut plans = Vec::new();
    for rule in RULES {
        for (name, cage) in cages() {
            match plan(&cage, rule) {
                Ok(plan) => plans.push((format!("{name}, {rule:?}"), cage, plan)),
                Err(PlanError::NothingToDraw { .. }) if rule == BoundaryRule::None => {}
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    plans
}

fn start(cage: &Cage) -> Vec<Vec3> {
    let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
    cage.positions().iter().map(|&p| ((p - centre) / scale).as_vec3()).collect()
}

#[test]
fn every_drawn_face_is_one_patch_of_its_shape() {
    for (name, cage, plan) in plans() {
        let whole = (0..cage.face_count()).all(|f| cage.face(f).len() <= 4);
        assert_eq!(plan.steps(), u32::from(!whole), "{name}");
        let mut patches = 0;
        for list in &plan.lists {
            assert_eq!(list.first_patch as usize, patches, "{name}");
            for record in &plan.patches[patches..][..list.count as usize] {
                assert_eq!((record.kind(), record.sides()), (list.kind, if list.kind == TRIANGLE { 3 } else { 4 }));
                assert!(
                    record.net_size
                        == [16, 20, 15]
                            [[PatchKind::Regular, GREGORY, TRIANGLE].iter().position(|k| *k == list.kind).unwrap()]
                );
            }
            patches += list.count as usize;
        }
        assert_eq!(patches, plan.patches.len(), "{name}");
        for (face, &patch) in plan.patch_of_quad.iter().enumerate() {
            let base = plan.locator.base_face(face as u32) as usize;
            let touches = cage.face(base).iter().any(|&v| cage.topology().is_boundary_vertex(v));
            assert_eq!(patch == NONE, plan.rule == BoundaryRule::None && touches, "{name}: face {face}");
            if patch != NONE {
                assert_eq!(plan.quads[patch as usize] as usize, face, "{name}");
                let sides = if plan.steps() == 0 { cage.face(base).len() } else { 4 };
                assert_eq!(plan.patches[patch as usize].sides(), sides, "{name}: face {face}");
            }
        }
    }
}

#[test]
fn vectors_follow_each_other_and_indices_stay_inside() {
    for (name, _, plan) in plans() {
        let mut first = 0;
        for (source, fan) in plan.projections.iter().zip(&plan.gathers.fans) {
            assert_eq!((source.first, fan.first), (first, first), "{name}");
            assert!((source.net + source.columns) as usize <= plan.nets.len(), "{name}");
            assert!((source.weights + source.columns * (1 + 3 * fan.edges)) as usize <= plan.weights.len(), "{name}");
            first += 1 + 3 * fan.edges;
        }
        assert_eq!((first, plan.projections.len()), (plan.projected_count(), plan.gathers.fans.len()), "{name}");
        for (patch, record) in plan.gathers.patches.iter().zip(plan.patches.iter().filter(|p| p.kind().is_stored())) {
            assert_eq!((patch.first, record.net), (first, first), "{name}");
            first += record.net_size;
        }
        assert_eq!(first, plan.vector_count, "{name}");
        assert!(plan.nets.iter().all(|&i| i < plan.point_count), "{name}");
    }
}

#[test]
fn every_record_is_named_and_edges_are_shared_by_two_patches_or_one() {
    for (name, _, plan) in plans() {
        let mut vertex_uses = vec![0; plan.vertex_records.count()];
        let mut edge_uses = vec![[0; 2]; plan.edge_record_count()];
        for patch in &plan.patches {
            for k in 0..patch.sides() {
                vertex_uses[patch.vertex[k] as usize] += 1;
                edge_uses[(patch.edge[k] / 2) as usize][(patch.edge[k] & 1) as usize] += 1;
            }
        }
        assert!(vertex_uses.iter().all(|&n| n > 0), "{name}");
        for (edge, uses) in edge_uses.iter().enumerate() {
            // The owner walks it forwards, the other patch, if there is one, backwards.
            assert_eq!(*uses, [1, u32::from(!plan.boundary_edges[edge])], "{name}: edge {edge}");
        }
    }
}

/// An edge's curve ends in the limit positions of its two vertices, and those are corners of the patches' control nets.
#[test]
fn records_and_control_points_meet() {
    for (name, cage, plan) in plans() {
        let points = twin::points(&plan, &start(&cage));
        let (vertices, edges) = (twin::vertex_records(&plan, &points), twin::edge_records(&plan, &points));
        let vectors = twin::coefficients(&plan, &points);
        assert_eq!(vectors.len(), plan.vector_count as usize, "{name}");
        for patch in &plan.patches {
            for side in 0..patch.sides() {
                let [from, to] = [side, (side + 1) % patch.sides()].map(|k| vertices[patch.vertex[k] as usize][0]);
                let record = &edges[(patch.edge[side] / 2) as usize];
                let forwards = patch.edge[side] & 1 == 0;
                let (first, last) = if forwards { (from, to) } else { (to, from) };
                let gap = (record[0] - first).length().max((record[3] - last).length());
                assert!(gap < 2e-6, "{name}: side {side} of {patch:?}: {gap:e}");
                if patch.kind().is_stored() {
                    let own = |k: usize| vectors[patch.net as usize + k];
                    let next = 5 * ((side + 1) % patch.sides());
                    let mut curve = [own(5 * side), own(5 * side + 1), own(next + 2), own(next)];
                    if !forwards {
                        curve.reverse();
                    }
                    let gap = (0..4).map(|i| (curve[i] - record[i]).length()).fold(0.0, f32::max);
                    assert!(gap < 2e-6, "{name}: side {side} of {patch:?}: {gap:e}");
                }
            }
        }
    }
}

/// The regular patches' bicubic has the curves and normals that the gathered records of its neighbours have.
#[test]
fn regular_and_gathered_records_agree_where_quads_meet() {
    let at = |x: u32, y: u32| 6 * (y % 6) + x % 6;
    let mut faces: Vec<Vec<u32>> = (0..36)
        .map(|k| (k % 6, k / 6))
        .map(|(x, y)| vec![at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)])
        .collect();
    let torus = |faces: &[Vec<u32>]| {
        plan(&common::cage(36, &faces.iter().map(Vec::as_slice).collect::<Vec<_>>()), BoundaryRule::EdgeOnly).unwrap()
    };
    assert_eq!(
        torus(&faces).lists.iter().map(|list| (list.kind, list.count)).collect::<Vec<_>>(),
        [(PatchKind::Regular, 36)]
    );
    // A quad becomes two triangles: its neighbours, all nine, are no longer regular.
    let [a, b, c, d] = faces[0][..] else { panic!("a quad") };
    faces[0] = vec![a, b, c];
    faces.push(vec![c, d, a]);
    let plan = torus(&faces);
    let counts: Vec<_> = plan.lists.iter().map(|list| (list.kind, list.count)).collect();
    assert_eq!(counts, [(PatchKind::Regular, 27), (GREGORY, 8), (TRIANGLE, 2)]);
    let points = twin::points(&plan, &start(&common::cage(36, &faces.iter().map(Vec::as_slice).collect::<Vec<_>>())));
    let (edges, vectors) = (twin::edge_records(&plan, &points), twin::coefficients(&plan, &points));
    let mut met = 0;
    for patch in plan.patches.iter().filter(|patch| patch.kind() == GREGORY) {
        for side in (0..4).filter(|&side| (patch.edge[side] / 2) < plan.edge_records.regular.len() as u32) {
            let g = |k: usize| vectors[(patch.net as usize) + k].as_dvec3();
            let (own, next) = (5 * side, 5 * ((side + 1) % 4));
            let curve = [g(own), g(own + 1), g(next + 2), g(next)];
            let inner = [g(own + 2), g(own + 3), g(next + 4), g(next + 1)];
            let inwards = [0, 1, 2, 3].map(|i| inner[i] - curve[i]);
            let record = edges[(patch.edge[side] / 2) as usize].map(|p| p.as_dvec3());
            let forwards = patch.edge[side] & 1 == 0;
            for t in [0.0, 0.3, 0.5, 1.0] {
                let ours = bezier::curve(&curve, t).1.cross(bezier::curve(&inwards, t).0).normalize();
                let at = if forwards { t } else { 1.0 - t };
                let (c, d): ([DVec3; 4], [DVec3; 4]) =
                    (std::array::from_fn(|i| record[i]), std::array::from_fn(|i| record[4 + i]));
                let theirs = bezier::curve(&c, at).1.cross(bezier::curve(&d, at).0).normalize();
                assert!(
                    (ours - theirs).length() < 1e-5,
                    "side {side} of {patch:?} at {t}: {}",
                    (ours - theirs).length()
                );
                met += 1;
            }
        }
    }
    assert!(met >= 12 * 4, "{met}");
}

#[test]
fn vertex_records_lie_on_the_exact_surface() {
    for (name, cage, plan) in plans() {
        let mesh = Mesh::from(&cage);
        let reference = Reference::new(&mesh, Boundary::from(plan.rule)).unwrap();
        let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
        let vertices = twin::vertex_records(&plan, &twin::points(&plan, &start(&cage)));
        for patch in (0..plan.patches.len()).step_by(plan.patches.len() / 300 + 1) {
            let record = &plan.patches[patch];
            let corners: &[[f64; 2]] = if record.sides() == 3 {
                &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
            } else {
                &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            };
            for (corner, &uv) in corners.iter().enumerate() {
                let place = plan.locator.place(plan.quads[patch], uv);
                let exact =
                    reference.eval(place.sub_face.face as usize, place.sub_face.sub, place.st[0], place.st[1]).unwrap();
                let [position, normal] = vertices[record.vertex[corner] as usize].map(|v| v.as_dvec3());
                let error = (position - (exact.position - centre) / scale).length();
                assert!(error < 2e-6, "{name}: corner {corner} of patch {patch} is off by {error:e}");
                assert_eq!(
                    plan.is_irregular_corner(patch as u32, corner),
                    exact.irregular,
                    "{name}: corner {corner} of patch {patch}"
                );
                if exact.normal != DVec3::ZERO && normal != DVec3::ZERO && !is_valence_two(&plan, patch, corner) {
                    let turn = (normal - exact.normal).length();
                    assert!(turn < 5e-5, "{name}: normal at corner {corner} of patch {patch} is off by {turn:e}");
                }
            }
        }
    }
}

/// Inner vertices of valence 2 have no tangent plane.
fn is_valence_two(plan: &SurfacePlan, patch: usize, corner: usize) -> bool {
    let stored = patch.checked_sub(plan.patches.len() - plan.gathers.patches.len());
    stored.is_some_and(|i| plan.gathers.fans[plan.gathers.patches[i].fan[corner] as usize].edges == 2)
}

#[test]
fn locations_map_there_and_back() {
    for (name, _, plan) in plans() {
        for (patch, &face) in plan.quads.iter().enumerate() {
            for uv in [[0.25, 0.125], [0.5, 0.375], [0.125, 0.75]] {
                let place = plan.locator.place(face, uv);
                let found = plan.locator.find(place.sub_face, place.st).unwrap();
                assert_eq!(found.face, face, "{name}: patch {patch}");
                assert!((0..2).all(|i| (found.uv[i] - uv[i]).abs() < 1e-15), "{name}: patch {patch}: {found:?}");
            }
        }
    }
}

#[test]
fn very_high_valence_is_refused() {
    let corners: Vec<u32> = (0..12_000).collect();
    let error = plan(&common::cage(12_000, &[&corners]), BoundaryRule::EdgeOnly).err().expect("too much");
    assert!(matches!(error, PlanError::HighValence { valence: 12_000, .. }), "{error}");
    let corners: Vec<u32> = (0..300).collect();
    assert!(plan(&common::cage(300, &[&corners]), BoundaryRule::EdgeOnly).is_ok());
}

/// Work is split by the number of threads, results are not.
#[test]
fn plans_do_not_depend_on_the_number_of_threads() {
    let arrays = |plan: &SurfacePlan| {
        let gathers = (plan.gathers.fans.clone(), plan.gathers.edges.clone(), plan.gathers.patches.clone());
        let plain = [&plan.nets, &plan.quads, &plan.vertex_records.regular, &plan.edge_records.regular];
        (plain.map(Vec::clone), gathers, plan.patches.clone(), plan.weights.clone(), plan.boundary_edges.clone())
    };
    let with_threads = |threads, cage: &Cage| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        arrays(&pool.install(|| plan(cage, BoundaryRule::EdgeAndCorner).unwrap()))
    };
    for (name, cage) in cages() {
        assert!(with_threads(1, &cage) == with_threads(3, &cage), "{name}");
    }
}
