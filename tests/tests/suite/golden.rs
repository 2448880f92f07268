//! Pictures against their goldens: equal spacing at integer levels only. What a picture shows that numbers can judge stands in `pictures`.

use osculate::{BoundaryRule, Cage, Engine, RenderDesc, Scheme, Shade, Surface, SurfaceDesc, Tessellation};
use osculate_compare::{GoldenError, Goldens, Limits, Picture, load};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::{Gallery, camera, close_up, draw, draw_moments, draw_surfaces};
use osculate_tests::{gpu, gpu_with_shaders, legend, zoo};

const SIZE: [u32; 2] = [256, 256];

/// The cage with two holes, close enough to fill the picture.
fn twohole(engine: &Engine, change: impl FnOnce(&mut RenderDesc)) -> Picture {
    let cage = zoo::shipped("twohole");
    draw(engine, &cage, SIZE, |desc| {
        desc.camera = camera(&cage, [0.7, 0.5, 1.5], 2.3, 45.0);
        change(desc);
    })
}

/// A cage from a direction, close, in the colours of `shade`.
fn close(engine: &Engine, cage: &Cage, direction: [f64; 3], shade: Shade) -> Picture {
    draw(engine, cage, SIZE, |desc| {
        desc.camera = camera(cage, direction, 2.2, 45.0);
        desc.shade = shade;
    })
}

#[test]
fn every_shade_that_is_no_wireframe() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    for &shade in Shade::ALL.iter().filter(|&&shade| shade != Shade::Wireframe) {
        let picture = twohole(&gpu, |desc| {
            desc.shade = shade;
            if shade == Shade::Peer {
                (desc.samples, desc.background) = (1, [0.1, 0.1, 0.1, 1.0]);
            }
        });
        gallery.check(&format!("shade_{}", shade.name()), &picture);
    }
    gallery.finish();
}

#[test]
fn the_dragon() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let dragon = zoo::shipped("dragon");
    for shade in [Shade::Lit, Shade::Valence, Shade::Curvature] {
        let picture = draw(&gpu, &dragon, [288, 240], |desc| {
            desc.camera = camera(&dragon, [1.0, 0.45, 1.6], 1.8, 45.0);
            desc.tessellation = Tessellation::uniform(4.0);
            desc.shade = shade;
        });
        gallery.check(&format!("dragon_{}", shade.name()), &picture);
    }
    gallery.finish();
}

#[test]
fn the_dragon_walks() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let cage = zoo::walking_dragon();
    let desc = RenderDesc {
        camera: zoo::walk_camera(&cage),
        tessellation: Tessellation::uniform(4.0),
        ..RenderDesc::fit(&cage, [288, 240])
    };
    let percents = [0, 30, 70];
    let times = percents.map(|percent| f64::from(percent) / 100.0);
    for (percent, picture) in percents.iter().zip(draw_moments(&gpu, &cage, &desc, times)) {
        gallery.check(&format!("walk_{percent}"), &picture);
    }
    gallery.finish();
}

#[test]
fn the_cage_over_the_surface() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    gallery.check("overlay_twohole", &twohole(&gpu, |desc| desc.cage = true));
    // The cage of a grid lies on its surface where that is flat.
    let grid = zoo::shipped("grid");
    gallery.check("overlay_grid", &draw(&gpu, &grid, SIZE, |desc| desc.cage = true));
    gallery.finish();
}

#[test]
fn boundaries_under_each_rule_and_the_inside() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let shell = zoo::shipped("shell");
    for (name, rule) in [
        ("edge_and_corner", BoundaryRule::EdgeAndCorner),
        ("edge_only", BoundaryRule::EdgeOnly),
        ("none", BoundaryRule::None),
    ] {
        let surface =
            Surface::new(&gpu, &shell, &SurfaceDesc { boundary: Some(rule), ..SurfaceDesc::default() }).unwrap();
        let desc = RenderDesc {
            shade: Shade::Patches,
            camera: camera(&shell, [0.8, 1.0, 1.2], 2.2, 45.0),
            ..RenderDesc::fit(&shell, SIZE)
        };
        gallery.check(&format!("boundary_{name}"), &draw_surfaces(&gpu, &[&surface], &desc));
    }
    gallery.check("boundary_fan", &close(&gpu, &zoo::boundary_fan(6), [0.2, 1.0, 0.6], Shade::Patches));
    gallery.check("inside", &close(&gpu, &shell, [0.7, -0.8, 1.0], Shade::Lit));
    gallery.finish();
}

