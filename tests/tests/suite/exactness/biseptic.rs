//! Patches of bidegree 7 as the device has them: continuous curvature across spokes, agreement with records, distance to the limit surface.

use std::collections::{BTreeSet, HashMap};

use glam::{DMat3, DVec3, Vec3};
use osculate::{Cage, Engine, Place, Scheme, Surface, SurfacePoint};
use osculate_subdiv::{PatchForm, PatchRecord};
use osculate_surface::biseptic::{self, twin};
use osculate_surface::jet::Jet;
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_tests::exact::{evaluate, requests, some_patches};
use osculate_tests::{gpu, stars, surface_of, zoo};

use super::sides::compare_normals;

pub(super) fn biseptic_surface(engine: &Engine, cage: &Cage) -> Surface {
    surface_of(engine, cage, Scheme::Biseptic, None).unwrap()
}

fn is_biseptic(record: &PatchRecord) -> bool {
    record.kind().form() == PatchForm::Biseptic
}

/// Number and control points of every biseptic patch: what the control stage makes of the device's points and weights.
fn control_points(surface: &Surface) -> Vec<(u32, twin::ControlPoints)> {
    let plan = surface.plan();
    let points: Vec<Vec3> = surface.read_points().unwrap().into_iter().map(Vec3::from).collect();
    let of = |record: &PatchRecord| {
        let net = &plan.nets[record.net as usize..][..record.net_size as usize];
        let net: Vec<Vec3> = net.iter().map(|&i| points[i as usize]).collect();
        twin::control_points(&plan.weights[record.basis as usize..][..64 * net.len()], &net)
    };
    (0..).zip(&plan.patches).filter(|(_, record)| is_biseptic(record)).map(|(id, record)| (id, of(record))).collect()
}

/// Largest difference of the device's patches from those of its control points.
pub(super) fn difference_from_twin(surface: &Surface) -> f64 {
    let mut worst = 0.0_f64;
    for (id, control) in control_points(surface) {
        let requests = requests(&[id], &[0.125, 0.4, 0.9]);
        for (request, device) in requests.iter().zip(evaluate(surface, &requests)) {
            let twin = twin::patch_point(&control, request.u, request.v);
            let pairs = [(device.position, twin.position), (device.du, twin.du), (device.dv, twin.dv)];
            worst = pairs.into_iter().fold(worst, |worst, (a, b)| worst.max((a - b.as_dvec3()).length()));
        }
    }
    worst
}

/// The patch that the device draws is that of the control points which the tests below look at. Where all operations round alike, there is no difference.
#[test]
fn the_device_evaluates_its_control_points() {
    let gpu = gpu();
    let allowed = if gpu.device().info().is_llvmpipe { 0.0 } else { 1e-5 };
    for name in ["stars", "dragon"] {
        let difference = difference_from_twin(&biseptic_surface(&gpu, &zoo::shipped(name)));
        assert!(difference <= allowed, "{name}: {difference:e}");
    }
}

/// The patch in f64, from the device's points.
fn in_f64(control: &twin::ControlPoints) -> [DVec3; 64] {
    std::array::from_fn(|k| control.pairs[k / 2][k % 2].as_dvec3() + control.origin.as_dvec3())
}

/// The second fundamental form as a symmetric tensor in space: equal for equal surfaces, whatever their parameters.
fn curvature_tensor(jet: &Jet) -> DMat3 {
    let normal = jet.normal().expect("a regular point");
    let (e, f, g) = (jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv));
    let area = e * g - f * f;
    let (a, b) = ((g * jet.du - f * jet.dv) / area, (e * jet.dv - f * jet.du) / area);
    let outer = |x: DVec3, y: DVec3| DMat3::from_cols(x * y.x, x * y.y, x * y.z);
    let (l, m, n) = (jet.duu.dot(normal), jet.duv.dot(normal), jet.dvv.dot(normal));
    outer(a, a) * l + (outer(a, b) + outer(b, a)) * m + outer(b, b) * n
}

