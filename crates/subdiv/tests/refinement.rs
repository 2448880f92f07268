//! Refined meshes and points against independent constructions.

use std::collections::HashMap;

use glam::{DVec3, Vec3};
use osculate_cage::{BoundaryRule, Cage, Topology};
use osculate_subdiv::{Connectivity, NONE, PlanDesc, QuadConnectivity, RefineTables, SurfacePlan, twin};
use osculate_surface::reference::{Boundary, Mesh};

mod common;

const RULES: [BoundaryRule; 2] = [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly];

fn plan(cage: &Cage, rule: BoundaryRule) -> SurfacePlan {
    SurfacePlan::build(cage, &PlanDesc { boundary: Some(rule), ..PlanDesc::default() }).unwrap()
}

fn corners(mesh: &QuadConnectivity) -> Vec<u32> {
    (0..mesh.half_edge_count() as u32).map(|h| mesh.origin(h)).collect()
}

#[test]
fn refined_half_edges_are_those_of_the_refined_faces() {
    for (name, cage) in common::zoo() {
        let first = QuadConnectivity::refine(cage.topology());
        for mesh in [&first, &QuadConnectivity::refine(&first)] {
            let offsets: Vec<u32> = (0..=mesh.face_count() as u32).map(|f| 4 * f).collect();
            let built = Topology::build(mesh.vertex_count(), offsets, corners(mesh)).unwrap();
            assert_eq!(mesh.edge_count(), built.edge_count(), "{name}");
            for h in 0..mesh.half_edge_count() as u32 {
                assert_eq!((mesh.twin(h), mesh.edge(h)), (built.twin(h), built.edge(h)), "{name}: half-edge {h}");
            }
            for v in 0..mesh.vertex_count() as u32 {
                let h = mesh.vertex_half_edge(v);
                assert_eq!(mesh.origin(h), v, "{name}");
                assert_eq!(mesh.twin(h) == NONE, built.is_boundary_vertex(v), "{name}: vertex {v}");
                assert_eq!(mesh.face_valence(v), built.face_valence(v), "{name}: vertex {v}");
            }
        }
    }
}

/// The promise of the report, section 3: one step isolates cages of quads, two all others.
#[test]
fn the_planned_steps_isolate_extraordinary_vertices() {
    let mut extraordinary = 0;
    for (name, cage) in common::zoo() {
        let mut mesh = QuadConnectivity::refine(cage.topology());
        if !cage.is_quads() {
            mesh = QuadConnectivity::refine(&mesh);
        }
        for rule in RULES {
            let is_regular = |v: u32| match (mesh.is_boundary_vertex(v), mesh.face_valence(v)) {
                (false, n) => n == 4,
                (true, 1) => rule == BoundaryRule::EdgeAndCorner,
                (true, k) => k == 2,
            };
            for quad in 0..mesh.face_count() as u32 {
                for k in 1..4 {
                    assert!(is_regular(mesh.origin(4 * quad + k)), "{name}: corner {k} of quad {quad}");
                }
                extraordinary += u32::from(!is_regular(mesh.origin(4 * quad)));
            }
        }
    }
    assert!(extraordinary > 100);
}

/// Refined points in f64, by name: the reference has its own code for all of it.
fn reference_points(cage: &Cage, rule: BoundaryRule, steps: u32) -> Vec<Vec<DVec3>> {
    let boundary = Boundary::from(rule);
    let mut mesh = Mesh::from(cage);
    // From our vertex numbers to the reference's, level by level; both number face points, edge points, vertex points, but order edges as they like.
    let mut ours_to_theirs: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    let mut levels = Vec::new();
    let mut ours = Refined::Cage(cage.topology());
    for _ in 0..steps {
        let refined = mesh.subdivide(boundary);
        let mut map: Vec<u32> = (0..ours.face_count() as u32).collect();
        let edges: HashMap<(u32, u32), u32> = (0..ours.edge_count() as u32)
            .map(|e| {
                let (a, b) = ours.ends(e);
                let ends = (ours_to_theirs[a as usize], ours_to_theirs[b as usize]);
                (ends, refined.edge_point(ends.0, ends.1).expect("the reference has our edges"))
            })
            .collect();
        for e in 0..ours.edge_count() as u32 {
            let (a, b) = ours.ends(e);
            map.push(edges[&(ours_to_theirs[a as usize], ours_to_theirs[b as usize])]);
        }
        let first_vertex = (ours.face_count() + ours.edge_count()) as u32;
        map.extend(ours_to_theirs.iter().map(|&v| first_vertex + v));
        levels.push(map.iter().map(|&i| refined.mesh.positions[i as usize]).collect());
        ours = Refined::Quads(ours.refine());
        mesh = refined.mesh;
        // Our children are numbered by half-edge, and so are the reference's, or the face points would not match at the next level.
        ours_to_theirs = map;
    }
    levels
}

