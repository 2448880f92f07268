//! Biseptic patches against each other across spokes, their bicubic neighbours, the limit surface and their f32 twin.

mod star;

use glam::{DMat3, DVec3, Vec3};
use osculate_surface::biseptic::{self, POSSIBLE_VALENCES, VALENCES, twin};
use osculate_surface::jet::Jet;
use osculate_surface::{Matrix, NetKind, bezier, bspline, gregory};
use star::{Star, degrees, regular_limit};

fn kind(valence: u32) -> NetKind {
    NetKind::Interior { valence }
}

fn bumpy(valence: u32, seed: u64) -> Star {
    Star::over_plane(kind(valence), |x, y| 0.2 * (x * x - y * y) + 0.1 * x, 0.1, seed)
}

fn points(matrix: &Matrix, net: &[DVec3]) -> [DVec3; 64] {
    matrix.apply(net).try_into().expect("64 rows")
}

/// The patches of all quads of a star.
fn patches(valence: u32, star: &Star) -> Vec<[DVec3; 64]> {
    let matrix = biseptic::patch(valence);
    (0..i64::from(valence)).map(|i| points(&matrix, &star.net(kind(valence), i))).collect()
}

fn eight(points: &[DVec3]) -> [DVec3; 8] {
    points.try_into().expect("eight points")
}

fn unit_gap(a: DVec3, b: DVec3) -> f64 {
    (a.normalize() - b.normalize()).length()
}

/// (u, v) at `t` along side `side`.
fn on_side(side: usize, t: f64) -> (f64, f64) {
    [(t, 0.0), (1.0, t), (1.0 - t, 1.0), (0.0, 1.0 - t)][side]
}

fn steps(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| f64::from(i) / f64::from(count))
}

/// The second fundamental form as a symmetric tensor in space: equal for equal surfaces, whatever their parameters.
fn curvature_tensor(jet: &Jet) -> DMat3 {
    let normal = jet.normal().expect("regular point");
    let (e, f, g) = (jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv));
    let area = e * g - f * f;
    let (a, b) = ((g * jet.du - f * jet.dv) / area, (e * jet.dv - f * jet.du) / area);
    let outer = |x: DVec3, y: DVec3| DMat3::from_cols(x * y.x, x * y.y, x * y.z);
    let (l, m, n) = (jet.duu.dot(normal), jet.duv.dot(normal), jet.dvv.dot(normal));
    outer(a, a) * l + (outer(a, b) + outer(b, a)) * m + outer(b, b) * n
}

fn tensor_gap(a: &Jet, b: &Jet) -> f64 {
    let gap = curvature_tensor(a) - curvature_tensor(b);
    gap.to_cols_array().into_iter().fold(0.0, |worst, x| worst.max(x.abs()))
}

fn figures(values: &[f64]) -> String {
    values.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>().join(" ")
}

#[test]
fn points_sum_to_one_and_vectors_to_zero() {
    for valence in POSSIBLE_VALENCES {
        let worst = |m: &Matrix, rows: std::ops::Range<usize>, sum: f64| {
            rows.map(|r| (m.row(r).iter().sum::<f64>() - sum).abs()).fold(0.0, f64::max)
        };
        let patch = biseptic::patch(valence);
        assert_eq!((patch.rows(), patch.cols()), (64, kind(valence).net_size()));
        assert!(worst(&patch, 0..64, 1.0) < 2e-13, "valence {valence}: {:e}", worst(&patch, 0..64, 1.0));
        for side in [0, 3] {
            let edge = biseptic::edge(valence, side);
            assert_eq!((edge.rows(), edge.cols()), (16, kind(valence).net_size()));
            assert!(worst(&edge, 0..8, 1.0) < 2e-13 && worst(&edge, 8..16, 0.0) < 2e-13, "valence {valence}");
        }
    }
}

#[test]
fn weights_stay_bounded() {
    for valence in POSSIBLE_VALENCES {
        let worst = |m: &Matrix| m.as_slice().iter().fold(0.0_f64, |w, x| w.max(x.abs()));
        let (patch, edge) = (worst(&biseptic::patch(valence)), worst(&biseptic::edge(valence, 0)));
        assert!(patch < 1.0 && edge < 1.0, "valence {valence}: {patch} {edge}");
    }
}

