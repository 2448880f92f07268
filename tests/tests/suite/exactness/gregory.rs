//! Gregory patches as the device has them: one tangent plane on both sides of every edge, corners on the limit surface.

use osculate::Scheme;
use osculate_subdiv::PatchForm;
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_tests::exact::{compare, requests};
use osculate_tests::zoo::Specimen;
use osculate_tests::{gpu, rules_of, surface_of, zoo};

use super::judge::Judge;
use super::sides::compare_normals;

#[test]
fn tangent_planes_agree_across_every_edge() {
    let gpu = gpu();
    let mut compared = 0;
    for Specimen { name, cage } in zoo::all() {
        for &rule in rules_of(&cage) {
            for scheme in [Scheme::Gregory1, Scheme::Gregory2] {
                let Some(surface) = surface_of(&gpu, &cage, scheme, Some(rule)) else { continue };
                for form in [PatchForm::Gregory, PatchForm::Triangle] {
                    compared += compare_normals(&format!("{name}, {scheme}, {rule:?}"), &cage, &surface, form)
                        .unwrap_or_else(|fault| panic!("{fault}"));
                }
            }
        }
    }
    assert!(compared > 50_000, "only {compared} points compared");
}

#[test]
fn corners_are_on_the_limit_surface() {
    let gpu = gpu();
    let mut compared = 0;
    for Specimen { name, cage } in zoo::all() {
        for &rule in rules_of(&cage) {
            let Some(surface) = surface_of(&gpu, &cage, Scheme::Gregory2, Some(rule)) else { continue };
            let mesh = Mesh::from(&cage);
            let exact = Reference::new(&mesh, Boundary::from(rule)).unwrap();
            let judge = Judge::new(format!("{name}, {rule:?}"), &cage, &surface, &exact);
            for (id, _) in (0..).zip(&surface.plan().patches).filter(|(_, record)| record.is_extraordinary()) {
                let face_size = judge.face_size(id);
                for pair in compare(&surface, &exact, &requests(&[id], &[0.0, 1.0])) {
                    judge.judge(&pair, face_size).unwrap_or_else(|fault| panic!("{fault}"));
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 10_000, "only {compared} corners compared");
}
