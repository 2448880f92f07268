//! The compute evaluator against the tessellator: equal bits at equal parameters, the same pictures, no cracks.

use std::collections::HashMap;

use glam::DVec3;
use osculate::{
    Cage, Camera, CapturedVertex, CheckReport, Engine, EngineDesc, Evaluator, Factors, RenderDesc, Scheme, Shade,
    Spacing, Surface, Tessellation, check,
};
use osculate_compare::Picture;
use osculate_shaders::layout::SampleRequest;
use osculate_tests::exact::captured;
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::{Gallery, camera, draw, draw_surfaces};
use osculate_tests::{
    gpu, gpu_with, gpu_with_shaders, is_large, reference_folder, rules_of, schemes_in_turn, surface, surface_of, zoo,
};

fn in_compute(level: f32, spacing: Spacing) -> Tessellation {
    Tessellation { factors: Factors::Uniform(level), spacing, evaluator: Evaluator::Compute }
}

/// Factors that differ from edge to edge.
fn adaptive(cage: &Cage, spacing: Spacing) -> Tessellation {
    let bounds = cage.bounds();
    let eye = bounds.center() + 1.1 * bounds.half_diagonal() * DVec3::new(-0.7, 0.1, 0.4).normalize();
    let camera = Camera::look_at(eye, bounds.center(), DVec3::Y, 0.8, bounds).unwrap();
    let factors = Factors::Adaptive { pixels: 8.0, camera, height: 256 };
    Tessellation { factors, spacing, evaluator: Evaluator::Compute }
}

/// Position and normal.
fn values(vertex: &CapturedVertex) -> [f32; 6] {
    let ([x, y, z], [a, b, c]) = (vertex.position, vertex.normal);
    [x, y, z, a, b, c]
}

/// On llvmpipe all operations round alike in all stages, but evaluation stages flush subnormals; elsewhere stages may differ a little inside patches.
fn same(a: &[f32], b: &[f32], exact: bool) -> bool {
    a.iter().zip(b).all(|(a, b)| match exact {
        true => a.to_bits() == b.to_bits() || (a.abs() < f32::MIN_POSITIVE && b.abs() < f32::MIN_POSITIVE),
        false => (a - b).abs() < 1e-5,
    })
}

#[test]
fn a_thread_gives_the_bits_of_a_workgroup() {
    for (name, scheme) in [("twohole", Scheme::Gregory2), ("dragon", Scheme::Gregory1), ("star12", Scheme::Gregory2)] {
        let [by_groups, by_lanes] = [false, true].map(|lanes| {
            let gpu = gpu_with(EngineDesc { grid_lanes: Some(lanes), ..EngineDesc::default() });
            let surface = surface_of(&gpu, &zoo::shipped(name), scheme, None).unwrap();
            captured(&surface, &in_compute(3.4, Spacing::Odd))
        });
        let exact = gpu().device().info().is_llvmpipe;
        assert_eq!(by_groups.len(), by_lanes.len());
        for (a, b) in by_groups.iter().zip(&by_lanes) {
            assert!(a.patch == b.patch && same(&values(a), &values(b), exact), "{name}: {a:?}, {b:?}");
        }
    }
}

/// Powers of two are levels whose parameters tessellators hit exactly, so that both evaluators have the same vertices.
#[test]
fn both_evaluators_give_the_same_bits() {
    let gpu = gpu();
    let exact = gpu.device().info().is_llvmpipe;
    for (specimen, &scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |s| (specimen, s))) {
        let surface = surface_of(&gpu, &specimen.cage, scheme, None).unwrap();
        let finest = if is_large(&surface) { 2.0 } else { 4.0 };
        for level in [1.0, finest] {
            let place = |vertex: &CapturedVertex| (vertex.patch, vertex.uv.map(f32::to_bits));
            let by_tessellator = Tessellation { evaluator: Evaluator::Tessellator, ..Tessellation::uniform(level) };
            let tessellated: HashMap<_, _> =
                captured(&surface, &by_tessellator).iter().map(|vertex| (place(vertex), *vertex)).collect();
            let computed: HashMap<_, _> = captured(&surface, &in_compute(level, Spacing::Equal))
                .iter()
                .map(|vertex| (place(vertex), *vertex))
                .collect();
            let mut common = 0;
            for (place, vertex) in &computed {
                let Some(other) = tessellated.get(place) else {
                    // Inside triangles the tessellator has rings, grids have rows.
                    let record = &surface.plan().patches[vertex.patch as usize];
                    assert_eq!(record.sides(), 3, "{}, {scheme}: only computed: {vertex:?}", specimen.name);
                    continue;
                };
                common += 1;
                assert!(
                    same(&values(vertex), &values(other), exact),
                    "{}, {scheme}: {vertex:?} was computed, {other:?} drawn",
                    specimen.name
                );
            }
            assert!(2 * common > tessellated.len(), "{}, {scheme}: {common}", specimen.name);
        }
    }
}

