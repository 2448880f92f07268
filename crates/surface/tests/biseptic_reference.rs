//! Biseptic matrices against reference data from another implementation. Run with `--nocapture` to see the figures.

mod reference_data;
mod star;

use glam::DVec3;
use osculate_surface::{Matrix, NetKind, biseptic};
use reference_data::{net, numbers, point, reference, rows};
use star::Star;

/// The largest difference of `expected` to the rows of `own` from `first` on; columns that it lacks are zero.
fn largest_difference(own: &Matrix, first: usize, expected: &[Vec<f64>]) -> f64 {
    let gaps = expected.iter().enumerate().flat_map(|(r, row)| {
        let stored = row.iter().copied().chain(std::iter::repeat(0.0));
        own.row(first + r).iter().zip(stored).map(|(a, b)| (a - b).abs())
    });
    gaps.fold(0.0, f64::max)
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn matrices_equal_the_reference() {
    let data = reference("biseptic.json");
    let valences = data["valences"].as_object().expect("object");
    assert_eq!(valences.len(), 10);
    for (n, tables) in valences {
        let valence: u32 = n.parse().expect("valence");
        let patch = largest_difference(&biseptic::patch(valence), 0, &rows(&tables["M"]));
        println!("valence {valence:2}: patch {patch:.1e}");
        assert!(patch < 1e-12, "valence {valence}: {patch:e}");
        if valence == 4 {
            assert!(tables.get("D").is_none(), "valence 4 is regular and has no record there");
            continue;
        }
        let cross = largest_difference(&biseptic::edge(valence, 0), 8, &rows(&tables["D"]));
        println!("            cross derivative {cross:.1e}");
        assert!(cross < 1e-12, "valence {valence}: {cross:e}");
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn spokes_follow_the_reference_correspondence() {
    let data = reference("biseptic.json");
    for (n, tables) in data["valences"].as_object().expect("object") {
        let valence: u32 = n.parse().expect("valence");
        let kind = NetKind::Interior { valence };
        let star = Star::over_plane(kind, |x, y| 0.3 * (x * x + x * y), 0.15, 71);
        let of =
            |i: i64| -> [DVec3; 64] { biseptic::patch(valence).apply(&star.net(kind, i)).try_into().expect("64 rows") };
        let (p, q) = (of(0), of(-1));
        let [alpha, gamma, epsilon] = ["alpha", "gamma", "eps"].map(|name| numbers(&tables[name]));
        let mut worst = 0.0_f64;
        for step in 0..=32 {
            let u = f64::from(step) / 32.0;
            let at = |power: &[f64]| power.iter().rev().fold(0.0, |sum, c| sum * u + c);
            let (a, g, e) = (at(&alpha), at(&gamma), at(&epsilon));
            let (p, q) = (biseptic::evaluate(&p, u, 0.0), biseptic::evaluate(&q, 0.0, u));
            let first = a * (p.dv + q.du) - g * p.du;
            let second = a * (p.dvv - q.duu) - g * (p.duv - q.duv) - e * (p.dv - q.du);
            worst = worst.max(first.length()).max(second.length());
        }
        println!("valence {valence:2}: {worst:.1e}");
        assert!(worst < 1e-10, "valence {valence}: {worst:e}");
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn samples_equal_the_reference() {
    let data = reference("samples.json");
    let cases = data["cases"].as_array().expect("array");
    assert_eq!(cases.len(), 10);
    for case in cases {
        let valence = case["n"].as_u64().and_then(|n| u32::try_from(n).ok()).expect("small integer");
        let points = biseptic::patch(valence).apply(&net(&case["net"])).try_into().expect("64 rows");
        let mut worst = 0.0_f64;
        for sample in case["eval"].as_array().expect("array") {
            let uv = numbers(&sample["uv"]);
            let jet = biseptic::evaluate(&points, uv[0], uv[1]);
            let expected = &sample["biseptic"];
            worst = worst.max((jet.position - point(&expected[0])).length());
            worst = worst.max((jet.normal().expect("regular point") - point(&expected[1])).length());
        }
        println!("valence {valence:2}: samples {worst:.1e}");
        assert!(worst < 1e-12, "valence {valence}: {worst:e}");
    }
}
