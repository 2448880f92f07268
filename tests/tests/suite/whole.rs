//! Cages that are not isolated: the device against the same patches in f64, and mistakes in their shaders.

use glam::{DVec3, Vec3};
use osculate::{
    BoundaryRule, Cage, Camera, CheckReport, Engine, Evaluator, Factors, RenderDesc, Scheme, Shade, Spacing, SubFace,
    Surface, SurfacePoint, Tessellation, check,
};
use osculate_subdiv::{NONE, PatchForm, twin};
use osculate_surface::reference::{Mesh, Reference};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::{Gallery, camera, draw_surfaces};
use osculate_tests::whole::{WholeSurface, cut_some_quads};
use osculate_tests::{gpu, gpu_with_shaders, rules_of, surface_of, zoo};

fn whole(engine: &Engine, cage: &Cage, rule: BoundaryRule) -> Option<Surface> {
    surface_of(engine, cage, Scheme::Gregory1, Some(rule))
}

/// The zoo, and some of it with triangles among quads.
fn cages() -> Vec<(String, Cage)> {
    let mut cages: Vec<_> = zoo::all().into_iter().map(|specimen| (specimen.name, specimen.cage)).collect();
    for name in ["twohole", "shell", "torus", "cube"] {
        cages.push((format!("{name} with triangles"), cut_some_quads(&zoo::shipped(name))));
    }
    cages
}

/// A grid over every sub-face that is drawn.
fn points(surface: &Surface, faces: usize) -> Vec<SurfacePoint> {
    let at = |i: u32| f64::from(i) / 4.0;
    let place = |(sub_face, i): (SubFace, u32)| SurfacePoint { sub_face, s: at(i % 5), t: at(i / 5) };
    let drawn = |point: &SurfacePoint| surface.plan().patch_of_quad[found(surface, point).face as usize] != NONE;
    let sub_faces = (0..faces as u32).flat_map(|face| surface.plan().locator.sub_faces(face));
    sub_faces.flat_map(|sub_face| (0..25).map(move |i| (sub_face, i))).map(place).filter(drawn).collect()
}

fn found(surface: &Surface, point: &SurfacePoint) -> osculate_subdiv::PatchPoint {
    surface.plan().locator.find(point.sub_face, [point.s, point.t]).expect("a sub-face of the cage")
}

/// Largest errors of the device's samples, of position, derivatives and normal, as parts of what is allowed; and how many points were compared.
fn errors(cage: &Cage, rule: BoundaryRule, surface: &Surface) -> ([f64; 3], usize) {
    let (exact, size) = (WholeSurface::new(cage, rule), 2.0 * cage.bounds().half_diagonal());
    let points = points(surface, cage.face_count());
    let mut worst = [0.0_f64; 3];
    for (point, sample) in points.iter().zip(surface.sample(&points).unwrap()) {
        let at = found(surface, point);
        let jet = exact.jet(at.face, at.uv);
        let [du, dv] = at.derivatives(jet.du, jet.dv);
        let plane = jet.du.cross(jet.dv);
        let height = plane.length() / jet.du.length().max(jet.dv.length()).max(1e-30);
        let normal =
            corner(surface, at.face, at.uv).map_or(plane.normalize_or_zero(), |k| exact.corner_normal(at.face, k));
        // Rounding turns normals the more, the smaller and thinner the patch; along an edge with a flat end the patch has no height there.
        let allowed = 1e-5 + 8.0 * f64::from(f32::EPSILON) * size / height.max(1e-30);
        let here = [
            (sample.position - jet.position).length() / (1e-6 * size),
            (sample.du - du).length().max((sample.dv - dv).length()) / (1e-5 * size),
            (sample.normal - normal).length() / allowed,
        ];
        worst = [0, 1, 2].map(|i| worst[i].max(here[i]));
    }
    (worst, points.len())
}