#[test]
fn faces_of_any_size_and_vertices_of_any_valence() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let above = [0.25, 1.0, 0.6];
    gallery.check("ngon", &close(&gpu, &zoo::shipped("ngon"), [1.0, 0.75, 1.5], Shade::Patches));
    gallery.check("heptagon", &close(&gpu, &zoo::fan(7), above, Shade::Patches));
    gallery.check("triangles", &close(&gpu, &zoo::shipped("triangles"), [1.0, 0.75, 1.5], Shade::Valence));
    gallery.check("valence_2", &close(&gpu, &zoo::pillow(), above, Shade::Zebra));
    for valence in [3, 5, 12, 32] {
        let star = zoo::shipped(&format!("star{valence}"));
        gallery.check(&format!("valence_{valence}"), &close(&gpu, &star, above, Shade::Zebra));
    }
    gallery.check("valence_64", &close(&gpu, &zoo::shipped("uvsphere"), above, Shade::Lit));
    gallery.check("valence_200", &close(&gpu, &zoo::pole(200), above, Shade::Lit));
    gallery.finish();
}

#[test]
fn schemes_about_extraordinary_vertices() {
    use Scheme::{Biseptic, Gregory1, Gregory2, Stam};
    use Shade::{Gaussian, Lit, Reflection, Zebra};
    const PICTURES: [(&str, &[Scheme], &[Shade]); 9] = [
        ("star3", &[Stam, Biseptic], &[Reflection]),
        ("star5", &[Stam, Biseptic], &[Zebra, Gaussian]),
        ("saddle8", &[Gregory1, Gregory2, Stam, Biseptic], &[Zebra, Reflection]),
        ("saddle12", &[Gregory2, Stam, Biseptic], &[Zebra, Gaussian]),
        ("fan", &[Stam], &[Reflection, Gaussian]),
        ("shell", &[Stam], &[Lit, Zebra]),
        ("pole", &[Stam], &[Zebra]),
        ("triangles", &[Gregory1, Stam, Biseptic], &[Reflection]),
        ("dragon", &[Stam, Biseptic], &[Lit, Gaussian]),
    ];
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    for (name, schemes, shades) in PICTURES {
        for (&scheme, &shade) in schemes.iter().flat_map(|scheme| shades.iter().map(move |shade| (scheme, shade))) {
            let picture = close_up(&gpu, name, scheme, shade, SIZE);
            gallery.check(&format!("{scheme}_{name}_{}", shade.name()), &picture);
        }
    }
    gallery.finish();
}

#[test]
fn backgrounds_and_samples() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    gallery.check("background_light", &twohole(&gpu, |desc| desc.background = [0.8, 0.85, 0.9, 1.0]));
    gallery.check("background_transparent", &twohole(&gpu, |desc| desc.background = [0.0; 4]));
    gallery.check("background_half", &twohole(&gpu, |desc| desc.background = [0.1, 0.2, 0.8, 0.5]));
    gallery.check("samples_1", &twohole(&gpu, |desc| desc.samples = 1));
    gallery.check("level_1", &twohole(&gpu, |desc| desc.tessellation = Tessellation::uniform(1.0)));
    gallery.finish();
}

#[test]
fn framing_at_odd_ratios_and_several_surfaces() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let twohole = zoo::shipped("twohole");
    for [width, height] in [[384, 128], [192, 256]] {
        gallery
            .check(&format!("fit_{width}x{height}"), &draw(&gpu, &twohole, [width, height], |desc| desc.cage = true));
    }
    let beside = zoo::moved(&zoo::shipped("cube"), 0.5, glam::DVec3::new(0.0, 1.0, 0.0));
    let surfaces = [&twohole, &beside].map(|cage| Surface::new(&gpu, cage, &SurfaceDesc::default()).unwrap());
    let desc = RenderDesc { cage: true, ..RenderDesc::fit(&twohole, SIZE) };
    gallery.check("several", &draw_surfaces(&gpu, &[&surfaces[0], &surfaces[1]], &desc));
    gallery.finish();
}

