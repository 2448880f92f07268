//! Surfaces that refine only where they must: no cracks between whole faces and halves, the same points, and mistakes in their shaders.

use glam::DVec3;
use osculate::{
    Cage, CheckReport, Culling, Engine, EngineDesc, EngineError, Evaluator, Factors, Part, PatchKind, RenderDesc,
    Scheme, Shade, Spacing, Surface, SurfaceDesc, Tessellation, check, render,
};
use osculate::{Camera, Refinement};
use osculate_cage::CagePart;
use osculate_shaders::layout::SampleRequest;
use osculate_tests::exact::captured;
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::{gpu, gpu_with, gpu_with_shaders, zoo};

const NEEDED: SurfaceDesc =
    SurfaceDesc { scheme: Scheme::Gregory2, boundary: None, refinement: Refinement::WhereNeeded };

fn surface(engine: &Engine, cage: &Cage, scheme: Scheme) -> Surface {
    Surface::new(engine, cage, &SurfaceDesc { scheme, ..NEEDED }).unwrap()
}

fn assert_watertight(name: &str, surface: &Surface, level: f32) {
    let [report, in_compute] = [Evaluator::Tessellator, Evaluator::Compute].map(|evaluator| {
        let report = check(surface, &Tessellation { evaluator, ..Tessellation::uniform(level) }).unwrap();
        assert!(report.is_watertight() && report.weld.open == 0, "{name}, level {level}, {evaluator:?}: {report:?}");
        report
    });
    // Two triangles a cell, in unrefined faces of twice as many segments each way.
    let (plan, n) = (surface.plan(), level.ceil() as u64);
    let cells = plan.patches.len() as u64 + 3 * u64::from(plan.unrefined_count());
    let all_quads = plan.patches.iter().all(|patch| patch.sides() == 4);
    for report in [report, in_compute].iter().filter(|_| all_quads) {
        assert_eq!(report.triangles, cells * 2 * n * n, "{name}, level {level}");
    }
}

#[test]
fn whole_faces_and_halves_of_edges_are_watertight() {
    let gpu = gpu();
    let mut unrefined = 0;
    for (i, specimen) in zoo::all().iter().enumerate() {
        let scheme = Scheme::ALL[i % Scheme::ALL.len()];
        let surface = surface(&gpu, &specimen.cage, scheme);
        unrefined += surface.plan().unrefined_count();
        assert_watertight(&format!("{}, {scheme}", specimen.name), &surface, 2.4);
    }
    assert!(unrefined > 200, "only {unrefined} faces are left unrefined");
    for name in ["dragon", "torus"] {
        let mut surface = surface(&gpu, &zoo::shipped(name), Scheme::Gregory2);
        let kinds: Vec<PatchKind> = surface.plan().lists.iter().map(|list| list.kind).collect();
        assert!(kinds.starts_with(&[PatchKind::Unrefined]) && surface.has_unrefined(), "{name}: {kinds:?}");
        for level in [1.0, 2.0, 3.0, 5.0, 7.0] {
            assert_watertight(name, &surface, level);
        }
        let move_point = |p: &DVec3| *p + 0.1 * DVec3::new(p.y.sin(), p.z.cos(), p.x);
        let moved: Vec<DVec3> = zoo::shipped(name).positions().iter().map(move_point).collect();
        surface.set_points(&moved).unwrap();
        assert_watertight(&format!("{name}, moved"), &surface, 6.0);
    }
    assert_watertight("grid", &surface(&gpu, &zoo::grid(4, 4), Scheme::Gregory2), 32.0);
}