/// The corner of a final face at (u,v).
fn corner(surface: &Surface, face: u32, uv: [f64; 2]) -> Option<usize> {
    let patch = surface.plan().patch_of_quad[face as usize];
    let quad: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let triangle = &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let corners = if surface.plan().patches[patch as usize].sides() == 3 { triangle } else { quad };
    corners.iter().position(|&at| at == uv)
}

#[test]
fn the_device_has_the_patches_of_the_generator() {
    let gpu = gpu();
    let mut compared = 0;
    for (name, cage) in cages() {
        for &rule in rules_of(&cage) {
            let Some(surface) = whole(&gpu, &cage, rule) else { continue };
            let (errors, points) = errors(&cage, rule, &surface);
            assert!(errors.iter().all(|&error| error < 1.0), "{name}, {rule:?}: {errors:?} of what is allowed");
            compared += points;
        }
    }
    assert!(compared > 100_000, "only {compared} points compared");
}

#[test]
fn vertices_are_on_the_limit_surface() {
    let gpu = gpu();
    for (name, cage) in cages() {
        for &rule in rules_of(&cage) {
            let Some(surface) = whole(&gpu, &cage, rule) else { continue };
            let mesh = Mesh::from(&cage);
            let exact = Reference::new(&mesh, rule.into()).unwrap();
            let size = 2.0 * cage.bounds().half_diagonal();
            let mut points = points(&surface, cage.face_count());
            points.retain(|p| (p.s, p.t) == (0.0, 0.0));
            for (point, sample) in points.iter().zip(surface.sample(&points).unwrap()) {
                let exact = exact.eval(point.sub_face.face as usize, point.sub_face.sub, 0.0, 0.0).unwrap();
                let error = (sample.position - exact.position).length() / size;
                assert!(error < 1e-6, "{name}, {rule:?}, {point:?}: {error:e} of the box");
                assert_eq!(sample.irregular, exact.irregular, "{name}, {rule:?}, {point:?}");
            }
        }
    }
}

#[test]
fn triangles_among_quads_are_watertight() {
    let gpu = gpu();
    for (name, cage) in cages().into_iter().filter(|(name, _)| name.ends_with("triangles")) {
        for &rule in rules_of(&cage) {
            let Some(surface) = whole(&gpu, &cage, rule) else { continue };
            for tessellation in tessellations(&cage) {
                let report = check(&surface, &tessellation).unwrap();
                assert!(
                    report.is_watertight() && report.weld.open == 0,
                    "{name}, {rule:?}, {tessellation:?}: {report:?}"
                );
            }
        }
    }
}

fn adaptive(cage: &Cage) -> Tessellation {
    let bounds = cage.bounds();
    let eye = bounds.center() + 1.1 * bounds.half_diagonal() * DVec3::new(-0.7, 0.1, 0.4).normalize();
    let camera = Camera::look_at(eye, bounds.center(), DVec3::Y, 0.8, bounds).unwrap();
    let factors = Factors::Adaptive { pixels: 4.0, camera, height: 256 };
    Tessellation { factors, spacing: Spacing::Odd, evaluator: Evaluator::Tessellator }
}

/// By either evaluator.
fn tessellations(cage: &Cage) -> Vec<Tessellation> {
    let uniform = |level, spacing| Tessellation { factors: Factors::Uniform(level), spacing, ..adaptive(cage) };
    let whole = [1.0, 8.0].map(|level| uniform(level, Spacing::Equal));
    let fractional = [uniform(5.7, Spacing::Odd), uniform(2.4, Spacing::Even), adaptive(cage)];
    let tessellator = whole.into_iter().chain(fractional);
    tessellator.flat_map(|by| [by, Tessellation { evaluator: Evaluator::Compute, ..by }]).collect()
}

