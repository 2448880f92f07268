//! No cracks: proof by record keys over the zoo, and proof that the proof can fail.

use glam::DVec3;
use osculate::{Cage, Camera, CheckReport, EngineDesc, Factors, Scheme, Spacing, Surface, Tessellation, check};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::{
    gpu, gpu_with, gpu_with_shaders, levels_of, reference_folder, rules_of, schemes_in_turn, surface, surface_of, zoo,
};

fn assert_watertight(name: &str, surface: &Surface, tessellation: &Tessellation) -> CheckReport {
    let report = check(surface, tessellation).unwrap();
    assert!(report.is_watertight(), "{name}, {tessellation:?}: {report:?}");
    assert!(report.triangles >= surface.plan().patches.len() as u64, "{name}: {report:?}");
    report
}

fn level(level: f32, spacing: Spacing) -> Tessellation {
    Tessellation { spacing, ..Tessellation::uniform(level) }
}

/// Adaptive factors from around the cage, some near enough that factors differ much.
fn adaptive(cage: &Cage, pixels: f32) -> Vec<Tessellation> {
    let bounds = cage.bounds();
    let directions = [DVec3::new(1.0, 0.75, 1.5), DVec3::new(-0.7, 0.1, 0.4)];
    let camera = |(direction, distance): (DVec3, f64)| {
        let eye = bounds.center() + distance * bounds.half_diagonal() * direction.normalize();
        Camera::look_at(eye, bounds.center(), DVec3::Y, 0.8, bounds).unwrap()
    };
    let tessellation = |(i, camera)| Tessellation {
        factors: Factors::Adaptive { pixels, camera, height: 256 },
        spacing: [Spacing::Odd, Spacing::Equal][i % 2],
        ..Tessellation::default()
    };
    directions.into_iter().zip([2.5, 1.1]).map(camera).enumerate().map(tessellation).collect()
}

#[test]
fn the_zoo_is_watertight_at_integer_and_fractional_levels() {
    let gpu = gpu();
    for (specimen, scheme) in zoo::all().iter().flat_map(|specimen| Scheme::ALL.iter().map(move |&s| (specimen, s))) {
        for &rule in rules_of(&specimen.cage) {
            let Some(surface) = surface_of(&gpu, &specimen.cage, scheme, Some(rule)) else { continue };
            let name = format!("{}, {scheme}, {rule:?}", specimen.name);
            for &(height, spacing) in levels_of(&surface) {
                let report = assert_watertight(&name, &surface, &level(height, spacing));
                assert_eq!(report.weld.open, 0, "{name}: {report:?}");
            }
        }
    }
}

#[test]
fn the_zoo_is_watertight_with_adaptive_factors() {
    let gpu = gpu();
    for specimen in zoo::all() {
        for &scheme in Scheme::ALL {
            let Some(surface) = surface_of(&gpu, &specimen.cage, scheme, None) else { continue };
            for tessellation in adaptive(&specimen.cage, 8.0) {
                assert_watertight(&format!("{}, {scheme}", specimen.name), &surface, &tessellation);
            }
        }
    }
}

/// A uniform level gives every patch the same number of triangles, so the count tells that all were drawn.
#[test]
fn an_integer_level_gives_two_triangles_a_cell() {
    let gpu = gpu();
    let surface = surface(&gpu, &zoo::shipped("twohole"), None).unwrap();
    for n in [1u64, 2, 7] {
        let report = check(&surface, &Tessellation::uniform(n as f32)).unwrap();
        assert_eq!(report.triangles, surface.plan().patches.len() as u64 * 2 * n * n);
    }
}

/// llvmpipe garbles the triangles of a draw with more than 65 535 tessellated vertices, without a word: 64 patches at level 64 have four times as many.
#[test]
fn many_vertices_in_a_draw_keep_their_triangles() {
    let gpu = gpu();
    let drawn = surface(&gpu, &zoo::grid(4, 4), None).unwrap();
    assert_eq!(drawn.plan().patches.len(), 64);
    let report = assert_watertight("grid", &drawn, &level(64.0, Spacing::Equal));
    assert_eq!(report.triangles, 64 * 2 * 64 * 64);
}

/// The defect itself, so that the test above is known to see it. Later versions of Mesa may not have it.
#[test]
fn too_many_vertices_in_a_draw_are_noticed_where_the_driver_garbles_them() {
    let gpu = gpu_with(EngineDesc { patches_per_draw: Some(u32::MAX), ..EngineDesc::default() });
    let drawn = surface(&gpu, &zoo::grid(4, 4), None).unwrap();
    let report = check(&drawn, &level(40.0, Spacing::Equal)).unwrap();
    let info = gpu.device().info();
    let has_defect = info.is_llvmpipe && info.driver_info.contains("Mesa 22.");
    assert_eq!(report.is_watertight(), !has_defect, "{}: {report:?}", info.driver_info);
}