enum Refined<'a> {
    Cage(&'a Topology),
    Quads(QuadConnectivity),
}

impl Refined<'_> {
    fn face_count(&self) -> usize {
        match self {
            Self::Cage(mesh) => mesh.face_count(),
            Self::Quads(mesh) => mesh.face_count(),
        }
    }
    fn edge_count(&self) -> usize {
        match self {
            Self::Cage(mesh) => mesh.edge_count(),
            Self::Quads(mesh) => mesh.edge_count(),
        }
    }
    fn ends(&self, e: u32) -> (u32, u32) {
        fn of(mesh: &impl Connectivity, e: u32) -> (u32, u32) {
            let h = mesh.edge_half_edge(e);
            (mesh.origin(h), mesh.target(h))
        }
        match self {
            Self::Cage(mesh) => of(*mesh, e),
            Self::Quads(mesh) => of(mesh, e),
        }
    }
    fn refine(&self) -> QuadConnectivity {
        match self {
            Self::Cage(mesh) => QuadConnectivity::refine(*mesh),
            Self::Quads(mesh) => QuadConnectivity::refine(mesh),
        }
    }
}

/// Two steps for every cage, though cages of quads need one.
#[test]
fn single_precision_points_stay_within_a_millionth_of_the_box() {
    for (name, cage) in common::zoo() {
        for rule in RULES {
            let first = RefineTables::build(cage.topology(), rule, 0);
            let second = RefineTables::build(&QuadConnectivity::refine(cage.topology()), rule, first.first_new);
            let (centre, size) = (cage.bounds().center(), 2.0 * cage.bounds().half_diagonal());
            let mut points: Vec<Vec3> = cage.positions().iter().map(|&p| (p - centre).as_vec3()).collect();
            for (tables, exact) in [first, second].iter().zip(reference_points(&cage, rule, 2)) {
                assert_eq!(
                    (points.len(), tables.new_point_count()),
                    (tables.first_new as usize, exact.len()),
                    "{name}"
                );
                points.resize(points.len() + exact.len(), Vec3::ZERO);
                twin::face_points(tables, &mut points);
                twin::edge_points(tables, &mut points);
                twin::vertex_points(tables, &mut points);
                for (i, exact) in exact.iter().enumerate() {
                    let point = points[tables.first_new as usize + i].as_dvec3();
                    let error = (point - (*exact - centre)).length() / size;
                    assert!(error < 1e-6, "{name}: point {i} is off by {error:e} of the box");
                }
            }
        }
    }
}

#[test]
fn faces_of_quads_run_through_the_edge_kernel_with_the_same_bits() {
    let cage = common::zoo().into_iter().find(|(name, _)| name == "torus").unwrap().1;
    let plan = plan(&cage, BoundaryRule::EdgeAndCorner);
    let start: Vec<Vec3> = cage.positions().iter().map(|p| p.as_vec3()).collect();
    let tables = &plan.levels[0];
    assert!(tables.quads);
    let points = twin::points(&plan, &start);
    for (face, quad) in tables.face_indices.chunks_exact(4).enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| points[quad[i] as usize]);
        assert_eq!(points[tables.first_new as usize + face], (((a + b) + c) + d) * 0.25);
    }
}
