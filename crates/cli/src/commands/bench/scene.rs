//! What is measured: a surface, drawn frame after frame.

use super::matrix::{Configuration, Group};
use super::report::{Bytes, Row, Work};
use super::summary::{Ratio, Summary};
use super::timing::{Stage, Times, interleave};
use super::{Job, report};
use crate::failure::Failure;
use crate::input::Input;
use crate::postponement::Interruption;
use crate::progress::Progress;
use glam::DVec3;
use osculate::gpu::{Measure, PassStatistics, Prepared, Recording};
use osculate::{
    Camera, Drawing, DrawingDesc, Engine, EngineError, Evaluator, Refinement, Shade, Surface, Target, Targets,
};
use osculate_cage::Cage;
use std::time::Instant;

/// Behind the surface, the grey of other renderers' pictures.
const BACKGROUND: [f32; 4] = [0.1, 0.1, 0.1, 1.0];

/// Frames with timestamps in each turn: they separate passes, which costs some drivers time, so that they do not count.
const FRAMES_WITH_TIMESTAMPS: usize = 2;

/// A surface with a prepared frame.
struct Scene {
    surface: Surface,
    drawing: Drawing,
    frame: Prepared,
    /// The same with timestamps.
    stamped: Prepared,
    /// The cage's points in the frames to come, over and over; none if it rests.
    motion: Vec<Vec<DVec3>>,
    triangles: Option<u64>,
    statistics: Option<PassStatistics>,
    first_frame: f64,
    pipelines: usize,
    gpu_seconds: Vec<f64>,
}

impl Scene {
    /// Makes a scene and draws its first frame. Of a `limit` nothing but the drawing of vertices that stay is in the frames.
    fn new(
        engine: &Engine,
        input: &Input,
        configuration: &Configuration,
        targets: &Targets,
        limit: bool,
    ) -> Result<Self, EngineError> {
        let known = engine.pipeline_names().len();
        let start = Instant::now();
        let desc = configuration.surface(input.boundary);
        let surface = Surface::new(engine, &input.cage, &desc)?;
        let desc = DrawingDesc {
            tessellation: configuration.tessellation(),
            shade: Shade::Peer,
            cage: false,
            target: targets.target(),
            culling: configuration.culling.into(),
            camera: Camera::fit(input.cage.bounds()),
            size: configuration.size,
        };
        let drawing = Drawing::new(&surface, &desc)?;
        // What rests is evaluated once.
        let mut evaluation = Recording::new();
        drawing.record(&mut evaluation);
        engine.device().run(&evaluation)?;
        let moves = configuration.animated && !limit;
        let recording = |measure| -> Result<Recording, EngineError> {
            let mut recording = Recording::new();
            recording.measure(measure);
            if moves {
                drawing.record_update(&mut recording)?;
            }
            recording.render(targets.pass(drawing.draws().to_vec(), Some(BACKGROUND)));
            Ok(recording)
        };
        let mut frame = engine.device().prepare(&recording(Measure::default())?)?;
        frame.run()?;
        let first_frame = start.elapsed().as_secs_f64();
        let stamped = engine.device().prepare(&recording(Measure { timings: true, statistics: false })?)?;
        let counted = engine.device().run(&recording(Measure { timings: false, statistics: true })?)?;
        let statistics = counted.statistics.first().map(|(_, statistics)| *statistics);
        Ok(Self {
            triangles: drawing.grid_counts().map(|[t, _]| t).or(statistics.map(|s| s.clipping_invocations)),
            motion: if moves { motion(&input.cage) } else { Vec::new() },
            pipelines: engine.pipeline_names().len() - known,
            gpu_seconds: Vec::new(),
            surface,
            drawing,
            frame,
            stamped,
            statistics,
            first_frame,
        })
    }

