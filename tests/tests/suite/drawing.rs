//! Drawings that stay on the device: the pictures of `render`, and what a steady frame costs, by counters.

use glam::DVec3;
use osculate::gpu::{Measure, Prepared, Recording};
use osculate::{
    Cage, Camera, DrawPlan, Drawing, DrawingDesc, Engine, EngineDesc, EngineError, Evaluator, Factors, RenderDesc,
    Scheme, Shade, Spacing, Surface, Target, Targets, Tessellation, render,
};
use osculate_shaders::layout::Frame;
use osculate_tests::picture::camera;
use osculate_tests::{gpu, gpu_with, surface_of, zoo};

const SIZE: [u32; 2] = [96, 72];
const EVALUATORS: [Evaluator; 2] = [Evaluator::Tessellator, Evaluator::Compute];

fn by(evaluator: Evaluator, factors: Factors) -> Tessellation {
    Tessellation { factors, spacing: Spacing::Equal, evaluator }
}

/// A drawing that shows what a picture shows.
fn drawing_of(surface: &Surface, desc: &RenderDesc) -> Drawing {
    let &RenderDesc { tessellation, shade, cage, camera, size, samples, culling, .. } = desc;
    let target = Target::of(shade, samples);
    Drawing::new(surface, &DrawingDesc { tessellation, shade, cage, target, camera, size, culling }).unwrap()
}

/// A recording of the frames of a drawing in which the cage may have moved.
fn frame(drawing: &Drawing, targets: &Targets, background: [f32; 4]) -> Recording {
    let mut recording = Recording::new();
    drawing.surface().record_update(&mut recording).unwrap();
    drawing.record(&mut recording);
    recording.render(targets.pass(drawing.draws().to_vec(), Some(background)));
    recording
}

/// The picture of a drawing's second frame.
fn drawn(engine: &Engine, drawing: &Drawing, desc: &RenderDesc) -> Vec<u8> {
    let targets = Targets::new(engine, desc.size, drawing.desc().target).unwrap();
    let mut frame = engine.device().prepare(&frame(drawing, &targets, desc.background)).unwrap();
    frame.run().unwrap();
    frame.run().unwrap();
    targets.read(engine, Recording::new()).unwrap()
}

fn close(cage: &Cage) -> Camera {
    camera(cage, [-0.7, 0.4, 0.6], 1.6, 50.0)
}

#[test]
fn drawings_show_the_pictures_of_render_bit_for_bit() {
    let gpu = gpu();
    let cages = [("twohole", Scheme::Gregory2), ("triangles", Scheme::Gregory1)];
    for ((name, scheme), evaluator) in cages.into_iter().flat_map(|one| EVALUATORS.map(|evaluator| (one, evaluator))) {
        let cage = zoo::shipped(name);
        let surface = surface_of(&gpu, &cage, scheme, None).unwrap();
        let camera = close(&cage);
        let adaptive = Factors::Adaptive { pixels: 6.0, camera, height: SIZE[1] };
        for (shade, overlay, samples, factors) in [
            (Shade::Lit, true, 4, Factors::Uniform(3.0)),
            (Shade::Wireframe, false, 4, adaptive),
            (Shade::Patches, true, 1, Factors::Uniform(2.0)),
            (Shade::Peer, false, 1, adaptive),
        ] {
            let tessellation = by(evaluator, factors);
            let fit = RenderDesc::fit(&cage, SIZE);
            let desc = RenderDesc { camera, tessellation, shade, cage: overlay, samples, ..fit };
            let picture = render(&gpu, &[&surface], &desc).unwrap();
            let found = drawn(&gpu, &drawing_of(&surface, &desc), &desc);
            assert!(found == picture.rgba, "{name}, {shade:?} by {evaluator:?}");
        }
    }
}

