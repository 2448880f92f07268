//! Patches that are left out before they are tessellated: what is seen stays the same, bit for bit, and there is less to draw.

use osculate::gpu::{Measure, Recording};
use osculate::{
    Cage, Camera, Culling, Drawing, DrawingDesc, Engine, Factors, RenderDesc, Scheme, Shade, Surface, Target, Targets,
    Tessellation, render,
};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::camera;
use osculate_tests::{gpu, gpu_with_shaders, stars, surface_of, zoo};

const SIZE: [u32; 2] = [96, 72];

/// Near, far, past a side, from the inside, and so far away that patches are smaller than pixels.
fn views(cage: &Cage) -> [(&'static str, Camera); 5] {
    let fit = |direction, distance, fovy| camera(cage, direction, distance, fovy);
    let beside = |camera: Camera| Camera { at: camera.at + (camera.at - camera.eye).cross(camera.up) * 0.35, ..camera };
    let radius = cage.bounds().half_diagonal();
    let inside = Camera { near: 1e-3 * radius, ..fit([0.3, 0.2, 1.0], 0.3, 80.0) };
    [
        ("near", fit([1.0, 0.4, 0.6], 1.1, 25.0)),
        ("whole", fit([-0.3, 0.8, 0.9], 2.5, 50.0)),
        ("beside", beside(fit([0.2, -0.7, 0.9], 1.5, 40.0))),
        ("inside", inside),
        ("far", fit([0.5, 0.5, 1.0], 60.0, 50.0)),
    ]
}

/// The picture of a surface, and how many triangles were drawn for it.
fn drawn(engine: &Engine, surface: &Surface, desc: &RenderDesc) -> (Vec<u8>, u64) {
    let &RenderDesc { tessellation, shade, cage, camera, size, samples, culling, .. } = desc;
    let target = Target::of(shade, samples);
    let drawing = DrawingDesc { tessellation, shade, cage, target, camera, size, culling };
    let drawing = Drawing::new(surface, &drawing).unwrap();
    let targets = Targets::new(engine, size, target).unwrap();
    let mut recording = Recording::new();
    recording.measure(Measure { timings: false, statistics: true });
    recording.render(targets.pass(drawing.draws().to_vec(), Some(desc.background)));
    let report = engine.device().run(&recording).unwrap();
    let triangles = report.statistics[0].1.clipping_invocations;
    (targets.read(engine, Recording::new()).unwrap(), triangles)
}

/// Closed cages, with schemes whose patches they have: regular ones, those of every form, from lists and stored.
fn closed() -> [(&'static str, Cage, &'static [Scheme]); 4] {
    [
        ("torus", zoo::shipped("torus"), &[Scheme::Gregory2]),
        ("twohole", zoo::shipped("twohole"), &[Scheme::Gregory2, Scheme::Biseptic]),
        ("triangles", zoo::shipped("triangles"), &[Scheme::Gregory1]),
        ("trapezohedron", stars::trapezohedron(13), &[Scheme::Stam, Scheme::Gregory2]),
    ]
}

/// Pixels in which pictures differ.
fn differing(a: &[u8], b: &[u8]) -> usize {
    a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0).filter(|(a, b)| a != b).count()
}

/// Most pixels of a picture in which a back is seen at an outline, where triangles that show their fronts and their backs have the same depth but for roundings.
const SEEN_BACKS: usize = 4;

#[test]
fn pictures_stay_the_same_and_take_fewer_triangles() {
    let gpu = gpu();
    let mut saved = [0, 0];
    for (name, cage, schemes) in closed() {
        for &scheme in schemes {
            let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
            for (i, (view, camera)) in views(&cage).into_iter().enumerate() {
                let samples = [1, 4][i % 2];
                let fit = RenderDesc { camera, samples, ..RenderDesc::fit(&cage, SIZE) };
                let desc = RenderDesc { tessellation: Tessellation::uniform(2.0), ..fit };
                let (whole, all) = drawn(&gpu, &surface, &desc);
                let (found, unseen) = drawn(&gpu, &surface, &RenderDesc { culling: Culling::UNSEEN, ..desc });
                assert!(found == whole, "{name}, {scheme}, {view}: culling changes the picture");
                assert!(unseen <= all, "{name}, {scheme}, {view}: {unseen} of {all}");
                let some = ["beside", "inside", "far"].contains(&view);
                assert!(unseen < all || !some || name != "twohole", "{scheme}, {view}: nothing is left out");
                if view != "inside" {
                    let (found, front) = drawn(&gpu, &surface, &RenderDesc { culling: Culling::ALL, ..desc });
                    let backs = differing(&found, &whole);
                    assert!(backs <= SEEN_BACKS, "{name}, {scheme}, {view}: {backs} pixels of backs are seen");
                    if name == "torus" {
                        saved = [saved[0] + unseen, saved[1] + front];
                    }
                }
            }
        }
    }
    // Half of a torus shows its back; from near, cones of patches are too wide to tell of many.
    assert!(saved[1] * 10 < saved[0] * 9, "backs are a part of {saved:?} triangles");
}

/// `render` culls as drawings do, and lines stay where triangles are left out.
#[test]
fn every_shade_stays_the_same() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let surface = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
    let [(_, near), .., (_, far)] = views(&cage);
    for camera in [near, far] {
        for &shade in Shade::ALL {
            let factors = Factors::Adaptive { pixels: 5.0, camera, height: SIZE[1] };
            let tessellation = Tessellation { factors, ..Tessellation::default() };
            let desc = RenderDesc { camera, shade, tessellation, cage: true, ..RenderDesc::fit(&cage, SIZE) };
            let [all, seen] = [Culling::NONE, Culling::UNSEEN]
                .map(|culling| render(&gpu, &[&surface], &RenderDesc { culling, ..desc }).unwrap());
            assert!(all == seen, "{shade:?}");
        }
    }
}

/// The comparison of pictures notices tests that leave out too much.
#[test]
fn tests_that_leave_out_too_much_are_noticed() {
    let mistakes = [
        (
            "include/culling.glsl",
            "any(lessThan(side, vec4(0.0)))",
            "any(lessThan(extent.side_low, vec4(0.0)))",
            Culling::UNSEEN,
        ),
        (
            "include/culling.glsl",
            "float offset = frame.cull_samples > 1.0 ? 0.0 : 0.5;",
            "float offset = 0.25;",
            Culling::UNSEEN,
        ),
        ("include/normal_cone.glsl", "distance * sin(angle)", "-0.5 * distance", Culling::ALL),
    ];
    let cage = zoo::shipped("twohole");
    for (path, from, to, culling) in mistakes {
        let tolerated = if culling.back { SEEN_BACKS } else { 0 };
        let gpu = gpu_with_shaders(mutated(&[Mutation { path, from, to }]));
        let surface = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
        let differs = views(&cage).into_iter().filter(|(view, _)| *view != "inside").any(|(_, camera)| {
            let tessellation = Tessellation::uniform(2.0);
            let desc = RenderDesc { camera, tessellation, samples: 1, ..RenderDesc::fit(&cage, SIZE) };
            let [all, seen] = [Culling::NONE, culling]
                .map(|culling| render(&gpu, &[&surface], &RenderDesc { culling, ..desc }).unwrap());
            differing(&all.rgba, &seen.rgba) > tolerated
        });
        assert!(differs, "{from} as {to} goes unnoticed");
    }
}