/// gl_PrimitiveID restarts every 4 096 vertices on llvmpipe; the proof counts that each of 40 000 patches is drawn once, as itself.
#[test]
fn many_patches_in_a_draw_keep_their_numbers() {
    let gpu = gpu();
    let drawn = surface(&gpu, &zoo::grid(100, 100), None).unwrap();
    assert_eq!(drawn.plan().patches.len(), 40_000);
    assert_watertight("large grid", &drawn, &level(1.0, Spacing::Equal));
}

/// Numbers from gl_PrimitiveID would be noticed: they restart at every draw, and on llvmpipe within draws.
#[test]
fn patches_numbered_by_the_device_are_noticed() {
    let mutation = Mutation {
        path: "include/control_stage.glsl",
        from: "uint id = net_patch[0];",
        to: "uint id = list.first_patch + uint(gl_PrimitiveID);",
    };
    let gpu =
        gpu_with(EngineDesc { shaders: mutated(&[mutation]), patches_per_draw: Some(5_000), ..EngineDesc::default() });
    let drawn = surface(&gpu, &zoo::grid(100, 100), None).unwrap();
    let report = check(&drawn, &level(1.0, Spacing::Equal)).unwrap();
    assert!(report.wrong_patches > 0, "{report:?}");
}

/// The same cage gives the same bits.
#[test]
fn two_captures_are_equal() {
    let gpu = gpu();
    let bytes = || {
        let drawn = surface(&gpu, &zoo::shipped("dragon"), None).unwrap();
        let mut bytes: Vec<u8> = Vec::new();
        drawn
            .capture(&level(3.0, Spacing::Even), |vertices| {
                bytes.extend_from_slice(bytemuck::cast_slice(vertices));
                Ok::<(), osculate::EngineError>(())
            })
            .unwrap();
        bytes
    };
    assert!(bytes() == bytes());
}

/// Cages far from the origin, very small and very large.
#[test]
fn place_and_size_do_not_matter() {
    let gpu = gpu();
    for name in ["twohole", "shell", "ngon"] {
        let cage = zoo::shipped(name);
        for (scale, offset) in [(1.0, 1e5), (1e-3, 0.0), (1e3, 0.0), (1e-3, 1e5)] {
            let moved = zoo::moved(&cage, scale, DVec3::splat(offset));
            for &scheme in Scheme::ALL {
                let surface = surface_of(&gpu, &moved, scheme, None).unwrap();
                assert_watertight(
                    &format!("{name} x {scale} + {offset}, {scheme}"),
                    &surface,
                    &level(4.0, Spacing::Equal),
                );
            }
        }
    }
}

/// Checks surfaces with changed shaders: `noticed` is what the check must have seen.
fn sabotaged(
    mutations: &[Mutation],
    tessellation: impl Fn(&Cage) -> Tessellation,
    noticed: impl Fn(&CheckReport) -> bool,
) {
    sabotaged_schemes(&[Scheme::Gregory2], mutations, tessellation, noticed);
}

/// The same in some schemes.
fn sabotaged_schemes(
    schemes: &[Scheme],
    mutations: &[Mutation],
    tessellation: impl Fn(&Cage) -> Tessellation,
    noticed: impl Fn(&CheckReport) -> bool,
) {
    let gpu = gpu_with_shaders(mutated(mutations));
    for (name, &scheme) in ["twohole", "dragon"].iter().flat_map(|name| schemes.iter().map(move |s| (name, s))) {
        let cage = zoo::shipped(name);
        let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
        let report = check(&surface, &tessellation(&cage)).unwrap();
        assert!(!report.is_watertight() && noticed(&report), "{name}, {scheme}: the check did not notice: {report:?}");
    }
}

#[test]
fn edges_evaluated_from_patches_are_noticed() {
    let mutation = Mutation {
        path: "include/forms/form.glsl",
        from: "if (side == 4u) {",
        to: "if (side == 4u || corner_of(uv) == 4u) {",
    };
    sabotaged(
        &[mutation],
        |_| level(5.0, Spacing::Equal),
        |report| report.split_positions > 0 && report.open >= report.split_positions,
    );
}

#[test]
fn corners_evaluated_from_edges_are_noticed() {
    let mutation = Mutation { path: "include/forms/form.glsl", from: "if (corner != 4u) {", to: "if (corner > 4u) {" };
    sabotaged(&[mutation], |_| level(5.0, Spacing::Equal), |report| report.split_positions > 0);
}

#[test]
fn a_parameter_that_is_not_reversed_is_noticed() {
    let mutation = Mutation {
        path: "include/domains/quad.glsl",
        from: "return ((side >> 1u) ^ flip) == 1u ? reversed : x;",
        to: "return (side >> 1u) == 1u ? reversed : x;",
    };
    sabotaged(&[mutation], |_| level(5.0, Spacing::Equal), |report| report.split_positions > 0 && report.open > 0);
}