#[test]
fn valence_four_is_the_bicubic_with_derivatives() {
    let star = bumpy(4, 3);
    let patch = patches(4, &star)[0];
    let grid = star.regular_net(0, 0, 0);
    for (u, v) in steps(8).flat_map(|u| steps(8).map(move |v| (u, v))) {
        let (p, du, dv) = regular_limit(&grid, u, v);
        let jet = biseptic::evaluate(&patch, u, v);
        let error = (jet.position - p).length().max((jet.du - du).length()).max((jet.dv - dv).length());
        assert!(error < 5e-13, "({u},{v}): {error:e}");
    }
}

#[test]
fn curvature_is_continuous_across_spokes() {
    for valence in POSSIBLE_VALENCES {
        let mut worst = [0.0_f64; 3];
        for seed in 0..4 {
            let all = patches(valence, &bumpy(valence, seed));
            for (i, p) in all.iter().enumerate() {
                let q = &all[(i + all.len() - 1) % all.len()];
                for t in steps(32) {
                    let (p, q) = (biseptic::evaluate(p, t, 0.0), biseptic::evaluate(q, 0.0, t));
                    worst[0] = worst[0].max((p.position - q.position).length());
                    worst[1] = worst[1].max(unit_gap(p.normal().expect("regular"), q.normal().expect("regular")));
                    worst[2] = worst[2].max(tensor_gap(&p, &q));
                }
            }
        }
        println!("valence {valence:2}: position, normal, curvature {}", figures(&worst));
        assert!(worst.iter().all(|&gap| gap < 1e-10), "valence {valence}: {}", figures(&worst));
    }
}

#[test]
fn curvature_at_the_vertex_is_one_tensor() {
    for valence in POSSIBLE_VALENCES {
        let all = patches(valence, &bumpy(valence, 5));
        let first = biseptic::evaluate(&all[0], 0.0, 0.0);
        let worst = all.iter().map(|p| tensor_gap(&first, &biseptic::evaluate(p, 0.0, 0.0))).fold(0.0, f64::max);
        assert!(worst < 1e-10, "valence {valence}: {worst:e}");
    }
}

#[test]
fn curvature_gap_sees_patches_that_only_share_tangent_planes() {
    let star = bumpy(5, 7);
    let of = |i: i64| gregory::gregory2(kind(5)).apply(&star.net(kind(5), i)).try_into().expect("20 rows");
    let (p, q) = (gregory::evaluate(&of(0), 0.5, 0.0), gregory::evaluate(&of(-1), 0.0, 0.5));
    assert!(unit_gap(p.normal().expect("regular"), q.normal().expect("regular")) < 1e-12);
    assert!(tensor_gap(&p, &q) > 1e-3, "{:e}", tensor_gap(&p, &q));
}

#[test]
fn outer_sides_meet_bicubic_neighbours_with_second_derivatives() {
    for valence in POSSIBLE_VALENCES {
        let star = bumpy(valence, 11);
        let patch = patches(valence, &star)[0];
        for (side, (a, b)) in [(1, (1, 0)), (2, (0, 1))] {
            let net = star.regular_net(0, a, b);
            let neighbour: [DVec3; 16] = bspline::patch_to_bezier().apply(&net).try_into().expect("16 rows");
            for t in steps(16) {
                let (u, v) = on_side(side, t);
                let own = biseptic::evaluate(&patch, u, v);
                let other = bezier::patch(&neighbour, u - a as f64, v - b as f64);
                let gaps = [
                    own.position - other.position,
                    own.du - other.du,
                    own.dv - other.dv,
                    own.duu - other.duu,
                    own.duv - other.duv,
                    own.dvv - other.dvv,
                ];
                let worst = gaps.iter().fold(0.0_f64, |worst, gap| worst.max(gap.length()));
                assert!(worst < 1e-12, "valence {valence} side {side} t {t}: {worst:e}");
            }
        }
    }
}