/// Largest gaps of two patches along the spoke that they share, v = 0 of `p` and u = 0 of `q`: position, normal, curvature. Thin patches turn and bend the more by
/// a rounding error, so normals count times the height of `p` over its length, and curvatures times the square of the one over the other.
fn spoke_gaps(p: &[DVec3; 64], q: &[DVec3; 64]) -> [f64; 3] {
    let mut gaps = [0.0_f64; 3];
    for t in (0..=16).map(|i| f64::from(i) / 16.0) {
        let (p, q) = (biseptic::evaluate(p, t, 0.0), biseptic::evaluate(q, 0.0, t));
        let length = p.du.length().max(p.dv.length());
        let height = p.du.cross(p.dv).length() / length;
        let bend = (curvature_tensor(&p) - curvature_tensor(&q)).to_cols_array();
        let bend = bend.into_iter().fold(0.0_f64, |worst, x| worst.max(x.abs()));
        let turn = (p.normal().expect("a regular point") - q.normal().expect("a regular point")).length();
        let here = [(p.position - q.position).length(), turn * height / length, bend * height * height / length];
        gaps = [0, 1, 2].map(|i| gaps[i].max(here[i]));
    }
    gaps
}

/// The two patches of every spoke, as indices: the first has it as side 0, the other as side 3.
fn spokes(surface: &Surface, patches: &[(u32, twin::ControlPoints)]) -> Vec<(usize, usize)> {
    let edge = |i: usize, side: usize| surface.plan().patches[patches[i].0 as usize].edge[side] / 2;
    let right: HashMap<u32, usize> = (0..patches.len()).map(|i| (edge(i, 3), i)).collect();
    (0..patches.len()).map(|i| (i, right[&edge(i, 0)])).collect()
}

/// Largest gaps of position, in cage space, and of [`spoke_gaps`]' normals and curvatures. The points of a net are the same numbers for both patches of a spoke,
/// so all that parts them is rounding of control points, whose second differences curvature multiplies by 42.
const GAPS: [f64; 3] = [1e-7, 2e-6, 1e-4];

#[test]
fn curvature_is_continuous_across_spokes() {
    let gpu = gpu();
    let mut valences = BTreeSet::new();
    for specimen in zoo::all() {
        let surface = biseptic_surface(&gpu, &specimen.cage);
        let control = control_points(&surface);
        let patches: Vec<[DVec3; 64]> = control.iter().map(|(_, control)| in_f64(control)).collect();
        for (p, q) in spokes(&surface, &control) {
            let gaps = spoke_gaps(&patches[p], &patches[q]);
            let valence = surface.plan().patches[control[p].0 as usize].valence();
            assert!((0..3).all(|i| gaps[i] < GAPS[i]), "{}, valence {valence}: {gaps:?}", specimen.name);
            valences.insert(valence);
        }
    }
    assert!(valences.into_iter().eq([3, 5, 6, 7, 8, 9, 10, 11, 12]));
}

/// The gaps tell continuous curvature from less: beside a patch bent by a thousandth of its size within its tangent planes they are too large.
#[test]
fn a_bent_patch_has_other_curvature() {
    let surface = biseptic_surface(&gpu(), &zoo::shipped("star5"));
    let control = control_points(&surface);
    let (p, q) = spokes(&surface, &control)[0];
    let (p, mut q) = (in_f64(&control[p].1), in_f64(&control[q].1));
    let normal = biseptic::evaluate(&q, 0.0, 0.5).normal().expect("a regular point");
    for j in 2..6 {
        q[2 + 8 * j] += 1e-3 * (q[7] - q[0]).length() * normal;
    }
    let gaps = spoke_gaps(&p, &q);
    assert!(gaps[0] < GAPS[0] && gaps[1] < GAPS[1] && gaps[2] > GAPS[2], "{gaps:?}");
}

