//! What pictures show, judged by numbers: lines where edges are, backgrounds, refusals.

use glam::{DVec2, DVec3};
use osculate::{
    Cage, Camera, CapturedVertex, EngineError, Evaluator, GpuError, RenderDesc, Shade, Surface, SurfaceDesc,
    Tessellation, render,
};
use osculate_compare::Picture;
use osculate_tests::picture::{camera, draw, draw_surfaces};
use osculate_tests::{gpu, zoo};

const MAGENTA: [f32; 4] = [1.0, 0.0, 1.0, 1.0];
const MAGENTA_BYTES: [u8; 4] = [255, 0, 255, 255];

fn at(picture: &Picture, x: u32, y: u32) -> [u8; 4] {
    let first = 4 * (y as usize * picture.size().width as usize + x as usize);
    picture.rgba()[first..first + 4].try_into().unwrap()
}

fn luma([r, g, b, _]: [u8; 4]) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

#[test]
fn corners_have_the_colour_of_the_background() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    for samples in [1, 4] {
        let picture = draw(&gpu, &cage, [64, 48], |desc| {
            desc.samples = samples;
            // 55/255, 188/255 and 1 as sRGB.
            desc.background = [0.038_204_4, 0.502_886_5, 1.0, 1.0];
        });
        for (x, y) in [(0, 0), (63, 0), (0, 47), (63, 47)] {
            assert_eq!(at(&picture, x, y), [55, 188, 255, 255]);
        }
        assert_ne!(at(&picture, 32, 24), [55, 188, 255, 255]);
    }
}

/// Laid over a colour, a picture before a transparent background is the picture before that colour.
#[test]
fn transparent_backgrounds_leave_no_fringe() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let clear = draw(&gpu, &cage, [160, 120], |desc| desc.background = [0.0; 4]);
    let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
    let byte = |c: f64| c.powf(1.0 / 2.2) * 255.0;
    for behind in [0.0, 1.0] {
        let solid = draw(&gpu, &cage, [160, 120], |desc| desc.background = [behind, behind, behind, 1.0]);
        let mut edges = 0;
        for (clear, solid) in clear.pixels().zip(solid.pixels()) {
            let alpha = f64::from(clear[3]) / 255.0;
            edges += usize::from(alpha > 0.0 && alpha < 1.0);
            for c in 0..3 {
                let laid = byte(linear(clear[c]) * alpha + f64::from(behind) * (1.0 - alpha));
                assert!((laid - f64::from(solid[c])).abs() < 5.0, "{clear:?} over {behind}: {solid:?}");
            }
        }
        assert!(edges > 100, "{edges}");
    }
}

/// Where a point lies in a picture of that size, in pixels.
fn project(camera: &Camera, size: [u32; 2], p: DVec3) -> DVec2 {
    let forward = (camera.at - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let [x, y, z] = [right, right.cross(forward), forward].map(|axis| axis.dot(p - camera.eye));
    let [width, height] = size.map(f64::from);
    let scale = 0.5 * height / (camera.fovy / 2.0).tan() / z;
    DVec2::new(0.5 * width + x * scale, 0.5 * height - y * scale)
}

/// Lines lie on the edges of the triangles that transform feedback captures, and nowhere else.
#[test]
fn wireframe_lines_are_the_edges_of_triangles() {
    let gpu = gpu();
    let cage = zoo::grid(3, 2);
    let surface = Surface::new(&gpu, &cage, &SurfaceDesc::default()).unwrap();
    let size = [480, 400];
    let tessellation = Tessellation::uniform(2.0);
    let view = camera(&cage, [0.05, 1.0, 0.1], 2.6, 45.0);
    let desc = |shade| RenderDesc { shade, camera: view, tessellation, ..RenderDesc::fit(&cage, size) };
    let [plain, wire] = [Shade::Lit, Shade::Wireframe].map(|shade| draw_surfaces(&gpu, &[&surface], &desc(shade)));
    // How much darker the lines make the pixels about a point: at most 1.
    let darkened = |p: DVec3| {
        let q = project(&view, size, p);
        let near = |dx: i32, dy: i32| ((q.x as i32 + dx) as u32, (q.y as i32 + dy) as u32);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        let ratio = |(x, y)| 1.0 - luma(at(&wire, x, y)) / luma(at(&plain, x, y));
        around.map(|(dx, dy)| ratio(near(dx, dy))).fold(0.0, f64::max)
    };
    let mut captured = Vec::new();
    let keep = |vertices: &[CapturedVertex]| {
        captured.extend_from_slice(vertices);
        Ok::<(), EngineError>(())
    };
    surface.capture(&tessellation, keep).unwrap();
    let place = |i: usize| surface.space().leave(captured[i].position.into());
    let mut triangles = 0;
    for first in (0..captured.len()).step_by(3) {
        let [a, b, c] = [0, 1, 2].map(|i| place(first + i));
        // An edge of the boundary has but one triangle, so half of the ink.
        for middle in [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0] {
            assert!(darkened(middle) > 0.25, "no line at {middle}: {}", darkened(middle));
        }
        let centre = (a + b + c) / 3.0;
        assert!(darkened(centre) < 0.1, "a line at {centre}: {}", darkened(centre));
        triangles += 1;
    }
    assert!(triangles >= 4 * 6 * 8, "{triangles}");
}

fn changed(a: &Picture, b: &Picture) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// More lines at a higher level, until they would cover everything: then they fade.
#[test]
fn wireframe_lines_grow_with_the_level_and_fade_when_dense() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let lines = |level, size| {
        let [plain, wire] = [Shade::Lit, Shade::Wireframe].map(|shade| {
            let tessellation = Tessellation::uniform(level);
            draw(&gpu, &cage, size, |desc| (desc.shade, desc.tessellation) = (shade, tessellation))
        });
        let surface = plain.pixels().filter(|&pixel| pixel != at(&plain, 0, 0)).count();
        let dark = wire.pixels().zip(plain.pixels()).filter(|&(wire, plain)| luma(wire) < 0.7 * luma(plain)).count();
        dark as f64 / surface as f64
    };
    let [coarse, fine] = [1.0, 3.0].map(|level| lines(level, [480, 400]));
    assert!(coarse > 0.02 && fine > 1.5 * coarse, "{coarse} {fine}");
    let dense = lines(32.0, [96, 80]);
    assert!(dense < 0.01, "{dense}");
}

