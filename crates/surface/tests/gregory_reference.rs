//! Gregory matrices against reference data from another implementation, and their distance to the exact limit on its
//! nets. Run with `--nocapture` to see the figures.

mod reference_data;
mod star;

use glam::DVec3;
use osculate_surface::{Matrix, NetKind, bezier, gregory};
use reference_data::{net, numbers, point, reference, rows};
use serde_json::Value;
use star::{Star, degrees};

fn integer(value: &Value) -> u32 {
    value.as_u64().and_then(|x| u32::try_from(x).ok()).expect("small integer")
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn matrices_equal_the_reference() {
    let data = reference("gregory2.json");
    let valences = data["valences"].as_object().expect("object");
    assert_eq!(valences.len(), 10);
    let (mut worst, mut worst_stored) = (0.0_f64, 0.0_f64);
    for (n, tables) in valences {
        let valence: u32 = n.parse().expect("valence");
        let kind = NetKind::Interior { valence };
        let g = Matrix::from_rows(&rows(&tables["G"]));
        worst = worst.max(largest_difference(&gregory::gregory2(kind), 0, &g));
        let edge = gregory::edge(kind, 0);
        worst = worst.max(reference_record_gap(kind, &g, &edge));
        // C and D are stored rounded to f32; D as difference of control points, a third of the derivative.
        let stored =
            rows(&tables["D"]).iter().map(|row| row.iter().map(|w| 3.0 * w).collect()).collect::<Vec<Vec<_>>>();
        worst_stored = worst_stored.max(largest_difference(&edge, 0, &Matrix::from_rows(&rows(&tables["C"]))));
        worst_stored = worst_stored.max(largest_difference(&edge, 4, &Matrix::from_rows(&stored)));
    }
    println!("valence 3..12: G and C, D from it {worst:.1e}; C, D as stored in f32 {worst_stored:.1e}");
    assert!(worst < 1e-12, "{worst:e}");
    assert!(worst_stored < 1e-7, "{worst_stored:e}");
}

/// The largest difference of `expected` to the rows of `own` from `first` on; columns that it lacks are zero.
fn largest_difference(own: &Matrix, first: usize, expected: &Matrix) -> f64 {
    let at = |r: usize, c: usize| if c < expected.cols() { expected.get(r, c) } else { 0.0 };
    (0..expected.rows())
        .flat_map(|r| own.row(first + r).iter().enumerate().map(move |(c, w)| (r, c, w)))
        .fold(0.0, |worst, (r, c, w)| worst.max((w - at(r, c)).abs()))
}

/// The largest difference of the record of spoke 0 to the one that the reference's patches on both sides give.
fn reference_record_gap(kind: NetKind, g: &Matrix, edge: &Matrix) -> f64 {
    let star = Star::over_plane(kind, |x, y| x * y, 0.2, 3);
    let (left, right) = (g.apply(&star.net(kind, 0)), g.apply(&star.net(kind, -1)));
    let curve = [0, 1, 7, 5].map(|i| left[i]);
    // Second rows of control points: p, f, f, p of the ends beside spoke 0 on the left and on the right.
    let (inner, outer) = ([2, 3, 9, 6].map(|i| left[i]), [1, 4, 18, 17].map(|i| right[i]));
    let own = edge.apply(&star.net(kind, 0));
    (0..4)
        .map(|i| (own[i] - curve[i]).length().max((own[4 + i] - 1.5 * (inner[i] - outer[i])).length()))
        .fold(0.0, f64::max)
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn samples_equal_the_reference_and_stay_near_the_limit() {
    let data = reference("samples.json");
    let cases = data["cases"].as_array().expect("array");
    assert_eq!(cases.len(), 10);
    for case in cases {
        let n = integer(&case["n"]);
        let kind = NetKind::Interior { valence: n };
        let net = net(&case["net"]);
        let points = gregory::gregory2(kind).apply(&net).try_into().expect("20 rows");
        let alone = Star::from_net(kind, &net);
        let (mut error, mut limit_error, mut gap, mut angle) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        for sample in case["eval"].as_array().expect("array") {
            let uv = numbers(&sample["uv"]);
            let frozen = bezier::patch(&gregory::bezier_grid(&points, uv[0], uv[1]), uv[0], uv[1]);
            let (expected, limit) = (&sample["gregory2_frozen"], &sample["cc"]);
            let normal = frozen.normal().expect("regular point");
            error = error.max((frozen.position - point(&expected[0])).length());
            error = error.max((normal - point(&expected[1])).length());
            gap = gap.max((frozen.position - point(&limit[0])).length());
            angle = angle.max(degrees(normal, point(&limit[1])));
            if uv[0] + uv[1] > 0.0 {
                limit_error = limit_error.max((alone.limit(0, uv[0], uv[1]).0 - point(&limit[0])).length());
            }
        }
        let distance = alone.patch_distance(kind, 0, 16);
        println!(
            "valence {n:2}: samples {error:.1e}, limit at equal (u,v) {gap:.4} and {angle:.2} deg, distance {distance:.4}"
        );
        assert!(error < 1e-12 && limit_error < 1e-12, "valence {n}: {error:e} {limit_error:e}");
        assert!(distance < 0.06 && angle < 20.0, "valence {n}: {distance} {angle}");
        assert!(n != 4 || gap < 1e-13, "valence 4 is the bicubic");
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn creases_stay_near_the_limit() {
    let data = reference("stam_boundary.json");
    let parameters = rows(&data["uv"]);
    let cases: Vec<_> = data["cases"].as_array().expect("array").iter().filter(|c| c["kind"] == "crease").collect();
    assert_eq!(cases.len(), 9);
    for case in cases {
        let kind = NetKind::Crease { faces: integer(&case["k"]), quad: integer(&case["j"]) };
        let quad = i64::from(integer(&case["j"]));
        let net = net(&case["net"]);
        let points = gregory::gregory2(kind).apply(&net).try_into().expect("20 rows");
        let (mut gap, mut angle, mut exact) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (uv, expected) in parameters.iter().zip(rows(&case["expect"])) {
            let (position, normal) = (DVec3::from_slice(&expected[..3]), DVec3::from_slice(&expected[3..]));
            if uv[0] + uv[1] == 0.0 {
                let record = gregory::vertex(kind, 0).apply(&net);
                exact = exact.max((record[0] - position).length());
                exact = exact.max((record[1].cross(record[2]).normalize() - normal).length());
                continue;
            }
            let jet = gregory::evaluate(&points, uv[0], uv[1]);
            gap = gap.max((jet.position - position).length());
            angle = angle.max(degrees(jet.du.cross(jet.dv), normal));
            if kind.side_is_sharp(0) && uv[1] == 0.0 || kind.side_is_sharp(3) && uv[0] == 0.0 {
                exact = exact.max((jet.position - position).length());
            }
        }
        let distance = Star::from_net(kind, &net).patch_distance(kind, quad, 16);
        println!(
            "{kind:?}: V and sharp sides {exact:.1e}, limit at equal (u,v) {gap:.4} and {angle:.2} deg, distance {distance:.4}"
        );
        assert!(exact < 1e-12, "{kind:?}: {exact:e}");
        // Twelve narrow quads between rough heights: the face points follow single points of the ring.
        let steepest = if kind.net_size() > 25 { 50.0 } else { 8.0 };
        assert!(angle < steepest, "{kind:?}: {angle} degrees");
        assert!(distance < 0.06 && gap < 0.25, "{kind:?}: {distance} {gap}");
    }
}