#[test]
fn outer_sides_are_the_cubic_records() {
    for valence in POSSIBLE_VALENCES {
        let net = bumpy(valence, 13).net(kind(valence), 0);
        let patch = points(&biseptic::patch(valence), &net);
        for side in [1, 2] {
            let record = gregory::edge(kind(valence), side).apply(&net);
            let half = |from: usize| -> [DVec3; 4] { record[from..from + 4].try_into().expect("four points") };
            for t in steps(16) {
                let (u, v) = on_side(side, t);
                let jet = biseptic::evaluate(&patch, u, v);
                let (position, tangent) = bezier::curve(&half(0), t);
                let cross = bezier::curve(&half(4), t).0;
                assert!((position - jet.position).length() < 5e-15, "valence {valence} side {side}");
                let gap = unit_gap(tangent.cross(cross), jet.normal().expect("regular"));
                assert!(gap < 1e-13, "valence {valence} side {side} t {t}: {gap:e}");
            }
        }
    }
}

#[test]
fn spoke_records_are_the_patches_own_sides() {
    for valence in POSSIBLE_VALENCES {
        let net = bumpy(valence, 17).net(kind(valence), 0);
        let patch = points(&biseptic::patch(valence), &net);
        for side in [0, 3] {
            let record = biseptic::edge(valence, side).apply(&net);
            for t in steps(16) {
                let (u, v) = on_side(side, t);
                let jet = biseptic::evaluate(&patch, u, v);
                let (position, tangent) = biseptic::curve(&eight(&record[..8]), t);
                let cross = biseptic::curve(&eight(&record[8..]), t).0;
                assert!((position - jet.position).length() < 5e-15, "valence {valence} side {side}");
                let gap = unit_gap(tangent.cross(cross), jet.normal().expect("regular"));
                assert!(gap < 1e-12, "valence {valence} side {side} t {t}: {gap:e}");
            }
        }
    }
}

#[test]
fn cross_derivative_is_half_the_difference_of_both_patches() {
    for valence in POSSIBLE_VALENCES {
        let star = bumpy(valence, 19);
        let all = patches(valence, &star);
        let (p, q) = (&all[0], &all[valence as usize - 1]);
        let record = biseptic::edge(valence, 0).apply(&star.net(kind(valence), 0));
        for t in steps(8) {
            let expected = (biseptic::evaluate(p, t, 0.0).dv - biseptic::evaluate(q, 0.0, t).du) / 2.0;
            let gap = (biseptic::curve(&eight(&record[8..]), t).0 - expected).length();
            assert!(gap < 1e-13, "valence {valence} t {t}: {gap:e}");
        }
    }
}

/// Where the points of quad i+1's net are in quad i's, for those that side 0 of the former and side 3 of the latter
/// share.
fn shared_points(valence: u32) -> Vec<(usize, usize)> {
    let n = valence as usize;
    let ring = (0..2 * n).map(|h| (1 + (h + 2) % (2 * n), 1 + h));
    std::iter::once((0, 0)).chain(ring).chain((0..3).map(|o| (2 * n + 5 + o, 2 * n + 1 + o))).collect()
}

#[test]
fn both_patches_of_a_spoke_have_its_record_bit_for_bit() {
    for valence in POSSIBLE_VALENCES {
        let (towards, away) = (biseptic::edge(valence, 3), biseptic::edge(valence, 0));
        let (mut weights, shared) = (0, shared_points(valence));
        for &(mine, theirs) in &shared {
            for i in 0..8 {
                assert_eq!(towards.get(i, mine), away.get(7 - i, theirs), "valence {valence} C");
                assert_eq!(towards.get(8 + i, mine), -away.get(15 - i, theirs), "valence {valence} D");
                weights += usize::from(towards.get(i, mine) != 0.0) + usize::from(towards.get(8 + i, mine) != 0.0);
            }
        }
        let all = towards.as_slice().iter().filter(|&&w| w != 0.0).count();
        assert_eq!(weights, all, "valence {valence}: a weight on a point that the other patch lacks");
    }
}