    /// Draws a frame; the seconds from handing over its points, if they move, to the end of the work.
    fn draw(&mut self, number: u32) -> Result<f64, EngineError> {
        let start = Instant::now();
        self.move_points(number)?;
        self.frame.run()?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// Draws frames with timestamps.
    fn stamp(&mut self) -> Result<(), EngineError> {
        for number in 0..FRAMES_WITH_TIMESTAMPS {
            self.move_points(number as u32)?;
            let report = self.stamped.run()?;
            let nanoseconds: u64 = report.timings.iter().map(|(_, time)| time).sum();
            if nanoseconds > 0 {
                self.gpu_seconds.push(1e-9 * nanoseconds as f64);
            }
        }
        Ok(())
    }

    fn move_points(&self, number: u32) -> Result<(), EngineError> {
        match self.motion.len() {
            0 => Ok(()),
            count => self.surface.write_points(&self.motion[number as usize % count]),
        }
    }
}

/// Most bytes of points that are computed beforehand.
const MOTION_BYTES: usize = 256 << 20;

/// Where the points of a cage are in frames 0, 1, ..: a wave runs through it. A whole period of 63 frames, unless the cage is
/// too large.
fn motion(cage: &Cage) -> Vec<Vec<DVec3>> {
    let radius = cage.bounds().half_diagonal();
    let wave = |frame: usize, p: DVec3| p * (1.0 + 0.05 * (0.1 * frame as f64 + 4.0 * p.y / radius).sin());
    let frames = (MOTION_BYTES / (24 * cage.positions().len())).clamp(2, 63);
    (0..frames).map(|frame| cage.positions().iter().map(|&p| wave(frame, p)).collect()).collect()
}

/// Measures a group: the scenes of its configurations and, if asked for, of their limits.
pub(super) fn measure(
    engine: &Engine,
    group: &Group,
    input: &Input,
    job: &Job,
    progress: &Progress,
    interruption: &Interruption,
) -> Result<Vec<Row>, Failure> {
    let first = &group.configurations[0];
    let targets = Targets::new(engine, first.size, Target::of(Shade::Peer, first.samples))?;
    let scene = |configuration: &Configuration, limit| {
        Scene::new(engine, input, configuration, &targets, limit).map_err(|error| refuse(job, group, error))
    };
    let count = group.configurations.len();
    let mut scenes = group.configurations.iter().map(|one| scene(one, false)).collect::<Result<Vec<_>, _>>()?;
    // Both evaluators of a surface have the same limit: the triangles of the compute evaluator.
    let mut limit_of: Vec<Option<usize>> = vec![None; count];
    for (index, one) in group.configurations.iter().enumerate().filter(|_| job.limit) {
        let known = (0..index).find(|&other| group.configurations[other].is_of_surface(one));
        if let Some(other) = known {
            limit_of[index] = limit_of[other];
            continue;
        }
        limit_of[index] = Some(scenes.len());
        scenes.push(scene(&Configuration { evaluator: Evaluator::Compute, ..*one }, true)?);
    }
    let mut stage = Scenes { scenes, counted: count, progress };
    let times = interleave(&job.timing, stage.scenes.len(), interruption, &mut stage)?;
    let named = Named { engine, input, cage: &job.cages[group.cage].name() };
    let row = |index: usize| {
        let limit = limit_of[index].map(|limit| &times[limit]);
        named.row(&group.configurations[index], &stage.scenes[index], &times[index], limit, &times[0])
    };
    // Without a whole round there is nothing to tell.
    Ok((0..count).filter_map(row).collect())
}

/// The scenes of a group: those of its configurations, then their limits.
struct Scenes<'a> {
    scenes: Vec<Scene>,
    /// How many are configurations, whose turns count as progress.
    counted: usize,
    progress: &'a Progress,
}

impl Stage for Scenes<'_> {
    fn draw(&mut self, scene: usize, number: u32) -> Result<f64, Failure> {
        Ok(self.scenes[scene].draw(number)?)
    }

    fn end_turn(&mut self, scene: usize) -> Result<(), Failure> {
        if scene < self.counted {
            self.progress.advance(1);
        }
        Ok(self.scenes[scene].stamp()?)
    }
}

fn refuse(job: &Job, group: &Group, error: EngineError) -> Failure {
    match error {
        EngineError::Plan(error) => Failure::input(format_args!("{}: {error}", job.cages[group.cage].name()))
            .with_hint("inspect says what the cage is made of"),
        EngineError::TooLarge { .. } => Failure::input(format_args!("{}: {error}", job.cages[group.cage].name()))
            .with_hint(
                "frames are timed of cages that are on the device as a whole; render, check and export work in parts",
            ),
        other => other.into(),
    }
}

/// What rows of a group have in common.
struct Named<'a> {
    engine: &'a Engine,
    input: &'a Input,
    cage: &'a str,
}

impl Named<'_> {
    fn row(
        &self,
        configuration: &Configuration,
        scene: &Scene,
        times: &Times,
        limit: Option<&Times>,
        first: &Times,
    ) -> Option<Row> {
        let plan = scene.surface.plan();
        let load = scene.frame.workload();
        let memory = self.engine.device().memory_use();
        let statistics = scene.statistics.as_ref();
        Some(Row {
            origin: report::Origin::new(self.engine),
            cage: self.cage.to_owned(),
            faces: self.input.cage.face_count(),
            scheme: configuration.scheme.name().to_owned(),
            refine: Refinement::from(configuration.refine).name().to_owned(),
            level: configuration.level,
            evaluator: super::matrix::evaluator_name(configuration.evaluator).to_owned(),
            animated: configuration.animated,
            culling: configuration.culling.name().to_owned(),
            size: format!("{}x{}", configuration.size[0], configuration.size[1]),
            samples: configuration.samples,
            steps: plan.steps(),
            patches: plan.patches.len(),
            triangles: scene.triangles,
            vertices: scene.drawing.grid_counts().map(|[_, vertices]| vertices),
            work: Work {
                vertex_invocations: statistics.map(|s| s.vertex_invocations),
                evaluation_invocations: statistics.map(|s| s.evaluation_invocations),
                fragment_invocations: statistics.map(|s| s.fragment_invocations),
                draws: load.draws,
                dispatches: load.dispatches,
                barriers: load.barriers,
                bytes_uploaded: load.bytes_copied,
            },
            bytes: Bytes { surface: scene.surface.bytes(), drawing: scene.drawing.bytes(), device: memory.live_bytes },
            pipelines: scene.pipelines,
            first_frame_ms: 1e3 * scene.first_frame,
            frames: times.frames.len(),
            frame_ms: Summary::of(&times.frames)?,
            gpu_ms: Summary::of(&scene.gpu_seconds),
            rounds_ms: times.rounds.iter().map(|time| 1e3 * time).collect(),
            to_first: Ratio::of(&times.rounds, &first.rounds)?,
            limit_ms: limit.and_then(|limit| Summary::of(&limit.frames)),
            to_limit: limit.and_then(|limit| Ratio::of(&times.rounds, &limit.rounds)),
        })
    }
}