/// At any parameters, against the sampling kernels, which the tests of sampling hold to the tessellator.
#[test]
fn the_compute_evaluator_gives_the_bits_of_the_sampling_kernels() {
    let gpu = gpu();
    let exact = gpu.device().info().is_llvmpipe;
    for (specimen, &scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |s| (specimen, s))) {
        let surface = surface_of(&gpu, &specimen.cage, scheme, None).unwrap();
        let level = if is_large(&surface) { 1.4 } else { 3.4 };
        let vertices = captured(&surface, &in_compute(level, Spacing::Odd));
        let request = |v: &CapturedVertex| SampleRequest { patch_id: v.patch, u: v.uv[0], v: v.uv[1] };
        let samples = surface.evaluate(&vertices.iter().map(request).collect::<Vec<_>>()).unwrap();
        for (vertex, sample) in vertices.iter().zip(samples.chunks_exact(12)) {
            let sampled = [sample[0], sample[1], sample[2], sample[9], sample[10], sample[11]];
            assert!(
                same(&values(vertex), &sampled, exact),
                "{}, {scheme}: {vertex:?} was computed, {sampled:?} sampled",
                specimen.name
            );
        }
    }
}

fn assert_watertight(name: &str, surface: &Surface, tessellation: &Tessellation) -> CheckReport {
    let report = check(surface, tessellation).unwrap();
    assert!(report.is_watertight(), "{name}, {tessellation:?}: {report:?}");
    // Grids have neither segments nor triangles without extent.
    assert_eq!(report.degenerate, 0, "{name}, {tessellation:?}: {report:?}");
    assert!(report.triangles >= surface.plan().patches.len() as u64, "{name}: {report:?}");
    report
}

#[test]
fn grids_of_the_zoo_are_watertight_in_every_scheme() {
    let gpu = gpu();
    for (specimen, &scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |s| (specimen, s))) {
        let surface = surface_of(&gpu, &specimen.cage, scheme, None).unwrap();
        let name = format!("{}, {scheme}", specimen.name);
        assert_watertight(&name, &surface, &in_compute(1.0, Spacing::Equal));
        let level = if is_large(&surface) { 1.4 } else { 3.3 };
        assert_watertight(&name, &surface, &in_compute(level, Spacing::Odd));
        assert_watertight(&name, &surface, &adaptive(&specimen.cage, Spacing::Odd));
    }
}

#[test]
fn grids_are_watertight_at_any_level_and_spacing() {
    let gpu = gpu();
    for name in ["shell", "ngon"] {
        let cage = zoo::shipped(name);
        for scheme in [Scheme::Gregory1, Scheme::Gregory2] {
            let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
            for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
                for level in [2.0, 2.001, 5.0, 6.999] {
                    assert_watertight(&format!("{name}, {scheme}"), &surface, &in_compute(level, spacing));
                }
                assert_watertight(&format!("{name}, {scheme}"), &surface, &adaptive(&cage, spacing));
            }
        }
    } // The most segments there are, on the fewest patches.
    let cube = surface_of(&gpu, &zoo::shipped("cube"), Scheme::Gregory1, None).unwrap();
    for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
        assert_watertight("cube", &cube, &in_compute(64.0, spacing));
    }
}