/// A level of n cuts a triangle into n^2 around its middle, less those that are lost there; the count tells that all patches were drawn.
#[test]
fn levels_of_triangles_count() {
    let gpu = gpu();
    let surface = whole(&gpu, &zoo::fan(3), BoundaryRule::EdgeAndCorner).unwrap();
    assert_eq!(surface.plan().patches.len(), 1);
    let triangles = [1.0, 2.0, 3.0, 4.0].map(|level| check(&surface, &Tessellation::uniform(level)).unwrap().triangles);
    assert_eq!(triangles, [1, 6, 13, 24]);
}

/// Checks cages of triangles with changed shaders: `noticed` is what the check must have seen.
fn sabotaged(
    mutations: &[Mutation],
    tessellation: impl Fn(&Cage) -> Tessellation,
    noticed: impl Fn(&CheckReport) -> bool,
) {
    let gpu = gpu_with_shaders(mutated(mutations));
    for cage in [zoo::shipped("triangles"), cut_some_quads(&zoo::shipped("twohole"))] {
        let surface = whole(&gpu, &cage, BoundaryRule::EdgeAndCorner).unwrap();
        let report = check(&surface, &tessellation(&cage)).unwrap();
        assert!(!report.is_watertight() && noticed(&report), "the check did not notice: {report:?}");
    }
}

#[test]
fn a_parameter_of_a_triangle_that_is_not_reversed_is_noticed() {
    let mutation = Mutation {
        path: "include/domains/triangle.glsl",
        from: "uint end = (side + 1u - flip) % 3u;",
        to: "uint end = (side + 1u) % 3u;",
    };
    sabotaged(&[mutation], |_| Tessellation::uniform(5.0), |report| report.split_positions > 0);
}

#[test]
fn sides_of_triangles_evaluated_from_patches_are_noticed() {
    let mutation = Mutation {
        path: "include/domains/triangle.glsl",
        from: "first_coordinate(uv) == 0.0 ? 1u : uv.x == 0.0 ? 2u : 4u;",
        to: "uv.x == 0.0 ? 2u : 4u;",
    };
    sabotaged(&[mutation], |_| Tessellation::uniform(5.0), |report| report.split_positions > 0);
}

#[test]
fn factors_of_triangles_from_other_sides_are_noticed() {
    let mutations = [("0", "2", "1"), ("1", "0", "2"), ("2", "1", "0")];
    for (level, own, other) in mutations {
        let line = |side: &str| -> &'static str { format!("gl_TessLevelOuter[{level}] = side{side};").leak() };
        let mutation = Mutation { path: "include/factors.glsl", from: line(own), to: line(other) };
        sabotaged(&[mutation], adaptive, |report| report.open > 0 && report.split_positions == 0);
    }
}

/// Mistakes in the kernels that gather records and control points open no cracks, for both sides read what one thread wrote; they are seen beside the f64 surface.
#[test]
fn mistakes_in_gathered_records_and_points_are_noticed() {
    let edge = |from, to| Mutation { path: "records/edge_gathered.comp", from, to };
    let patch = |from, to| Mutation { path: "records/patch_gathered.comp", from, to };
    let fan = |from, to| Mutation { path: "include/fans.glsl", from, to };
    let mutations = [
        edge("fan_spoke(source.fan[1], source.edge[1])", "fan_spoke(source.fan[1], 0u)"),
        edge("-b.cross_inner, -b.cross_end", "b.cross_inner, b.cross_end"),
        edge(
            "a.position, a.edge_point, b.edge_point, b.position",
            "a.position, b.edge_point, a.edge_point, b.position",
        ),
        patch("(source.edge[corner] + 1u) % fans[fan].edges", "source.edge[corner]"),
        patch("source.sides == 3u ? 0.25 : 1.0 / 3.0", "1.0 / 3.0"),
        patch("own.edge_point + (along + left", "own.edge_point + (along - left"),
        patch("+ (2.0 * own_cosine)", "+ (2.0 * other_cosine)"),
        fan("+ 2u * edge", "+ edge"),
    ];
    let cage = cut_some_quads(&zoo::shipped("twohole"));
    for mutation in mutations {
        let text = mutation.to;
        let gpu = gpu_with_shaders(mutated(&[mutation]));
        let surface = whole(&gpu, &cage, BoundaryRule::EdgeAndCorner).unwrap();
        let (errors, _) = errors(&cage, BoundaryRule::EdgeAndCorner, &surface);
        assert!(errors.iter().any(|&error| error > 10.0), "{text}: {errors:?} of what is allowed");
    }
}