/// What the patches' formula has on their sides is what the records have that are drawn there.
#[test]
fn normals_are_those_of_the_records_on_all_sides() {
    let gpu = gpu();
    let mut compared = 0;
    for specimen in zoo::all() {
        let surface = biseptic_surface(&gpu, &specimen.cage);
        compared += compare_normals(&specimen.name, &specimen.cage, &surface, PatchForm::Biseptic)
            .unwrap_or_else(|fault| panic!("{fault}"));
    }
    assert!(compared > 50_000, "only {compared} points compared");
}

/// Distances to the limit surface of rings whose refined edges have length 1, per valence from 3: the largest of bowls, saddles and random rings, as measured
/// with the generator. Valence 4 is the limit surface.
const DISTANCES: [f64; 10] = [0.006, 0.0, 0.0035, 0.0095, 0.014, 0.023, 0.025, 0.0245, 0.04, 0.0385];

/// Largest distance of patches at the centre of a star of `n` sectors from the limit surface, in lengths of refined edges.
fn distance_to_limit(engine: &Engine, n: u32, height: impl Fn(f64, f64) -> f64) -> f64 {
    let cage = stars::star(n as usize, height);
    let surface = biseptic_surface(engine, &cage);
    let mesh = Mesh::from(&cage);
    let exact = Reference::new(&mesh, Boundary::EdgeAndCorner).unwrap();
    let parameters: [f32; 9] = std::array::from_fn(|i| i as f32 / 8.0);
    let at_centre = |record: &PatchRecord| record.valence() == n && !record.is_boundary();
    let requests = requests(&some_patches(&surface, 3, at_centre), &parameters);
    let points = requests.iter().map(|request| {
        let Place { sub_face, st: [s, t], .. } = surface.place(request.patch_id, [request.u.into(), request.v.into()]);
        SurfacePoint { sub_face, s, t }
    });
    let points: Vec<SurfacePoint> = points.collect();
    let samples = surface.sample(&points).unwrap();
    let distances = points.iter().zip(samples).map(|(point, sample)| distance(&exact, point, sample.position));
    // Edges of stars have length 1, and their halves are the refined ones.
    2.0 * distances.fold(0.0, f64::max)
}

/// Distance of a position from the face that a point is on, searched from there by Gauss-Newton steps.
fn distance(exact: &Reference<'_>, point: &SurfacePoint, position: DVec3) -> f64 {
    let (mut s, mut t) = (point.s, point.t);
    let mut nearest = f64::INFINITY;
    for _ in 0..8 {
        let foot = exact.eval(point.sub_face.face as usize, point.sub_face.sub, s, t).unwrap();
        let gap = position - foot.position;
        nearest = nearest.min(gap.length());
        if foot.irregular {
            break;
        }
        let (e, f, g) = (foot.du.dot(foot.du), foot.du.dot(foot.dv), foot.dv.dot(foot.dv));
        let (x, y, area) = (gap.dot(foot.du), gap.dot(foot.dv), e * g - f * f);
        s = (s + (g * x - f * y) / area).clamp(0.0, 1.0);
        t = (t + (e * y - f * x) / area).clamp(0.0, 1.0);
    }
    nearest
}

/// Refinement halves the cage's edges, and quarters heights of bowls: those of 0.6 become the bowls of 0.3 that [`DISTANCES`] was measured with. Saddles fade about
/// half as fast at extraordinary vertices, so those of 0.3 do.
#[test]
fn distances_to_the_limit_are_those_of_the_generator() {
    let gpu = gpu();
    for (n, expected) in (3..).zip(DISTANCES) {
        let bowl = distance_to_limit(&gpu, n, |x, y| 0.6 * (x * x + y * y));
        let saddle = distance_to_limit(&gpu, n, |x, y| 0.3 * (x * x - y * y));
        let (least, most) = (0.6 * expected, 1.2 * expected + 1e-5);
        assert!((least..most).contains(&bowl.max(saddle)), "valence {n}: {bowl} and {saddle} for {expected}");
    }
}