#[test]
fn grids_are_watertight_under_every_boundary_rule() {
    let gpu = gpu();
    for (specimen, &rule) in
        zoo::all().iter().flat_map(|specimen| rules_of(&specimen.cage).iter().map(move |rule| (specimen, rule)))
    {
        let Some(surface) = surface(&gpu, &specimen.cage, Some(rule)) else { continue };
        assert_watertight(&format!("{}, {rule:?}", specimen.name), &surface, &in_compute(3.0, Spacing::Equal));
    }
}

#[test]
fn an_integer_level_gives_two_triangles_a_cell() {
    let gpu = gpu();
    let surface = surface(&gpu, &zoo::shipped("twohole"), None).unwrap();
    for n in [1u64, 2, 7, 64] {
        let report = assert_watertight("twohole", &surface, &in_compute(n as f32, Spacing::Equal));
        assert_eq!(report.triangles, surface.plan().patches.len() as u64 * 2 * n * n);
    }
}

#[test]
fn many_patches_are_evaluated_once_each() {
    let gpu = gpu();
    let grid = surface(&gpu, &zoo::grid(100, 100), None).unwrap();
    assert_eq!(grid.plan().patches.len(), 40_000);
    assert_watertight("large grid", &grid, &in_compute(2.0, Spacing::Equal));
}

/// An engine whose chunks hold a few patches.
fn in_small_chunks() -> osculate_tests::Gpu {
    gpu_with(EngineDesc { grid_vertices: Some(500), ..EngineDesc::default() })
}

#[test]
fn chunks_do_not_show() {
    let (gpu, small) = (gpu(), in_small_chunks());
    let cage = zoo::shipped("twohole");
    for tessellation in [in_compute(6.0, Spacing::Equal), adaptive(&cage, Spacing::Odd)] {
        let surfaces = [&gpu, &small].map(|engine| surface(engine, &cage, None).unwrap());
        assert_watertight("twohole in chunks", &surfaces[1], &tessellation);
        let [whole, parts] = surfaces.each_ref().map(|surface| captured(surface, &tessellation));
        assert!(bytemuck::cast_slice::<_, u8>(&whole) == bytemuck::cast_slice::<_, u8>(&parts));
        for shade in [Shade::Lit, Shade::Curvature] {
            let desc = RenderDesc { tessellation, shade, cage: true, ..RenderDesc::fit(&cage, [192, 192]) };
            let [whole, parts] =
                [(&gpu, &surfaces[0]), (&small, &surfaces[1])].map(|(gpu, one)| draw_surfaces(gpu, &[one], &desc));
            assert!(whole.rgba() == parts.rgba(), "{shade:?}");
        }
    }
}

/// The cage with two holes as the goldens have it.
fn twohole(engine: &osculate::Engine, shade: Shade) -> Picture {
    let cage = zoo::shipped("twohole");
    draw(engine, &cage, [256, 256], |desc| {
        desc.camera = camera(&cage, [0.7, 0.5, 1.5], 2.3, 45.0);
        desc.tessellation = Tessellation { evaluator: Evaluator::Compute, ..desc.tessellation };
        desc.shade = shade;
        if shade == Shade::Peer {
            (desc.samples, desc.background) = (1, [0.1, 0.1, 0.1, 1.0]);
        }
    })
}

/// Triangles lie a little differently, so pictures are held to the limits of another device.
#[test]
fn grids_look_like_the_goldens() {
    let gpu = gpu();
    let mut gallery = Gallery::of_another_device();
    for &shade in Shade::ALL.iter().filter(|&&shade| shade != Shade::Wireframe) {
        gallery.check(&format!("shade_{}", shade.name()), &twohole(&gpu, shade));
    }
    gallery.finish();
}

/// Both evaluators have the same vertices, so about as many pixels are darkened by lines.
#[test]
fn the_edges_of_grids_are_drawn() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let darkened = |evaluator| {
        let picture = |shade| {
            draw(&gpu, &cage, [256, 256], |desc| {
                desc.tessellation = Tessellation { evaluator, ..Tessellation::uniform(4.0) };
                desc.shade = shade;
            })
        };
        let (lit, wireframe) = (picture(Shade::Lit), picture(Shade::Wireframe));
        lit.pixels().zip(wireframe.pixels()).filter(|(lit, wire)| lit[1] > wire[1].saturating_add(20)).count()
    };
    let (tessellator, compute) = (darkened(Evaluator::Tessellator), darkened(Evaluator::Compute));
    assert!(tessellator > 2_000 && compute.abs_diff(tessellator) < tessellator / 20, "{tessellator}, {compute}");
}

