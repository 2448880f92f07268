//! Points on request: the same bits as the evaluation stages, and where the exact surface is.

use glam::{DVec3, Vec3};
use osculate::{
    BoundaryRule, Cage, EngineError, Scheme, Spacing, SubFace, Surface, SurfaceDesc, SurfacePoint, Tessellation,
};
use osculate_shaders::layout::SampleRequest;
use osculate_subdiv::{PatchPoint, PatchRecord, twin};
use osculate_surface::jet::Jet;
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_surface::{NetKind, bezier, gregory};
use osculate_tests::exact::captured;
use osculate_tests::{gpu, is_large, surface, surface_of, zoo};

/// On llvmpipe all operations round alike in all stages, so the bits are equal; elsewhere stages may differ a little inside patches.
#[test]
fn the_sampling_kernel_gives_the_bits_of_the_evaluation_stage() {
    let gpu = gpu();
    let exact = gpu.device().info().is_llvmpipe;
    for (specimen, scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |&s| (specimen, s))) {
        let surface = surface_of(&gpu, &specimen.cage, scheme, None).unwrap();
        let level = if is_large(&surface) { 1.4 } else { 3.4 };
        let vertices = captured(&surface, &Tessellation { spacing: Spacing::Odd, ..Tessellation::uniform(level) });
        let requests: Vec<SampleRequest> =
            vertices.iter().map(|v| SampleRequest { patch_id: v.patch, u: v.uv[0], v: v.uv[1] }).collect();
        let values = surface.evaluate(&requests).unwrap();
        for (vertex, value) in vertices.iter().zip(values.chunks_exact(12)) {
            let sampled = [value[0], value[1], value[2], value[9], value[10], value[11]];
            let drawn = [vertex.position, vertex.normal].concat();
            let same = sampled.iter().zip(&drawn).all(|(a, b)| match exact {
                // The evaluation stage flushes subnormals, so zeros and near-zeros may differ there.
                true => a.to_bits() == b.to_bits() || (a.abs() < f32::MIN_POSITIVE && b.abs() < f32::MIN_POSITIVE),
                false => (a - b).abs() < 1e-5,
            });
            assert!(same, "{}, {scheme}: {vertex:?} was drawn, {sampled:?} sampled", specimen.name);
        }
    }
}

/// (s,t) on a grid over every sub-face.
fn grid_points(surface: &Surface, faces: usize, n: u32) -> Vec<SurfacePoint> {
    let at = move |i: u32| f64::from(i) / f64::from(n);
    (0..faces as u32)
        .flat_map(|face| surface.plan().locator.sub_faces(face))
        .flat_map(|sub_face| (0..=n).flat_map(move |j| (0..=n).map(move |i| (sub_face, i, j))))
        .map(|(sub_face, i, j)| SurfacePoint { sub_face, s: at(i), t: at(j) })
        .collect()
}

/// Regular patches are the exact surface, in position, derivatives and normal; so are all vertices. Elsewhere Gregory patches stay near it.
#[test]
fn regular_patches_and_vertices_are_exact() {
    let gpu = gpu();
    let mut compared = 0;
    for specimen in zoo::all() {
        for rule in [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly] {
            let surface = surface(&gpu, &specimen.cage, Some(rule)).unwrap();
            let mesh = Mesh::from(&specimen.cage);
            let exact = Reference::new(&mesh, Boundary::from(rule)).unwrap();
            compared += compare_with_exact(&format!("{}, {rule:?}", specimen.name), &specimen.cage, &surface, &exact);
        }
    }
    assert!(compared > 40_000, "only {compared} points compared");
}

/// Largest distance of a Gregory patch from the exact surface at equal parameters, as a part of the box. The worst of the zoo are a boundary vertex with six
/// thin faces and poles of valence 200, with 0.029; valences up to 12 stay below 0.008.
const GREGORY_DISTANCE: f64 = 0.04;

fn compare_with_exact(name: &str, cage: &Cage, surface: &Surface, exact: &Reference<'_>) -> usize {
    let points = grid_points(surface, cage.face_count(), 3);
    let size = 2.0 * cage.bounds().half_diagonal();
    let mut compared = 0;
    for (point, sample) in points.iter().zip(surface.sample(&points).unwrap()) {
        let name = format!("{name} at {point:?}");
        let exact = exact.eval(point.sub_face.face as usize, point.sub_face.sub, point.s, point.t).unwrap();
        let error = (sample.position - exact.position).length() / size;
        let PatchPoint { face, uv, .. } = surface.plan().locator.find(point.sub_face, [point.s, point.t]).unwrap();
        let record = &surface.plan().patches[surface.plan().patch_of_quad[face as usize] as usize];
        if record.is_extraordinary() {
            let corner = uv.iter().all(|&x| x == 0.0 || x == 1.0);
            let allowed = if corner { 1e-6 } else { GREGORY_DISTANCE };
            assert!(error < allowed, "{name}: position is off by {error:e} of the box");
            continue;
        }
        assert!(error < 1e-6, "{name}: position is off by {error:e} of the box");
        let error = (sample.du - exact.du).length().max((sample.dv - exact.dv).length()) / size;
        assert!(error < 1e-5, "{name}: derivatives are off by {error:e} of the box");
        let face_size = exact.du.length().min(exact.dv.length()).max(1e-12);
        let allowed = 1e-5 + 8.0 * f64::from(f32::EPSILON) * size / face_size;
        let error = (sample.normal - exact.normal).length();
        assert!(error < allowed, "{name}: normal is off by {error:e}, allowed {allowed:e}");
        compared += 1;
    }
    compared
}