/// The golden of the lit picture, never blessed; what does not pass is left in a folder of its own.
fn judge(picture: &Picture, limits: Limits) -> Result<(), GoldenError> {
    let goldens = Goldens::new(folder_of_goldens());
    let goldens = Goldens { side_folder: goldens.side_folder.join("refused"), bless: false, ..goldens };
    goldens.check("shade_lit", picture, &limits).map(drop)
}

fn folder_of_goldens() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens")
}

fn assert_refused(picture: &Picture) {
    for limits in [Limits::SAME_DRIVER, Limits::OTHER_DEVICE] {
        let judged = judge(picture, limits);
        assert!(matches!(judged, Err(GoldenError::Differs { .. })), "{limits:?}: {judged:?}");
    }
}

#[test]
fn another_shade_level_or_sample_count_is_refused() {
    let gpu = gpu();
    judge(&twohole(&gpu, |_| ()), Limits::for_device(gpu.device().info().is_llvmpipe)).unwrap();
    assert_refused(&twohole(&gpu, |desc| desc.shade = Shade::Zebra));
    assert_refused(&twohole(&gpu, |desc| desc.cage = true));
    assert_refused(&twohole(&gpu, |desc| desc.tessellation = Tessellation::uniform(1.0)));
    // Outlines alone: within what other devices are allowed.
    let jagged = judge(&twohole(&gpu, |desc| desc.samples = 1), Limits::SAME_DRIVER);
    assert!(matches!(jagged, Err(GoldenError::Differs { .. })), "{jagged:?}");
}

#[test]
fn changed_shaders_are_refused() {
    let mutations = [
        // Lights that do not follow the camera.
        Mutation { path: "include/frame.glsl", from: "mat3(frame.view_from_cage) * normal", to: "normal" },
        // An eye at the middle of the surface.
        Mutation {
            path: "include/frame.glsl",
            from: "(frame.view_from_cage * vec4(position, 1.0)).xyz",
            to: "position",
        },
        // A surface that is a little too large.
        Mutation {
            path: "include/evaluation_stage.glsl",
            from: "gl_Position = clip_position(point.position);",
            to: "gl_Position = clip_position(1.02 * point.position);",
        },
        // Flat normals along edges.
        Mutation {
            path: "include/evaluation_stage.glsl",
            from: "shade_direction(point.normal)",
            to: "shade_direction(side_of(uv) == 4u ? point.normal : vec3(0.0, 0.0, 1.0))",
        },
    ];
    for mutation in mutations {
        let gpu = gpu_with_shaders(mutated(&[mutation]));
        assert_refused(&twohole(&gpu, |_| ()));
    }
}

/// The swatches in docs/images are what is drawn today.
#[test]
fn the_legend_is_true() {
    let gpu = gpu();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/images");
    for swatch in legend::swatches() {
        let drawn = swatch.draw(&gpu);
        let committed = load(&folder.join(format!("{}.png", swatch.name))).unwrap();
        let pairs = drawn.rgba().iter().zip(committed.rgba());
        let furthest = pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(furthest <= 3, "{}: {furthest}; run cargo xtask pictures", swatch.name);
    }
}

/// Kinds that the legend tells apart look apart.
#[test]
fn colours_of_the_legend_are_distinct() {
    let gpu = gpu();
    for shade in [Shade::Patches, Shade::Valence, Shade::Curvature, Shade::Gaussian, Shade::Factors] {
        let swatches: Vec<_> = legend::swatches().into_iter().filter(|swatch| swatch.shade == shade).collect();
        let colours: Vec<_> = swatches.iter().map(|swatch| swatch.draw(&gpu).pixels().next().unwrap()).collect();
        for (i, a) in colours.iter().enumerate() {
            for (j, b) in colours.iter().enumerate().skip(i + 1) {
                let apart: u32 = (0..3).map(|c| u32::from(a[c].abs_diff(b[c]))).sum();
                assert!(apart >= 16, "{} and {}: {a:?}, {b:?}", swatches[i].name, swatches[j].name);
            }
        }
    }
}