/// Checks grids with a changed shader: `noticed` is what the check must have seen.
fn sabotaged(mutation: Mutation, noticed: impl Fn(&CheckReport) -> bool) {
    check_sabotaged(&gpu_with_shaders(mutated(&[mutation])), noticed);
}

fn check_sabotaged(gpu: &Engine, noticed: impl Fn(&CheckReport) -> bool) {
    for name in ["twohole", "dragon"] {
        let surface = surface(gpu, &zoo::shipped(name), None).unwrap();
        let report = check(&surface, &in_compute(5.0, Spacing::Equal)).unwrap();
        assert!(!report.is_watertight() && noticed(&report), "{name}: the check did not notice: {report:?}");
    }
}

fn in_border_stage(from: &'static str, to: &'static str) -> Mutation {
    Mutation { path: "include/border_stage.glsl", from, to }
}

#[test]
fn vertices_at_the_wrong_parameter_of_an_edge_are_noticed() {
    let reversed = Mutation {
        path: "include/grids/quad.glsl",
        from: "side == 2u ? vec2(back, 1.0)",
        to: "side == 2u ? vec2(1.0 - back, 1.0)",
    };
    sabotaged(reversed, |report| report.inverted > 0);
    let shifted = Mutation {
        path: "include/grids/quad.glsl",
        from: "side == 0u ? vec2(along, 0.0)",
        to: "side == 0u ? vec2(along * (along < 1.0 ? 1.0000001 : 1.0), 0.0)",
    };
    sabotaged(shifted, |report| report.open > 0);
}

#[test]
fn edges_numbered_in_the_wrong_direction_are_noticed() {
    sabotaged(in_border_stage("(flipped ? last - i : i)", "(flipped ? i : last - i)"), |report| report.inverted > 0);
    sabotaged(in_border_stage("(flipped ? last - i : i)", "i"), |report| {
        report.inverted > 0 && report.split_positions > 0
    });
}

/// Which of the two stages makes inner vertices depends on the device.
fn in_inner_stages(group: [&'static str; 2], lane: [&'static str; 2]) {
    let mutations = [("include/grid_stage.glsl", group), ("include/lane_stage.glsl", lane)];
    for (lanes, (path, [from, to])) in [false, true].into_iter().zip(mutations) {
        let shaders = mutated(&[Mutation { path, from, to }]);
        let gpu = gpu_with(EngineDesc { shaders, grid_lanes: Some(lanes), ..EngineDesc::default() });
        check_sabotaged(&gpu, |report| report.inverted > 0 || report.wrong_patches > 0);
    }
}

#[test]
fn vertices_in_the_wrong_place_are_noticed() {
    in_inner_stages(
        ["store_vertex(grid.first_inner + i, uv,", "store_vertex(grid.first_inner + (i ^ 1u), uv,"],
        ["first + j * width + i,", "first + j * width + (i ^ 1u),"],
    );
}

#[test]
fn patches_that_are_left_out_are_noticed() {
    in_inner_stages(
        ["if (index >= kernel.count) {", "if (index + 1u >= kernel.count) {"],
        ["if (thread >= kernel.count) {", "if (thread + 1u >= kernel.count) {"],
    );
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn grids_of_the_reference_cages_are_watertight() {
    let gpu = gpu();
    let levels = [in_compute(3.0, Spacing::Equal), in_compute(2.6, Spacing::Odd)];
    let mut checked = 0;
    for (number, file) in zoo::reference_cages(&reference_folder()).iter().enumerate() {
        let Ok(cage) = Cage::read(file) else { continue };
        for (turn, &scheme) in schemes_in_turn(number, &cage).iter().enumerate() {
            let Some(surface) = surface_of(&gpu, &cage, scheme, None) else { continue };
            assert_watertight(&format!("{}, {scheme}", file.display()), &surface, &levels[(number + turn) % 2]);
            checked += 1;
        }
    }
    assert!(checked > 100, "only {checked} surfaces were found");
}