/// Inside Gregory patches, the device against the same construction in f64 from the same points.
#[test]
fn gregory_patches_are_those_of_the_generator() {
    const PARAMETERS: [(f32, f32); 3] = [(0.25, 0.5), (0.7, 0.1), (0.03, 0.9)];
    let gpu = gpu();
    let mut compared = 0;
    for specimen in zoo::all() {
        let surface = surface(&gpu, &specimen.cage, Some(BoundaryRule::EdgeOnly)).unwrap();
        let patches = gregory_points(&surface);
        let requests: Vec<SampleRequest> = patches
            .iter()
            .flat_map(|&(patch_id, _)| PARAMETERS.map(|(u, v)| SampleRequest { patch_id, u, v }))
            .collect();
        let values = surface.evaluate(&requests).unwrap();
        for (i, (request, value)) in requests.iter().zip(values.chunks_exact(12)).enumerate() {
            let (u, v) = (f64::from(request.u), f64::from(request.v));
            let exact = bezier::patch(&gregory::bezier_grid(&patches[i / PARAMETERS.len()].1, u, v), u, v);
            assert_same_point(&format!("{} at {request:?}", specimen.name), value, &exact);
            compared += 1;
        }
    }
    assert!(compared > 3_000, "only {compared} points compared");
}

/// Number and Gregory points of every extraordinary patch, from the device's net points.
fn gregory_points(surface: &Surface) -> Vec<(u32, [DVec3; 20])> {
    let plan = surface.plan();
    let points: Vec<Vec3> = surface.read_points().unwrap().into_iter().map(Vec3::from).collect();
    let coefficients = twin::coefficients(plan, &points);
    let of = |record: &PatchRecord| -> [DVec3; 20] {
        if record.kind().is_stored() {
            return std::array::from_fn(|i| coefficients[record.net as usize + i].as_dvec3());
        }
        let net = &plan.nets[record.net as usize..][..record.net_size as usize];
        let net: Vec<DVec3> = net.iter().map(|&i| points[i as usize].as_dvec3()).collect();
        gregory::gregory2(NetKind::Interior { valence: record.valence() }).apply(&net).try_into().unwrap()
    };
    (0..)
        .zip(&plan.patches)
        .filter(|(_, record)| record.is_extraordinary())
        .map(|(id, record)| (id, of(record)))
        .collect()
}

fn assert_same_point(name: &str, value: &[f32], exact: &Jet) {
    let [position, du, dv, normal] = [0, 1, 2, 3].map(|i| Vec3::from_slice(&value[3 * i..]).as_dvec3());
    assert!((position - exact.position).length() < 2e-6, "{name}: {position} for {}", exact.position);
    assert!((du - exact.du).length() < 1e-5, "{name}: {du} for {}", exact.du);
    assert!((dv - exact.dv).length() < 1e-5, "{name}: {dv} for {}", exact.dv);
    // Rounding turns the normal the more, the smaller and the thinner the patch.
    let plane = exact.du.cross(exact.dv);
    let thinness = plane.length() / exact.du.length().max(exact.dv.length()).max(1e-30);
    let allowed = 1e-5 + 2e-6 / thinness.max(1e-9);
    let error = (normal - plane.normalize_or_zero()).length();
    assert!(error < allowed, "{name}: normal is off by {error:e}, allowed {allowed:e}");
}

#[test]
fn points_that_do_not_exist_are_refused() {
    let gpu = gpu();
    let surface = Surface::new(&gpu, &zoo::shipped("ngon"), &SurfaceDesc::default()).unwrap();
    let ask = |face, sub, s, t| {
        surface.sample(&[SurfacePoint { sub_face: SubFace { face, sub }, s, t }]).unwrap_err().to_string()
    };
    assert!(ask(10_000, -1, 0.0, 0.0).contains("no such face"));
    assert!(ask(0, 77, 0.0, 0.0).contains("sub"));
    assert!(ask(0, -1, 1.5, 0.0).contains("0 to 1"));
    assert!(ask(0, -1, f64::NAN, 0.0).contains("0 to 1"));
    assert_eq!(surface.sample(&[]).unwrap(), []);
}

/// Chunks follow each other whatever their number; a sink's error ends the capture.
#[test]
fn a_sink_can_end_a_capture() {
    let gpu = gpu();
    let surface = Surface::new(&gpu, &zoo::shipped("cube"), &SurfaceDesc::default()).unwrap();
    #[derive(Debug)]
    enum Stop {
        Enough,
        #[expect(dead_code, reason = "shown by Debug when the test fails")]
        Engine(EngineError),
    }
    impl From<EngineError> for Stop {
        fn from(error: EngineError) -> Self {
            Self::Engine(error)
        }
    }
    let ended = surface.capture(&Tessellation::uniform(2.0), |_| Err::<(), _>(Stop::Enough));
    assert!(matches!(ended, Err(Stop::Enough)), "{ended:?}");
    let refused = surface.capture(&Tessellation::uniform(65.0), |_| Ok::<(), EngineError>(()));
    assert!(refused.unwrap_err().to_string().contains("65"));
}
