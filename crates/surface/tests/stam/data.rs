//! Against reference data from another implementation.

use glam::DVec3;
use osculate_surface::stam::Patch;
use osculate_surface::{Matrix, NetKind, gregory};
use serde_json::Value;

use crate::fixtures::{crease, gap, interior};
use crate::reference_data::{net, numbers, reference, rows};

fn array(value: &Value) -> &[Value] {
    value.as_array().expect("array")
}

fn integer(value: &Value) -> u32 {
    value.as_u64().and_then(|x| u32::try_from(x).ok()).expect("small integer")
}

fn largest_gap(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

/// The gap between two sets of eigenvalues.
fn spectrum_gap(a: &[f64], b: &[f64]) -> f64 {
    let sorted = |x: &[f64]| {
        let mut x = x.to_vec();
        x.sort_by(f64::total_cmp);
        x
    };
    largest_gap(&sorted(a), &sorted(b))
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn eigenvalues_and_functions_of_net_points() {
    let data = reference("stam.json");
    let valences = data["valences"].as_object().expect("object");
    assert_eq!(valences.len(), 10);
    for (n, tables) in valences {
        let patch = Patch::new(interior(n.parse().expect("valence")));
        let spectrum = spectrum_gap(patch.eigenvalues(), &numbers(&tables["lambda"]));
        // Eigenvectors are free to scale and turn; the functions of the net's points at levels 0 and 1 are not.
        let (lambda, inverse) = (numbers(&tables["lambda"]), Matrix::from_rows(&rows(&tables["Vinv"])));
        let mut functions = 0.0_f64;
        for (sub_patch, expected) in array(&tables["eigenbasis_bezier_16xK"]).iter().enumerate() {
            let expected = Matrix::from_rows(&rows(expected));
            for level in [0, 1] {
                let powers =
                    |m: &Matrix, l: &[f64]| Matrix::from_fn(m.rows(), m.cols(), |r, c| m.get(r, c) * l[c].powi(level));
                let own = powers(patch.basis(sub_patch), patch.eigenvalues()).mul(patch.projection());
                let expected = powers(&expected, &lambda).mul(&inverse);
                functions = functions.max(largest_gap(own.as_slice(), expected.as_slice()));
            }
        }
        println!("valence {n}: eigenvalues {spectrum:.1e}, functions {functions:.1e}");
        assert!(spectrum < 1e-14 && functions < 1e-13, "valence {n}: {spectrum:e} {functions:e}");
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn samples_of_interior_vertices() {
    let data = reference("samples.json");
    let cases = array(&data["cases"]);
    assert_eq!(cases.len(), 10);
    for case in cases {
        let kind = interior(integer(&case["n"]));
        let (patch, net) = (Patch::new(kind), net(&case["net"]));
        let coefficients = patch.project(&net);
        let (mut position, mut normal) = (0.0_f64, 0.0_f64);
        for sample in array(&case["eval"]) {
            let (uv, expected) = (numbers(&sample["uv"]), rows(&sample["cc"]));
            let at = patch.evaluate(&coefficients, uv[0], uv[1]).position;
            position = position.max((at - DVec3::from_slice(&expected[0])).length());
            let own = patch.normal(&coefficients, uv[0], uv[1]).or_else(|| vertex_normal(kind, &net));
            normal = normal.max(gap(own, DVec3::from_slice(&expected[1])));
        }
        println!("{kind:?}: position {position:.1e}, normal {normal:.1e}");
        assert!(position < 1e-13 && normal < 1e-12, "{kind:?}: {position:e} {normal:e}");
    }
}

fn vertex_normal(kind: NetKind, net: &[DVec3]) -> Option<DVec3> {
    let record = gregory::vertex(kind, 0).apply(net);
    record[1].cross(record[2]).try_normalize()
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn samples_of_boundary_vertices() {
    let data = reference("stam_boundary.json");
    let parameters = rows(&data["uv"]);
    let cases: Vec<_> = array(&data["cases"]).iter().filter(|case| case["kind"] == "crease").collect();
    assert_eq!(cases.len(), 9);
    for case in cases {
        let kind = crease(integer(&case["k"]), integer(&case["j"]));
        let (patch, net) = (Patch::new(kind), net(&case["net"]));
        let spectrum = spectrum_gap(patch.eigenvalues(), &numbers(&case["eigenvalues"]));
        assert_eq!(patch.coupling() != 0.0, !case["pair"].is_null(), "{kind:?}");
        let coefficients = patch.project(&net);
        let (mut position, mut normal) = (0.0_f64, 0.0_f64);
        for (uv, expected) in parameters.iter().zip(rows(&case["expect"])) {
            let at = patch.evaluate(&coefficients, uv[0], uv[1]).position;
            position = position.max((at - DVec3::from_slice(&expected[..3])).length());
            let own = patch.normal(&coefficients, uv[0], uv[1]).or_else(|| vertex_normal(kind, &net));
            normal = normal.max(gap(own, DVec3::from_slice(&expected[3..])));
        }
        println!("{kind:?}: eigenvalues {spectrum:.1e}, position {position:.1e}, normal {normal:.1e}");
        // The reference holds 12 digits of eigenvalues, 15 of points.
        assert!(spectrum < 1e-12 && position < 1e-13 && normal < 1e-12, "{kind:?}: {position:e} {normal:e}");
    }
}