#[test]
fn spoke_rows_of_the_patch_are_the_record() {
    for valence in POSSIBLE_VALENCES {
        let (patch, first, last) = (biseptic::patch(valence), biseptic::edge(valence, 0), biseptic::edge(valence, 3));
        for i in 0..8 {
            assert_eq!(patch.row(i), first.row(i), "valence {valence}");
            assert_eq!(patch.row(8 * i), last.row(7 - i), "valence {valence}");
        }
    }
}

#[test]
fn mirrored_nets_give_mirrored_patches_bit_for_bit() {
    for valence in POSSIBLE_VALENCES {
        let (n, patch) = (valence as usize, biseptic::patch(valence));
        let mirrored = |col: usize| match col {
            0 => 0,
            ring if ring <= 2 * n => 1 + (2 * n + 3 - ring) % (2 * n),
            outer => 4 * n + 8 - outer,
        };
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
            for col in 0..patch.cols() {
                let (own, other) = (patch.get(i + 8 * j, col), patch.get(j + 8 * i, mirrored(col)));
                assert_eq!(own, other, "valence {valence} ({i},{j})");
            }
        }
    }
}

#[test]
fn vertex_has_the_limit_position_and_tangent_plane() {
    for valence in POSSIBLE_VALENCES {
        let star = bumpy(valence, 23);
        let net = star.net(kind(valence), 0);
        let rows = gregory::vertex(kind(valence), 0).apply(&net);
        let limit = star.limit_centre();
        for patch in patches(valence, &star) {
            let jet = biseptic::evaluate(&patch, 0.0, 0.0);
            assert!((jet.position - rows[0]).length() < 5e-15 && (jet.position - limit).length() < 1e-13);
            let gap = unit_gap(jet.normal().expect("regular"), rows[1].cross(rows[2]));
            assert!(gap < 1e-12, "valence {valence}: {gap:e}");
        }
    }
}

#[test]
fn regular_corners_are_limits_too() {
    for valence in POSSIBLE_VALENCES {
        let star = bumpy(valence, 29);
        let patch = patches(valence, &star)[0];
        for (u, v) in [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            let (jet, (p, du, dv)) = (biseptic::evaluate(&patch, u, v), star.limit(0, u, v));
            assert!((jet.position - p).length() < 5e-15, "valence {valence}");
            assert!(unit_gap(jet.normal().expect("regular"), du.cross(dv)) < 1e-13, "valence {valence}");
        }
    }
}

#[test]
fn planar_rings_do_not_fold() {
    for valence in POSSIBLE_VALENCES {
        let patch = patches(valence, &Star::over_plane(kind(valence), |_, _| 0.0, 0.0, 0))[0];
        let area = |(u, v)| {
            let jet = biseptic::evaluate(&patch, u, v);
            jet.du.cross(jet.dv).z
        };
        let smallest = steps(32).flat_map(|u| steps(32).map(move |v| (u, v))).map(area).fold(f64::INFINITY, f64::min);
        println!("valence {valence:2}: area factor at least {smallest:.2}");
        assert!(smallest > 0.25, "valence {valence}: {smallest}");
    }
}

/// The largest distance of a star's patches to its limit surface.
fn distance_to_limit(valence: u32, star: &Star, quads: i64) -> f64 {
    let all = patches(valence, star);
    let mut worst = 0.0_f64;
    for i in 0..quads {
        for (u, v) in steps(12).flat_map(|u| steps(12).map(move |v| (u, v))) {
            let position = biseptic::evaluate(&all[i as usize], u, v).position;
            worst = worst.max(star.distance(position, i, u, v));
        }
    }
    worst
}

/// Bounds on the distance to the limit of rings with edges of length 1, per valence from 3.
const DISTANCES: [f64; 12] = [0.006, 1e-8, 0.0035, 0.0095, 0.014, 0.023, 0.025, 0.0245, 0.04, 0.0385, 0.0365, 0.0335];