/// Faces and the halves beside them in chunks of their own: each half is then made by the patch that has it, and the middle by one of both.
#[test]
fn halves_without_their_whole_are_watertight() {
    let cage = zoo::shipped("dragon");
    for grid_vertices in [1, 200, 3000] {
        let gpu = gpu_with(EngineDesc { grid_vertices: Some(grid_vertices), ..EngineDesc::default() });
        let surface = surface(&gpu, &cage, Scheme::Gregory2);
        for level in [1.0, 3.0] {
            let tessellation = Tessellation { evaluator: Evaluator::Compute, ..Tessellation::uniform(level) };
            let report = check(&surface, &tessellation).unwrap();
            assert!(report.is_watertight() && report.weld.open == 0, "{grid_vertices}, {level}: {report:?}");
        }
    }
}

/// Both evaluators find points by integers where the sampling kernel halves parameters, and all are the surface that is refined everywhere; of `ngon` by the second
/// of two steps.
#[test]
fn points_are_those_of_the_refined_surface() {
    let gpu = gpu();
    let (tessellator, compute) = (Evaluator::Tessellator, Evaluator::Compute);
    for (name, evaluator) in
        [("dragon", tessellator), ("ngon", tessellator), ("ngon", compute), ("shell", compute), ("torus", compute)]
    {
        let cage = zoo::shipped(name);
        let surface = surface(&gpu, &cage, Scheme::Gregory2);
        assert!(surface.has_unrefined(), "{name}");
        let everywhere = Surface::new(&gpu, &cage, &SurfaceDesc::default()).unwrap();
        let vertices = captured(&surface, &Tessellation { evaluator, ..Tessellation::uniform(3.0) });
        let requests: Vec<SampleRequest> =
            vertices.iter().map(|v| SampleRequest { patch_id: v.patch, u: v.uv[0], v: v.uv[1] }).collect();
        let places = vertices.iter().map(|v| surface.place(v.patch, v.uv.map(f64::from)));
        let at: Vec<osculate::SurfacePoint> = places
            .map(|place| (place.sub_face, place.st.map(|x| x.clamp(0.0, 1.0))))
            .map(|(sub_face, [s, t])| osculate::SurfacePoint { sub_face, s, t })
            .collect();
        let (values, refined) = (surface.evaluate(&requests).unwrap(), everywhere.sample(&at).unwrap());
        let size = 2.0 * cage.bounds().half_diagonal();
        for (vertex, (value, refined)) in vertices.iter().zip(values.chunks_exact(12).zip(refined)) {
            let drawn = surface.space().leave(vertex.position.into());
            let sampled = surface.space().leave(glam::Vec3::from_slice(value));
            let off = (drawn - sampled).length().max((drawn - refined.position).length()) / size;
            assert!(off < 2e-6, "{name}: {vertex:?} is off by {off:e} of the box");
            let normals = [glam::Vec3::from_slice(&value[9..]).as_dvec3(), refined.normal];
            let off = normals.map(|normal| (glam::Vec3::from(vertex.normal).as_dvec3() - normal).length());
            assert!(off.iter().all(|&off| off < 2e-3), "{name}: {vertex:?} has a normal that is off by {off:?}");
        }
    }
}

#[test]
fn pictures_are_those_of_the_refined_surface_culled_or_not() {
    let gpu = gpu();
    let cage = zoo::shipped("dragon");
    let surfaces = [Refinement::Everywhere, Refinement::WhereNeeded]
        .map(|refinement| Surface::new(&gpu, &cage, &SurfaceDesc { refinement, ..NEEDED }).unwrap());
    let shades = [Shade::Lit, Shade::Valence, Shade::Wireframe];
    let evaluators = [Evaluator::Tessellator, Evaluator::Compute];
    for (shade, evaluator) in shades.into_iter().flat_map(|shade| evaluators.map(|evaluator| (shade, evaluator))) {
        let tessellation = Tessellation { evaluator, ..Tessellation::uniform(4.0) };
        let desc = RenderDesc { shade, tessellation, ..RenderDesc::fit(&cage, [160, 120]) };
        let draw = |surface: &Surface, culling| render(&gpu, &[surface], &RenderDesc { culling, ..desc }).unwrap().rgba;
        let [refined, needed] = [0, 1].map(|i| draw(&surfaces[i], Culling::NONE));
        let differ = |(a, b): &(&[u8; 4], &[u8; 4])| (0..4).any(|i| a[i].abs_diff(b[i]) > 24);
        let pixels = refined.as_chunks::<4>().0.iter().zip(needed.as_chunks::<4>().0);
        let different = pixels.filter(differ).count();
        assert!(different < 40, "{shade:?}, {evaluator:?}: {different} pixels differ");
        assert!(draw(&surfaces[1], Culling::UNSEEN) == needed, "{shade:?}, {evaluator:?}: culling changes the picture");
    }
}

