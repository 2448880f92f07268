//! Exact patches against the reference evaluator, on the device: inside, on spokes and other sides, at corners, and close to extraordinary vertices.

use osculate::{BoundaryRule, Cage, Engine, Scheme};
use osculate_subdiv::{PatchForm, PatchRecord};
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_tests::exact::{compare, requests, some_patches};
use osculate_tests::{gpu, reference_folder, rules_of, stars, surface_of, zoo};

use super::judge::Judge;

/// Every pair of them is sampled: 0 and 1 are sides, where records answer, and spokes down to 2^-12 of their length.
const PARAMETERS: [f32; 8] = [0.0, 1.0 / 4096.0, 1.0 / 700.0, 1.0 / 64.0, 0.25, 0.5, 0.7, 1.0];

/// Compares patches of a cage, at most `limit` of every kind and valence; returns how many points, or what is wrong with the first that is.
pub(super) fn exactness(
    engine: &Engine,
    name: &str,
    cage: &Cage,
    (scheme, rule): (Scheme, BoundaryRule),
    (limit, wanted): (usize, &dyn Fn(&PatchRecord) -> bool),
) -> Result<usize, String> {
    let Some(surface) = surface_of(engine, cage, scheme, Some(rule)) else { return Ok(0) };
    let mesh = Mesh::from(cage);
    let exact = Reference::new(&mesh, Boundary::from(rule)).unwrap();
    let judge = Judge::new(format!("{name}, {scheme}, {rule:?}"), cage, &surface, &exact);
    let mut compared = 0;
    for patch in some_patches(&surface, limit, wanted) {
        let face_size = judge.face_size(patch);
        for pair in compare(&surface, &exact, &requests(&[patch], &PARAMETERS)) {
            judge.judge(&pair, face_size)?;
            compared += 1;
        }
    }
    Ok(compared)
}

/// # Panics
/// If a point is not exact.
fn assert_exact(
    engine: &Engine,
    name: &str,
    cage: &Cage,
    setting: (Scheme, BoundaryRule),
    patches: (usize, &dyn Fn(&PatchRecord) -> bool),
) -> usize {
    exactness(engine, name, cage, setting, patches).unwrap_or_else(|fault| panic!("{fault}"))
}

#[test]
fn the_zoo_is_exact() {
    let gpu = gpu();
    let mut compared = 0;
    for specimen in zoo::all() {
        for &rule in rules_of(&specimen.cage) {
            compared += assert_exact(&gpu, &specimen.name, &specimen.cage, (Scheme::Stam, rule), (6, &|_| true));
        }
    }
    assert!(compared > 25_000, "only {compared} points compared");
}

/// Two poles of each valence; the vertices around have valence 3 or, where triangles meet, 4.
#[test]
fn every_valence_is_exact() {
    let gpu = gpu();
    let quads = (2..=64).chain([200]).map(|n| (n, stars::trapezohedron(n as usize)));
    let triangles = [3, 5, 13, 64, 200].map(|n| (n, zoo::pole(n as usize)));
    for (valence, cage) in quads.chain(triangles) {
        let at_pole = |record: &PatchRecord| record.valence() == valence;
        let setting = (Scheme::Stam, BoundaryRule::EdgeAndCorner);
        let compared = assert_exact(&gpu, &format!("poles of {valence}"), &cage, setting, (4, &at_pole));
        assert_eq!(compared, 4 * PARAMETERS.len().pow(2), "valence {valence}");
    }
}

/// Where there is no patch of continuous curvature, at boundaries and outside valence 3 to 12, that scheme takes the exact surface.
#[test]
fn patches_instead_of_biseptic_ones_are_exact() {
    let gpu = gpu();
    let boundaries = ["shell", "star7"].map(|name| (name, zoo::shipped(name)));
    let inside = [("pillow", zoo::pillow()), ("pole", stars::trapezohedron(13)), ("star32", zoo::shipped("star32"))];
    let not_biseptic = |record: &PatchRecord| record.kind().form() == PatchForm::Stam;
    for (name, cage) in boundaries.into_iter().chain([("fan", zoo::boundary_fan(6))]).chain(inside) {
        let setting = (Scheme::Biseptic, BoundaryRule::EdgeOnly);
        let compared = assert_exact(&gpu, name, &cage, setting, (6, &not_biseptic));
        assert!(compared > 0, "{name} has no such patch");
    }
}

/// The judge is no stamp: other patches than the exact ones do not pass.
#[test]
fn patches_of_another_scheme_are_not_exact() {
    let gpu = gpu();
    for name in ["twohole", "dragon", "shell"] {
        let setting = (Scheme::Gregory2, BoundaryRule::EdgeAndCorner);
        assert!(exactness(&gpu, name, &zoo::shipped(name), setting, (6, &|_| true)).is_err(), "{name}");
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn the_reference_cages_are_exact() {
    let gpu = gpu();
    let mut compared = 0;
    for file in zoo::reference_cages(&reference_folder()) {
        let Ok(cage) = Cage::read(&file) else { continue };
        let name = file.display().to_string();
        for &rule in rules_of(&cage) {
            compared += assert_exact(&gpu, &name, &cage, (Scheme::Stam, rule), (16, &|_| true));
        }
    }
    assert!(compared > 50_000, "only {compared} points compared");
}