/// Where ends of edges are flat, their records are more than gathered. Dividing the cross derivative by the parameter leaves the normals along the edge as they
/// are, so that is seen beside the host's records.
#[test]
fn mistakes_at_flat_ends_are_noticed() {
    for (end, cage) in [("PLAIN", zoo::pillow()), ("OPPOSED", zoo::grid(3, 2))] {
        assert!(!records_differ(&whole(&gpu(), &cage, BoundaryRule::EdgeOnly).unwrap(), &cage));
        for from in ["start", "end"]
            .map(|side| format!("if ({side} {} CROSS_END_{end})", if end == "PLAIN" { "!=" } else { "==" }))
        {
            let mutation = Mutation { path: "records/edge_gathered.comp", from: from.leak(), to: "if (false)" };
            let text = mutation.from;
            let gpu = gpu_with_shaders(mutated(&[mutation]));
            let surface = whole(&gpu, &cage, BoundaryRule::EdgeOnly).unwrap();
            assert!(records_differ(&surface, &cage), "{text}");
            if end == "OPPOSED" {
                let (errors, _) = errors(&cage, BoundaryRule::EdgeOnly, &surface);
                assert!(errors[2] > 10.0, "{text}: {errors:?} of what is allowed");
            }
        }
    }
}

/// Whether edge records are not what the host has.
fn records_differ(surface: &Surface, cage: &Cage) -> bool {
    let start: Vec<Vec3> = cage.positions().iter().map(|&p| surface.space().enter(p)).collect();
    let host = twin::edge_records(surface.plan(), &twin::points(surface.plan(), &start)).into_iter().flatten();
    surface.read_edge_records().unwrap().into_iter().zip(host).any(|(a, b)| (Vec3::from(a) - b).length() > 4e-6)
}

#[test]
fn pictures_of_whole_faces() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let mut picture = |name: &str, cage: &Cage, direction, shade| {
        let surface = whole(&gpu, cage, BoundaryRule::EdgeAndCorner).unwrap();
        let desc =
            RenderDesc { shade, camera: camera(cage, direction, 2.2, 45.0), ..RenderDesc::fit(cage, [256, 256]) };
        gallery.check(&format!("gregory1_{name}"), &draw_surfaces(&gpu, &[&surface], &desc));
    };
    let mixed = cut_some_quads(&zoo::shipped("twohole"));
    let shell = cut_some_quads(&zoo::shipped("shell"));
    picture("triangles", &zoo::shipped("triangles"), [1.0, 0.75, 1.5], Shade::Lit);
    picture("mixed", &mixed, [0.7, 0.5, 1.5], Shade::Normals);
    picture("mixed_patches", &mixed, [0.7, 0.5, 1.5], Shade::Patches);
    picture("open", &shell, [0.8, 1.0, 1.2], Shade::Lit);
    picture("valence_64", &zoo::shipped("uvsphere"), [0.25, 1.0, 0.6], Shade::Lit);
    gallery.finish();
}

/// Regular quads stay bicubic, and what is not needed is not made.
#[test]
fn regular_cages_need_no_fans() {
    let surface = whole(&gpu(), &zoo::shipped("torus"), BoundaryRule::EdgeAndCorner).unwrap();
    let plan = surface.plan();
    assert!(plan.patches.iter().all(|record| record.kind().form() == PatchForm::Bicubic));
    assert_eq!((plan.steps(), plan.vector_count, plan.gathers.fans.len(), plan.levels.len()), (0, 0, 0, 0));
    assert!(check(&surface, &Tessellation::uniform(3.0)).unwrap().is_watertight());
}