#[test]
fn patches_stay_near_the_limit() {
    for (valence, bound) in POSSIBLE_VALENCES.zip(DISTANCES) {
        let shape = |z: fn(f64, f64) -> f64, jitter| Star::over_plane(kind(valence), z, jitter, 31);
        let bowl = distance_to_limit(valence, &shape(|x, y| 0.3 * (x * x + y * y), 0.0), 1);
        let saddle = distance_to_limit(valence, &shape(|x, y| 0.3 * (x * x - y * y), 0.0), 2);
        let random = distance_to_limit(valence, &shape(|_, _| 0.0, 0.15), 3);
        println!("valence {valence:2}: bowl {bowl:.4}, saddle {saddle:.4}, random {random:.4}");
        assert!(bowl.max(saddle).max(random) < bound, "valence {valence}");
    }
}

/// Least and largest mean curvature of the patch of quad 0.
fn bending(valence: u32, star: &Star) -> (f64, f64) {
    let patch = patches(valence, star)[0];
    let mean = |(u, v)| biseptic::evaluate(&patch, u, v).curvature().expect("regular").mean;
    let samples = steps(24).flat_map(|u| steps(24).map(move |v| (u, v))).map(mean);
    samples.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
}

#[test]
fn bowls_and_saddles_bend_evenly() {
    for valence in POSSIBLE_VALENCES {
        let of = |z: fn(f64, f64) -> f64| bending(valence, &Star::over_plane(kind(valence), z, 0.0, 0));
        let (bowl, saddle) = (of(|x, y| 0.3 * (x * x + y * y)), of(|x, y| 0.3 * (x * x - y * y)));
        println!("valence {valence:2}: bowl {bowl:.2?}, saddle {saddle:.2?}");
        // The graphs themselves have 0.35 to 0.60 and nearly 0.
        if VALENCES.contains(&valence) {
            assert!(bowl.0 > 0.25 && bowl.1 < 0.78, "valence {valence}: {bowl:?}");
            assert!(saddle.0 > -0.54 && saddle.1 < 0.16, "valence {valence}: {saddle:?}");
        }
    }
}

#[test]
fn corners_of_a_cube_are_round() {
    // Once refined, a cube of half edge 1 has points of three kinds, by how many coordinates are midway.
    let cube = Star::new(kind(3), |spoke, a, b| {
        let mut steps = [0; 3];
        steps[spoke.rem_euclid(3) as usize] = a.min(2);
        steps[(spoke + 1).rem_euclid(3) as usize] = b.min(2);
        let midway = steps.iter().filter(|&&s| s == 1).count();
        let size = [5.0 / 9.0, 0.75, 1.0][midway];
        DVec3::from_array(steps.map(|s| size * (1 - s) as f64))
    });
    let (low, high) = bending(3, &cube);
    println!("mean curvature {low:.2} to {high:.2}");
    // Outward normals: a sphere bends away from them.
    assert!(low > -1.44 && high < -0.98, "{low} {high}");
}

fn rounded(net: &[DVec3]) -> (Vec<Vec3>, Vec<DVec3>) {
    let single: Vec<Vec3> = net.iter().map(|p| p.as_vec3()).collect();
    let exact = single.iter().map(|p| p.as_dvec3()).collect();
    (single, exact)
}

/// Largest errors of the f32 twin inside patches: position, normal, and curvatures relative to the largest.
fn twin_errors(valence: u32, offset: DVec3) -> [f64; 3] {
    let matrix = biseptic::patch(valence);
    let net: Vec<DVec3> = bumpy(valence, 37).net(kind(valence), 0).iter().map(|&p| p + offset).collect();
    let (single, exact) = rounded(&net);
    let control = twin::control_points(&matrix.to_f32(), &single);
    let patch = points(&matrix, &exact);
    let (mut errors, mut bend) = ([0.0_f64; 3], 0.0_f64);
    for (u, v) in steps(16).flat_map(|u| steps(16).map(move |v| (u, v))) {
        let expected = biseptic::evaluate(&patch, u, v);
        let (point, second) =
            (twin::patch_point(&control, u as f32, v as f32), twin::second_derivatives(&control, u as f32, v as f32));
        let got = Jet {
            position: point.position.as_dvec3(),
            du: point.du.as_dvec3(),
            dv: point.dv.as_dvec3(),
            duu: second.duu.as_dvec3(),
            duv: second.duv.as_dvec3(),
            dvv: second.dvv.as_dvec3(),
        };
        errors[0] = errors[0].max((got.position - expected.position).length());
        errors[1] = errors[1].max(unit_gap(got.normal().expect("regular"), expected.normal().expect("regular")));
        errors[2] = errors[2].max(tensor_gap(&got, &expected));
        bend = bend.max(curvature_tensor(&expected).to_cols_array().into_iter().fold(0.0, |w, x| w.max(x.abs())));
    }
    errors[2] /= bend;
    errors
}