#[test]
fn what_they_are_not_for_is_refused_by_name() {
    let gpu = gpu();
    let cage = zoo::shipped("torus");
    let surface = surface(&gpu, &cage, Scheme::Gregory2);
    let uniform = Tessellation::uniform(3.0);
    let adaptive = Factors::Adaptive { pixels: 8.0, camera: Camera::fit(cage.bounds()), height: 100 };
    for (tessellation, word) in [
        (Tessellation { factors: adaptive, ..uniform }, "--adaptive"),
        (Tessellation { spacing: Spacing::Odd, ..uniform }, "--spacing"),
        (Tessellation::uniform(32.5), "--level"),
    ] {
        for error in [
            check(&surface, &tessellation).unwrap_err(),
            render(&gpu, &[&surface], &RenderDesc { tessellation, ..RenderDesc::fit(&cage, [8, 8]) }).unwrap_err(),
        ] {
            assert!(matches!(error, EngineError::Unrefined { .. }), "{error}");
            let text = error.to_string();
            assert!(text.contains(word) && text.contains("--refine"), "{text}");
        }
    }
    let part = CagePart::cut(&cage, &[0, 1, 2], 2);
    let error = Part::new(&gpu, part, &NEEDED).err().unwrap().to_string();
    assert!(error.contains("--refine") && error.contains("--part-faces"), "{error}");
}

/// Checks surfaces with a changed shader: positions must be seen to differ.
fn sabotaged(mutation: Mutation, level: f32, noticed: impl Fn(&CheckReport) -> bool) {
    let gpu = gpu_with_shaders(mutated(&[mutation]));
    let report =
        check(&surface(&gpu, &zoo::shipped("dragon"), Scheme::Gregory2), &Tessellation::uniform(level)).unwrap();
    assert!(!report.is_watertight() && noticed(&report), "the check did not notice: {report:?}");
}

const PATH: &str = "include/side_parameter.glsl";

#[test]
fn a_wrong_half_is_noticed() {
    let mutation = Mutation { path: PATH, from: "(is_half && side == 3u ?", to: "(is_half && side == 0u ?" };
    sabotaged(mutation, 3.0, |report| report.split_positions > 0);
}

/// Without it, points differ by what the tessellator rounds.
#[test]
fn parameters_that_are_not_taken_from_integers_are_noticed() {
    let from = "#ifdef SIDES_IN_SEGMENTS\n    uint half_segments";
    let to = "#ifdef SIDES_IN_SEGMENTS\n    if (!is_half) { return edge_parameter(side, flip, uv); }\n    uint half_segments";
    sabotaged(Mutation { path: PATH, from, to }, 3.0, |report| report.split_positions > 0);
}

#[test]
fn a_middle_that_is_taken_for_a_corner_is_noticed() {
    let mutation = Mutation { path: PATH, from: "corner == 3u && is_half_side(id, 3u) ? 3u", to: "corner == 4u ? 3u" };
    sabotaged(mutation, 2.0, |report| report.split_positions > 0);
}

/// As many segments on an unrefined face as on its neighbours leave every second point without a partner.
#[test]
fn factors_that_are_not_doubled_are_noticed() {
    let path = "include/factors.glsl";
    let from = "precise float doubled = 2.0 * ceil(frame.level);";
    sabotaged(Mutation { path, from, to: "float doubled = ceil(frame.level);" }, 4.0, |report| report.open > 0);
}
