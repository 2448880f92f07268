//! From any mesh to plans: repair, cage, inspection, a plan, and its points on the host.

use arbitrary::{Result, Unstructured};
use glam::Vec3;
use osculate_cage::{BoundaryRule, Cage, CageDesc, CageError, RepairDesc, inspect, repair};
use osculate_subdiv::{NONE, PlanDesc, PlanError, Refinement, Scheme, SurfacePlan, twin};

use crate::mesh;
use crate::readers::{check_cage, is_repairable};

/// Coordinates up to this stay finite in 32 bits through every product of a kernel.
const MODERATE: f64 = 1e9;

/// The first bytes say how the mesh is repaired and planned, the others what it is.
pub(crate) fn plan(bytes: &[u8]) {
    let mut bytes = Unstructured::new(bytes);
    let Ok(case) = Case::of(&mut bytes) else { return };
    let Ok(desc) = mesh::desc(&mut bytes) else { return };
    let cage = match case.tolerance {
        None => Cage::new(desc),
        Some(weld_tolerance) => repaired(desc, RepairDesc { weld_tolerance }),
    };
    match cage {
        Ok(cage) => {
            check_cage(&cage);
            check_plan(&cage, &case);
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
    }
}

struct Case {
    /// Up to which distance a repair welds; no repair at all if there is none.
    tolerance: Option<f64>,
    scheme: Scheme,
    rule: BoundaryRule,
}

impl Case {
    fn of(bytes: &mut Unstructured<'_>) -> Result<Self> {
        Ok(Self {
            tolerance: *bytes.choose(&[None, Some(0.0), Some(0.3)])?,
            scheme: *bytes.choose(Scheme::ALL)?,
            rule: *bytes.choose(&[BoundaryRule::None, BoundaryRule::EdgeOnly, BoundaryRule::EdgeAndCorner])?,
        })
    }
}

/// A repair leaves nothing that a cage must not have, and nothing for a second repair.
fn repaired(desc: CageDesc, options: RepairDesc) -> std::result::Result<Cage, CageError> {
    let once = repair(desc, &options)?;
    let warnings = once.warnings.len();
    let twice = repair(once.clone(), &options)?;
    assert_eq!(twice.warnings.len(), warnings, "{:?}", twice.warnings);
    let cage = Cage::new(once);
    if let Err(error) = &cage {
        assert!(!is_repairable(error), "a repair left {error}");
    }
    cage
}

fn check_plan(cage: &Cage, case: &Case) {
    let &Case { scheme, rule, .. } = case;
    for refinement in Refinement::ALL {
        check_refined(cage, &PlanDesc { boundary: Some(rule), scheme, refinement });
    }
}

fn check_refined(cage: &Cage, desc: &PlanDesc) {
    match SurfacePlan::build(cage, desc) {
        Ok(plan) => {
            check_numbers(&plan);
            check_places(cage, &plan);
            check_points(cage, &plan);
        }
        Err(PlanError::NothingToDraw { .. }) => {
            assert!(!desc.boundary.is_none_or(|rule| cage.drawn_faces(rule).contains(&true)), "{desc:?} draws nothing");
        }
        Err(error) => panic!("{desc:?}: {error}, of {:?}", inspect(cage)),
    }
}

/// All numbers of a plan name something.
fn check_numbers(plan: &SurfacePlan) {
    let points = plan.point_count;
    assert!(plan.nets.iter().all(|&point| point < points), "a net leaves the {points} points");
    let (vertices, edges) = (plan.vertex_records.count() as u32, plan.edge_record_count() as u32);
    for record in &plan.patches {
        let sides = record.sides();
        let exists = |corner: usize| match record.half_to(corner) {
            None => record.vertex[corner] < vertices,
            Some(_) => record.vertex[corner] == NONE,
        };
        assert!((0..sides).all(exists), "{record:?} of {vertices} vertex records");
        assert!(record.edge[..sides].iter().all(|&e| e / 2 < edges), "{record:?} of {edges} edge records");
    }
    assert!(plan.patch_of_quad.iter().all(|&patch| patch == NONE || (patch as usize) < plan.patches.len()));
}

/// Every patch is found again by its place on the cage.
fn check_places(cage: &Cage, plan: &SurfacePlan) {
    for (patch, &quad) in (0..).zip(&plan.quads) {
        assert_eq!(plan.patch_of_quad[quad as usize], patch);
        let place = plan.locator.place(quad, [0.25, 0.25]);
        assert!((place.sub_face.face as usize) < cage.face_count());
        let found = plan.locator.find(place.sub_face, place.st).expect("a sub-face of the cage");
        assert_eq!(found.face, quad);
    }
}

/// The kernels' twins: no index leaves its table, and moderate cages stay finite.
fn check_points(cage: &Cage, plan: &SurfacePlan) {
    let centre = cage.bounds().center();
    let own: Vec<Vec3> = cage.positions().iter().map(|&p| (p - centre).as_vec3()).collect();
    let points = twin::points(plan, &own);
    let vertices = twin::vertex_records(plan, &points);
    let edges = twin::edge_records(plan, &points);
    let coefficients = twin::coefficients(plan, &points);
    if cage.bounds().half_diagonal() < MODERATE {
        let finite = points.iter().chain(vertices.iter().flatten()).chain(edges.iter().flatten()).chain(&coefficients);
        assert!(
            finite.into_iter().all(|p| p.is_finite()),
            "{} under {:?}: a point is not finite",
            plan.scheme,
            plan.rule
        );
    }
}