/// Where triangles are so small that no line is left, what remains is the lit surface.
#[test]
fn the_surface_under_a_wireframe_is_lit() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    for evaluator in [Evaluator::Tessellator, Evaluator::Compute] {
        let [lit, wire] = [Shade::Lit, Shade::Wireframe].map(|shade| {
            let tessellation = Tessellation { evaluator, ..Tessellation::uniform(40.0) };
            draw(&gpu, &cage, [48, 40], |desc| (desc.shade, desc.tessellation) = (shade, tessellation))
        });
        assert!(changed(&lit, &draw(&gpu, &cage, [48, 40], |desc| desc.shade = Shade::Normals)) > 200);
        // Blending with nothing rounds.
        let differs = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1);
        let pairs: Vec<([u8; 4], [u8; 4])> = lit.pixels().zip(wire.pixels()).collect();
        assert_eq!(pairs.iter().filter(|(a, b)| differs((a, b))).count(), 0, "{evaluator:?}");
    }
}

#[test]
fn the_cage_is_drawn_in_its_colour_and_changes_nothing_else() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let [plain, overlaid] = [false, true].map(|shown| draw(&gpu, &cage, [256, 256], |desc| desc.cage = shown));
    let orange = |[r, g, b, _]: [u8; 4]| r > 220 && (100..170).contains(&g) && b < 90;
    assert_eq!(plain.pixels().filter(|&pixel| orange(pixel)).count(), 0);
    assert!(overlaid.pixels().filter(|&pixel| orange(pixel)).count() > 300);
    let all = 256 * 256;
    assert!((all / 100..all / 6).contains(&changed(&plain, &overlaid)), "{}", changed(&plain, &overlaid));
}

#[test]
fn the_same_picture_has_the_same_bits() {
    let gpu = gpu();
    let cage = zoo::shipped("shell");
    for &shade in Shade::ALL {
        let [a, b] = [0, 1].map(|_| draw(&gpu, &cage, [160, 128], |desc| (desc.shade, desc.cage) = (shade, true)));
        assert_eq!(changed(&a, &b), 0, "{shade:?}");
    }
}

/// Seen from twice as far a cage of twice the size is the same picture, curvature colours included.
#[test]
fn the_size_of_a_cage_does_not_matter() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    for shade in [Shade::Lit, Shade::Curvature, Shade::Wireframe] {
        let picture = |cage: &Cage| draw(&gpu, cage, [128, 128], |desc| (desc.shade, desc.samples) = (shade, 1));
        let expected = picture(&cage);
        for scale in [1e-6, 0.7, 1.3, 1e6] {
            let scaled = picture(&zoo::moved(&cage, scale, DVec3::ZERO));
            let far = |(a, b): &([u8; 4], [u8; 4])| (0..3).any(|c| a[c].abs_diff(b[c]) > 3);
            let different = expected.pixels().zip(scaled.pixels()).filter(far).count();
            assert!(different < 128 * 128 / 200, "{shade:?} x {scale}: {different}");
        }
    }
}

/// All points in one place: no surface is seen, and nothing goes wrong.
#[test]
fn a_cage_without_extent_shows_the_background() {
    let gpu = gpu();
    let cage = zoo::moved(&zoo::shipped("ngon"), 0.0, DVec3::splat(3.0));
    for &shade in Shade::ALL {
        let picture = draw(&gpu, &cage, [64, 64], |desc| {
            (desc.shade, desc.cage, desc.background) = (shade, true, MAGENTA);
        });
        assert!(picture.pixels().all(|pixel| pixel == MAGENTA_BYTES), "{shade:?}");
    }
}

#[test]
fn pictures_of_impossible_sizes_are_refused() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    let surface = Surface::new(&gpu, &cage, &SurfaceDesc::default()).unwrap();
    let refusal = |size, samples| {
        let desc = RenderDesc { samples, ..RenderDesc::fit(&cage, size) };
        render(&gpu, &[&surface], &desc).map(drop).unwrap_err()
    };
    for size in [[0, 4], [4, 0], [0, 0]] {
        let error = refusal(size, 4);
        assert!(error.to_string().contains("at least one pixel"), "{error}");
    }
    let huge = refusal([u32::MAX, 4], 1);
    assert!(matches!(huge, EngineError::Gpu(GpuError::Limit { .. })), "{huge}");
    assert!(huge.to_string().contains("limit"), "{huge}");
    let many = refusal([4, 4], 3);
    assert!(matches!(many, EngineError::Unsupported { .. }), "{many}");
    let smallest = render(&gpu, &[&surface], &RenderDesc::fit(&cage, [1, 1])).unwrap();
    assert_eq!(smallest.rgba.len(), 4);
}