#[test]
fn factors_from_the_centre_of_patches_are_noticed() {
    let outer = |from, to| Mutation { path: "include/factors.glsl", from, to };
    let mutations = [
        outer("gl_TessLevelOuter[0] = f3;", "gl_TessLevelOuter[0] = 0.25 * (f0 + f1 + f2 + f3);"),
        outer("gl_TessLevelOuter[1] = f0;", "gl_TessLevelOuter[1] = 0.25 * (f0 + f1 + f2 + f3);"),
        outer("gl_TessLevelOuter[2] = f1;", "gl_TessLevelOuter[2] = 0.25 * (f0 + f1 + f2 + f3);"),
        outer("gl_TessLevelOuter[3] = f2;", "gl_TessLevelOuter[3] = 0.25 * (f0 + f1 + f2 + f3);"),
    ];
    sabotaged(&mutations, |cage| adaptive(cage, 1.5)[0], |report| report.open > 0 && report.split_positions == 0);
}

#[test]
fn a_normal_of_the_patch_on_an_edge_is_noticed() {
    let mutation = Mutation {
        path: "include/forms/form.glsl",
        from: "    if (!shared_point(id, uv, point)) {\n        point = SurfacePoint",
        to: "    bool on_record = shared_point(id, uv, point);\n    point.normal = unit_or_zero(inner.plane);\n    if (!on_record) {\n        point = SurfacePoint",
    };
    sabotaged(&[mutation], |_| level(5.0, Spacing::Equal), |report| report.split_normals > 0 && report.open == 0);
}

/// Schemes that have spoke records.
const WITH_SPOKES: [Scheme; 2] = [Scheme::Stam, Scheme::Biseptic];

/// Both forms with spokes, with the expression `to_stam` or `to_biseptic` in place of the spoke's point.
fn with_spokes(to_stam: &'static str, to_biseptic: &'static str) -> [Mutation; 2] {
    [
        Mutation {
            path: "include/forms/stam.glsl",
            from: "return is_spoke(side) ? stam_spoke_point(spoke_of(id, side), spoke_parameter(side, uv))",
            to: to_stam,
        },
        Mutation {
            path: "include/forms/biseptic.glsl",
            from: "return is_spoke(side) ? biseptic_spoke_point(spoke_of(id, side), spoke_parameter(side, uv))",
            to: to_biseptic,
        },
    ]
}

#[test]
fn spokes_evaluated_from_patches_are_noticed() {
    let own = "InnerPoint p = inner_point(id, uv);
        return is_spoke(side) ? SurfacePoint(p.position, unit_or_zero(p.plane))";
    let noticed = |report: &CheckReport| report.split_positions > 0 && report.split_normals > 0;
    sabotaged_schemes(&WITH_SPOKES, &with_spokes(own, own), |_| level(5.0, Spacing::Equal), noticed);
}

#[test]
fn a_normal_of_the_patch_on_a_spoke_is_noticed() {
    let mutations = with_spokes(
        "vec3 position = stam_spoke_point(spoke_of(id, side), spoke_parameter(side, uv)).position;
        return is_spoke(side) ? SurfacePoint(position, unit_or_zero(inner_point(id, uv).plane))",
        "vec3 position = biseptic_spoke_point(spoke_of(id, side), spoke_parameter(side, uv)).position;
        return is_spoke(side) ? SurfacePoint(position, unit_or_zero(inner_point(id, uv).plane))",
    );
    let noticed = |report: &CheckReport| report.split_normals > 0 && report.open == 0;
    sabotaged_schemes(&WITH_SPOKES, &mutations, |_| level(5.0, Spacing::Equal), noticed);
}

#[test]
fn a_spoke_walked_towards_the_vertex_by_one_patch_is_noticed() {
    let mutation = Mutation {
        path: "include/spokes.glsl",
        from: "return side == 0u ? uv.x : uv.y;",
        to: "return side == 0u ? uv.x : 1.0 - uv.y;",
    };
    let noticed = |report: &CheckReport| report.split_positions > 0 && report.open > 0;
    sabotaged_schemes(&WITH_SPOKES, &[mutation], |_| level(5.0, Spacing::Equal), noticed);
}

#[test]
fn a_spoke_that_one_patch_reads_from_the_cubic_record_is_noticed() {
    let mutation =
        Mutation { path: "include/spokes.glsl", from: "return side == 0u || side == 3u;", to: "return side == 0u;" };
    sabotaged_schemes(&WITH_SPOKES, &[mutation], |_| level(5.0, Spacing::Equal), |report| report.split_positions > 0);
}

#[test]
fn triangles_that_run_the_wrong_way_are_noticed() {
    let mutation = Mutation {
        path: "include/evaluation_stage.glsl",
        from: "layout(DOMAIN, SPACING, cw) in;",
        to: "layout(DOMAIN, SPACING, ccw) in;",
    };
    sabotaged(
        &[mutation],
        |_| level(2.0, Spacing::Equal),
        |report| report.inverted == report.triangles && report.open == 0,
    );
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn the_reference_cages_are_watertight() {
    let gpu = gpu();
    let levels = [level(3.0, Spacing::Equal), level(2.6, Spacing::Odd)];
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
