//! No pixel of the background inside the outline of a closed surface: what a crack looks like, whatever the proof by keys says.

use glam::DVec3;
use osculate::{Cage, Camera, Evaluator, Factors, RenderDesc, Scheme, Spacing, Tessellation};
use osculate_compare::Picture;
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::{camera, draw, draw_surfaces};
use osculate_tests::{gpu, gpu_with_shaders, stars, surface_of, zoo};

const MAGENTA: [f32; 4] = [1.0, 0.0, 1.0, 1.0];
const MAGENTA_BYTES: [u8; 4] = [255, 0, 255, 255];

/// Pixels of the background that no path over such pixels joins to the border.
fn leaks(picture: &Picture) -> usize {
    let (width, height) = (picture.size().width as usize, picture.size().height as usize);
    let mut open: Vec<bool> = picture.pixels().map(|pixel| pixel == MAGENTA_BYTES).collect();
    let border = |i: usize| [0, width - 1].contains(&(i % width)) || i < width || i >= width * (height - 1);
    let mut stack: Vec<usize> = (0..open.len()).filter(|&i| border(i)).collect();
    while let Some(i) = stack.pop() {
        if !std::mem::replace(&mut open[i], false) {
            continue;
        }
        let (x, y) = (i % width, i / width);
        let across = [(x > 0, i.wrapping_sub(1)), (x + 1 < width, i + 1)];
        let along = [(y > 0, i.wrapping_sub(width)), (y + 1 < height, i + width)];
        stack.extend(across.into_iter().chain(along).filter(|&(inside, _)| inside).map(|(_, next)| next));
    }
    open.into_iter().filter(|&left| left).count()
}

#[test]
fn the_fill_finds_a_pixel_that_is_cut_off() {
    let around = [0, 0, 0, 255];
    let mut pixels = [MAGENTA_BYTES; 25];
    for i in [6, 7, 8, 11, 13, 16, 17, 18] {
        pixels[i] = around;
    }
    assert_eq!(leaks(&Picture::new(5, 5, pixels.concat()).unwrap()), 1);
    pixels[12] = around;
    assert_eq!(leaks(&Picture::new(5, 5, pixels.concat()).unwrap()), 0);
}

const DIRECTIONS: [[f64; 3]; 4] = [[1.0, 0.75, 1.5], [-0.3, -1.0, 0.2], [-1.0, 0.1, 0.05], [0.0, 0.9, 0.7]];

const EVALUATORS: [Evaluator; 2] = [Evaluator::Tessellator, Evaluator::Compute];

/// Uniform and adaptive factors, of every spacing; patches that the adaptive ones are chosen for have many different ones.
fn tessellations(cage: &Cage) -> [Tessellation; 4] {
    let adaptive = |pixels, direction, spacing| {
        let factors = Factors::Adaptive { pixels, camera: camera(cage, direction, 1.2, 60.0), height: 192 };
        Tessellation { factors, spacing, ..Tessellation::default() }
    };
    [
        Tessellation::uniform(1.0),
        adaptive(10.0, DIRECTIONS[0], Spacing::Odd),
        Tessellation::uniform(7.0),
        adaptive(16.0, DIRECTIONS[3], Spacing::Even),
    ]
}

/// What is seen of a cage from a direction. Behind its middle all is cut away: else a crack in front would show the inside of the far side.
fn near_half(cage: &Cage, direction: [f64; 3], tessellation: Tessellation) -> RenderDesc {
    let mut camera = camera(cage, direction, 2.0, 40.0);
    camera.far = (cage.bounds().center() - camera.eye).length();
    RenderDesc { camera, tessellation, samples: 1, background: MAGENTA, ..RenderDesc::fit(cage, [192, 192]) }
}

/// Closed cages without holes cover the middle of the picture without a gap.
#[test]
fn closed_surfaces_do_not_leak() {
    let gpu = gpu();
    let made = [("trapezohedron", stars::trapezohedron(7)), ("pole", zoo::pole(24)), ("pillow", zoo::pillow())];
    let shipped = ["cube", "ngon"].map(|name| (name, zoo::shipped(name)));
    for (name, cage) in shipped.into_iter().chain(made) {
        let tessellations = tessellations(&cage);
        for &scheme in Scheme::ALL {
            let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
            for (i, direction) in DIRECTIONS.into_iter().enumerate() {
                for (j, evaluator) in EVALUATORS.into_iter().enumerate() {
                    let tessellation = Tessellation { evaluator, ..tessellations[(i + j) % 4] };
                    let picture = draw_surfaces(&gpu, &[&surface], &near_half(&cage, direction, tessellation));
                    let outside = picture.pixels().filter(|&pixel| pixel == MAGENTA_BYTES).count();
                    assert!((1_000..34_000).contains(&outside), "{name}, {scheme}: {outside} pixels outside");
                    assert_eq!(leaks(&picture), 0, "{name}, {scheme} from {direction:?}, {tessellation:?}");
                }
            }
        }
    }
}

/// From a point in the dragon's chest all around is surface.
#[test]
fn from_inside_nothing_of_the_background_is_seen() {
    let gpu = gpu();
    let cage = zoo::shipped("dragon");
    let eye = cage.bounds().center() + DVec3::new(0.0, -0.05, 0.1) * cage.bounds().half_diagonal();
    let towards = [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::new(0.1, 1.0, 0.3)];
    for &scheme in Scheme::ALL {
        let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
        for (i, towards) in towards.into_iter().enumerate() {
            let up = DVec3::new(0.2, 0.5, 0.1);
            let mut camera = Camera::look_at(eye, eye + towards, up, 1.4, cage.bounds()).unwrap();
            camera.near = 1e-3 * cage.bounds().half_diagonal();
            let tessellation = Tessellation {
                evaluator: EVALUATORS[i % 2],
                ..[Tessellation::default(), tessellations(&cage)[1]][i / 2]
            };
            let desc = RenderDesc { camera, tessellation, ..near_half(&cage, DIRECTIONS[0], tessellation) };
            let picture = draw_surfaces(&gpu, &[&surface], &desc);
            let seen = picture.pixels().filter(|&pixel| pixel == MAGENTA_BYTES).count();
            assert_eq!(seen, 0, "{scheme} towards {towards}, {tessellation:?}");
        }
    }
}

/// Patches moved along their normals, some further than others, leave gaps along their edges. Grids share vertices, so it takes lost ones to open them.
#[test]
fn a_gap_is_a_leak() {
    let stages = [
        (
            Evaluator::Tessellator,
            "include/evaluation_stage.glsl",
            "gl_Position = clip_position(point.position);",
            "gl_Position = clip_position(point.position + 0.02 * float(patch_id % 3u) * point.normal);",
        ),
        (
            Evaluator::Compute,
            "shade/grid.vert",
            "gl_Position = clip_position(in_position);",
            "gl_Position = gl_VertexIndex % 7 == 0 ? vec4(0.0) : clip_position(in_position);",
        ),
    ];
    let cage = zoo::shipped("triangles");
    for (evaluator, path, from, to) in stages {
        let gpu = gpu_with_shaders(mutated(&[Mutation { path, from, to }]));
        let tessellation = Tessellation { evaluator, ..Tessellation::default() };
        let picture = draw(&gpu, &cage, [192, 192], |desc| *desc = near_half(&cage, DIRECTIONS[0], tessellation));
        assert!(leaks(&picture) > 0, "{evaluator:?}");
    }
}
