//! The compute kernels against their twins on the host.

use glam::{DVec3, Vec3};
use osculate::{BoundaryRule, Scheme, Surface};
use osculate_subdiv::twin;
use osculate_tests::{gpu, rules_of, surface, surface_of, zoo};

fn cage_points(surface: &Surface, points: &[DVec3]) -> Vec<Vec3> {
    points.iter().map(|&p| surface.space().enter(p)).collect()
}

fn assert_same_bits<const N: usize>(name: &str, ours: &[[f32; N]], twin: &[[f32; N]], exact: bool) {
    assert_eq!(ours.len(), twin.len(), "{name}");
    for (i, (a, b)) in ours.iter().zip(twin).enumerate() {
        if exact {
            assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "{name} {i}: {a:?} on the device, {b:?} on the host");
        } else {
            let error = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(error < 4e-6, "{name} {i}: {a:?} on the device, {b:?} on the host");
        }
    }
}

/// On llvmpipe division and square root round correctly, so the bits are equal; on other devices they need not.
#[test]
fn points_and_records_are_those_of_the_twins() {
    let gpu = gpu();
    let exact = gpu.device().info().is_llvmpipe;
    let mut compared = 0;
    for (specimen, scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |&s| (specimen, s))) {
        for &rule in rules_of(&specimen.cage) {
            let Some(surface) = surface_of(&gpu, &specimen.cage, scheme, Some(rule)) else { continue };
            let name = format!("{}, {scheme}, {rule:?}", specimen.name);
            let points = twin::points(surface.plan(), &cage_points(&surface, specimen.cage.positions()));
            let arrays: Vec<[f32; 3]> = points.iter().map(|p| p.to_array()).collect();
            assert_same_bits(&format!("{name}: point"), &surface.read_points().unwrap(), &arrays, exact);
            let records: Vec<[f32; 3]> =
                twin::vertex_records(surface.plan(), &points).into_iter().flatten().map(|p| p.to_array()).collect();
            assert_same_bits(
                &format!("{name}: vertex record"),
                &surface.read_vertex_records().unwrap(),
                &records,
                exact,
            );
            let records: Vec<[f32; 3]> =
                twin::edge_records(surface.plan(), &points).into_iter().flatten().map(|p| p.to_array()).collect();
            assert_same_bits(&format!("{name}: edge record"), &surface.read_edge_records().unwrap(), &records, exact);
            let coefficients: Vec<[f32; 3]> =
                twin::coefficients(surface.plan(), &points).into_iter().map(|p| p.to_array()).collect();
            assert_same_bits(
                &format!("{name}: coefficient"),
                &surface.read_coefficients().unwrap(),
                &coefficients,
                exact,
            );
            compared += arrays.len();
        }
    }
    assert!(compared > 100_000, "only {compared} points compared");
}

#[test]
fn moved_points_take_everything_with_them() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let mut moving = surface(&gpu, &cage, Some(BoundaryRule::EdgeAndCorner)).unwrap();
    let moved: Vec<DVec3> = cage.positions().iter().map(|p| *p * 0.75 + DVec3::new(0.125, 0.0, -0.25)).collect();
    moving.set_points(&moved).unwrap();
    let expected = twin::points(moving.plan(), &cage_points(&moving, &moved));
    let expected: Vec<[f32; 3]> = expected.iter().map(|p| p.to_array()).collect();
    assert_same_bits("moved point", &moving.read_points().unwrap(), &expected, gpu.device().info().is_llvmpipe);
    let error = moving.set_points(&moved[1..]).unwrap_err();
    assert!(error.to_string().contains("points"), "{error}");
    let mut broken = moved.clone();
    broken[3].y = f64::NAN;
    let error = moving.set_points(&broken).unwrap_err();
    assert!(error.to_string().contains("vertex 3"), "{error}");
}