/// Chunks and draws are many here.
#[test]
fn drawings_in_many_parts_show_the_same() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let parts = gpu_with(EngineDesc { patches_per_draw: Some(7), grid_vertices: Some(300), ..EngineDesc::default() });
    for evaluator in EVALUATORS {
        let tessellation = by(evaluator, Factors::Uniform(3.0));
        let desc = RenderDesc { tessellation, samples: 1, ..RenderDesc::fit(&cage, SIZE) };
        let pictures = [&*gpu, &*parts].map(|engine| {
            let surface = surface_of(engine, &cage, Scheme::default(), None).unwrap();
            drawn(engine, &drawing_of(&surface, &desc), &desc)
        });
        assert!(pictures[0] == pictures[1], "{evaluator:?}");
    }
}

/// p (1 + a sin(b y)): every point moves, differently.
fn moved(cage: &Cage, frame: u32) -> Vec<DVec3> {
    let wave = |p: DVec3| p * (1.0 + 0.05 * (0.1 * f64::from(frame) + 4.0 * p.y).sin());
    cage.positions().iter().map(|&p| wave(p)).collect()
}

/// A prepared frame of a cage at uniform level 4.
fn steady(engine: &Engine, cage: &Cage, evaluator: Evaluator) -> (Surface, Drawing, Targets, Prepared) {
    let surface = surface_of(engine, cage, Scheme::default(), None).unwrap();
    let tessellation = by(evaluator, Factors::Uniform(4.0));
    let desc = RenderDesc { tessellation, samples: 1, ..RenderDesc::fit(cage, SIZE) };
    let drawing = drawing_of(&surface, &desc);
    let targets = Targets::new(engine, SIZE, drawing.desc().target).unwrap();
    let mut recording = Recording::new();
    recording.measure(Measure { timings: false, statistics: true });
    drawing.record_update(&mut recording).unwrap();
    recording.render(targets.pass(drawing.draws().to_vec(), Some(desc.background)));
    let prepared = engine.device().prepare(&recording).unwrap();
    (surface, drawing, targets, prepared)
}

#[test]
fn a_moving_surface_is_drawn_where_it_is() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    for evaluator in EVALUATORS {
        let (surface, drawing, targets, mut frame) = steady(&gpu, &cage, evaluator);
        for number in 1..=3 {
            surface.write_points(&moved(&cage, number)).unwrap();
            frame.run().unwrap();
        }
        let found = targets.read(&gpu, Recording::new()).unwrap();
        let mut fresh = surface_of(&gpu, &cage, Scheme::default(), None).unwrap();
        fresh.set_points(&moved(&cage, 3)).unwrap();
        let &DrawingDesc { tessellation, camera, .. } = drawing.desc();
        let desc = RenderDesc { tessellation, camera, samples: 1, ..RenderDesc::fit(&cage, SIZE) };
        assert!(found == render(&gpu, &[&fresh], &desc).unwrap().rgba, "{evaluator:?}");
    }
}

/// What a frame asks of the GPU, on a device that no other test uses.
#[test]
fn a_steady_frame_allocates_nothing_and_uploads_points_alone() {
    let own = own_device();
    let cage = zoo::shipped("twohole");
    let points = 12 * cage.positions().len() as u64;
    for (evaluator, dispatches, barriers) in [(Evaluator::Tessellator, 7, 8), (Evaluator::Compute, 10, 11)] {
        let (surface, mut drawing, _targets, mut frame) = steady(&own, &cage, evaluator);
        let load = frame.workload();
        assert_eq!(load.bytes_copied, points);
        assert_eq!((load.dispatches, load.barriers), (dispatches, barriers), "{evaluator:?}");
        assert_eq!(load.draws as usize, drawing.draws().len());
        let report = frame.run().unwrap();
        let patches = surface.plan().patches.len() as u64;
        let (_, statistics) = &report.statistics[0];
        // Two triangles for each of 16 cells.
        assert_eq!(statistics.clipping_invocations, 32 * patches, "{evaluator:?}");
        match evaluator {
            Evaluator::Compute => {
                assert_eq!(drawing.grid_counts().unwrap()[0], 32 * patches);
                assert_eq!(load.draws, 1);
            }
            _ => {
                assert_eq!(statistics.control_patches, patches);
                assert_eq!(drawing.grid_counts(), None);
                // Those of a kind together, but on llvmpipe 56 at most, whose vertices stay in the cache.
                let longest = if own.device().info().is_llvmpipe { 56 } else { u32::MAX };
                let draws = surface.plan().lists.iter().map(|list| u64::from(list.drawn.div_ceil(longest)));
                assert_eq!(load.draws, draws.sum::<u64>());
            }
        }
        let (camera, before) = (drawing.desc().camera, own.device().memory_use());
        for number in 1..=5 {
            surface.write_points(&moved(&cage, number)).unwrap();
            frame.run().unwrap();
        }
        let still = own.device().memory_use();
        assert_eq!((still.made, still.live_bytes), (before.made, before.live_bytes), "{evaluator:?}");
        assert_eq!(still.host_bytes_written - before.host_bytes_written, 5 * points);
        assert_eq!(drawing.set_view(&camera, SIZE).unwrap(), DrawPlan::Kept);
        let view = own.device().memory_use();
        assert_eq!(view.host_bytes_written - still.host_bytes_written, size_of::<Frame>() as u64);
    }
    assert_eq!(own.device().validation_messages(), [""; 0]);
}