#[test]
fn twin_is_as_exact_as_f32_allows() {
    for valence in POSSIBLE_VALENCES {
        let (near, far) = (twin_errors(valence, DVec3::ZERO), twin_errors(valence, DVec3::new(1024.0, -512.0, 256.0)));
        println!("valence {valence:2}: {}, a thousand away {}", figures(&near), figures(&far));
        assert!(near[0] < 4e-7 && far[0] < 1e-4, "valence {valence}: {} {}", near[0], far[0]);
        // Directions and curvatures must not notice where the model lies.
        for errors in [near, far] {
            assert!(errors[1] < 2.5e-6 && errors[2] < 5e-5, "valence {valence}: {}", figures(&errors));
        }
    }
}

#[test]
fn twin_packs_neighbours_along_u() {
    let (single, exact) = rounded(&bumpy(5, 41).net(kind(5), 0));
    let matrix = biseptic::patch(5);
    let control = twin::control_points(&matrix.to_f32(), &single);
    let patch = points(&matrix, &exact);
    for (k, expected) in patch.iter().enumerate() {
        let got = (control.origin + control.pairs[k / 2][k % 2]).as_dvec3();
        assert!((got - *expected).length() < 1e-6, "point {k}");
    }
}

#[test]
fn twin_of_the_record_agrees_with_its_patch() {
    for valence in POSSIBLE_VALENCES {
        let (single, exact) = rounded(&bumpy(valence, 43).net(kind(valence), 0));
        let patch = points(&biseptic::patch(valence), &exact);
        let mut worst = [0.0_f64; 2];
        for side in [0, 3] {
            let record = twin::edge_record(&biseptic::edge(valence, side).to_f32(), &single);
            for t in steps(16) {
                let (u, v) = on_side(side, t);
                let expected = biseptic::evaluate(&patch, u, v);
                let (position, normal) = twin::edge_point(&record, t as f32);
                worst[0] = worst[0].max((position.as_dvec3() - expected.position).length());
                worst[1] = worst[1].max(unit_gap(normal.as_dvec3(), expected.normal().expect("regular")));
            }
        }
        println!("valence {valence:2}: {}", figures(&worst));
        assert!(worst[0] < 3e-7 && worst[1] < 1e-6, "valence {valence}: {}", figures(&worst));
    }
}

#[test]
fn valences_without_a_patch_are_refused() {
    for valence in [0, 2, 15, 200] {
        assert!(std::panic::catch_unwind(|| biseptic::patch(valence)).is_err(), "valence {valence}");
    }
    assert!(std::panic::catch_unwind(|| biseptic::edge(5, 1)).is_err());
}

#[test]
fn spokes_of_flat_rings_are_straight() {
    // A planar symmetric ring: the spoke is on its mirror line, and the normal is the plane's.
    for valence in POSSIBLE_VALENCES {
        let star = Star::over_plane(kind(valence), |_, _| 0.0, 0.0, 0);
        let record = biseptic::edge(valence, 0).apply(&star.net(kind(valence), 0));
        for t in steps(8) {
            let (p, tangent) = biseptic::curve(&eight(&record[..8]), t);
            let normal = tangent.cross(biseptic::curve(&eight(&record[8..]), t).0);
            assert!(p.y.abs() < 1e-14 && degrees(normal, DVec3::Z) < 1e-10, "valence {valence} t {t}");
        }
    }
}
