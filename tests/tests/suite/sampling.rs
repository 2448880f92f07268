//! Points on request: the same bits as the evaluation stages, and where the exact surface is.

use osculate::{
    CapturedVertex, EngineError, Factors, Spacing, SubFace, Surface, SurfaceDesc, SurfacePoint, Tessellation,
};
use osculate_shaders::layout::SampleRequest;
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_tests::{gpu, zoo};

fn captured(surface: &Surface, tessellation: &Tessellation) -> Vec<CapturedVertex> {
    let mut all = Vec::new();
    surface
        .capture(tessellation, |vertices| {
            all.extend_from_slice(vertices);
            Ok::<(), EngineError>(())
        })
        .unwrap();
    all
}

/// On llvmpipe all operations round alike in all stages, so the bits are equal; elsewhere stages may differ a little inside patches.
#[test]
fn the_sampling_kernel_gives_the_bits_of_the_evaluation_stage() {
    let gpu = gpu();
    let exact = gpu.device().info().is_llvmpipe;
    for specimen in zoo::all() {
        let surface = Surface::new(&gpu, &specimen.cage, &SurfaceDesc::default()).unwrap();
        let tessellation = Tessellation { factors: Factors::Uniform(3.4), spacing: Spacing::Odd };
        let vertices = captured(&surface, &tessellation);
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
            assert!(same, "{}: {vertex:?} was drawn, {sampled:?} sampled", specimen.name);
        }
    }
}

fn mesh(cage: &osculate::Cage) -> Mesh {
    Mesh {
        positions: cage.positions().to_vec(),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
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

/// Regular patches are the exact surface, in position, derivatives and normal; so are all vertices.
#[test]
fn regular_patches_are_the_exact_surface() {
    let gpu = gpu();
    let mut compared = 0;
    for specimen in zoo::all() {
        let cage = &specimen.cage;
        let surface = Surface::new(&gpu, cage, &SurfaceDesc::default()).unwrap();
        let rule = if surface.plan().rule == osculate::BoundaryRule::EdgeOnly {
            Boundary::EdgeOnly
        } else {
            Boundary::EdgeAndCorner
        };
        let mesh = mesh(cage);
        let reference = Reference::new(&mesh, rule).unwrap();
        let points = grid_points(&surface, cage.face_count(), 5);
        let size = 2.0 * cage.bounds().half_diagonal();
        for (point, sample) in points.iter().zip(surface.sample(&points).unwrap()) {
            let SubFace { face, sub } = point.sub_face;
            let (quad, uv) = surface.plan().locator.find(point.sub_face, [point.s, point.t]).unwrap();
            let record = &surface.plan().patches[surface.plan().patch_of_quad[quad as usize] as usize];
            let corner = uv.iter().all(|&x| x == 0.0 || x == 1.0);
            if record.is_extraordinary() && !corner {
                continue;
            }
            let exact = reference.eval(face as usize, sub, point.s, point.t).unwrap();
            let name = format!("{} at {point:?}", specimen.name);
            let error = (sample.position - exact.position).length() / size;
            assert!(error < 1e-6, "{name}: position is off by {error:e} of the box");
            if record.is_extraordinary() {
                continue;
            }
            let error = (sample.du - exact.du).length().max((sample.dv - exact.dv).length()) / size;
            assert!(error < 1e-5, "{name}: derivatives are off by {error:e} of the box");
            let face_size = exact.du.length().min(exact.dv.length()).max(1e-12);
            let allowed = 1e-5 + 8.0 * f64::from(f32::EPSILON) * size / face_size;
            let error = (sample.normal - exact.normal).length();
            assert!(error < allowed, "{name}: normal is off by {error:e}, allowed {allowed:e}");
            compared += 1;
        }
    }
    assert!(compared > 50_000, "only {compared} points compared");
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