fn own_device() -> Engine {
    let desc = osculate::DeviceDesc { validation: true, ..osculate::DeviceDesc::default() };
    let select = std::env::var("OSCULATE_DEVICE").ok();
    Engine::new(osculate::Device::new(&osculate::DeviceDesc { select, ..desc }).unwrap())
}

#[test]
fn adaptive_factors_follow_the_view_unless_they_are_frozen() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    let surface = surface_of(&gpu, &cage, Scheme::default(), None).unwrap();
    let [near, far] = [1.6, 6.0].map(|distance| camera(&cage, [1.0, 0.4, 0.6], distance, 50.0));
    for evaluator in EVALUATORS {
        let tessellation = by(evaluator, Factors::Adaptive { pixels: 4.0, camera: near, height: SIZE[1] });
        let desc = RenderDesc { camera: near, tessellation, samples: 1, ..RenderDesc::fit(&cage, SIZE) };
        let mut drawing = drawing_of(&surface, &desc);
        let count = |drawing: &Drawing| drawing.grid_counts().map(|[triangles, _]| triangles);
        let (fine, anew) = (count(&drawing), |plan| evaluator == Evaluator::Tessellator || plan == DrawPlan::New);
        assert_eq!(drawing.set_view(&near, SIZE).unwrap(), DrawPlan::Kept);
        assert!(anew(drawing.set_view(&far, SIZE).unwrap()));
        assert!(fine.is_none() || count(&drawing) < fine);
        let factors = Factors::Adaptive { pixels: 4.0, camera: far, height: SIZE[1] };
        let seen = RenderDesc { camera: far, tessellation: by(evaluator, factors), ..desc };
        assert!(drawn(&gpu, &drawing, &seen) == render(&gpu, &[&surface], &seen).unwrap().rgba, "{evaluator:?}");
        drawing.freeze_factors(true);
        assert_eq!(drawing.set_view(&near, SIZE).unwrap(), DrawPlan::Kept);
        let seen = RenderDesc { camera: near, ..seen };
        assert!(drawn(&gpu, &drawing, &seen) == render(&gpu, &[&surface], &seen).unwrap().rgba, "{evaluator:?}");
        drawing.freeze_factors(false);
        assert!(anew(drawing.set_view(&near, SIZE).unwrap()));
        assert_eq!(count(&drawing), fine);
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    let surface = surface_of(&gpu, &cage, Scheme::default(), None).unwrap();
    let desc = DrawingDesc::fit(&cage, SIZE);
    let refused = |desc| Drawing::new(&surface, &desc).err();
    assert!(matches!(refused(DrawingDesc { shade: Shade::Difference, ..desc }), Some(EngineError::OneSurface)));
    let tessellation = Tessellation::uniform(65.0);
    assert!(matches!(refused(DrawingDesc { tessellation, ..desc }), Some(EngineError::Level { .. })));
    let none = Targets::new(&gpu, [0, 4], desc.target).err();
    assert!(matches!(none, Some(EngineError::Unsupported { .. })), "{none:?}");
}
