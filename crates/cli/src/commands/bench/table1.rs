//! Table 1 of Loop, *Hardware Subdivision and Tessellation of Catmull-Clark Surfaces*, MSR-TR-2010-163: what the subdivision
//! stage of a frame costs. The report takes the difference of frames with subdivision and without; here the passes are timed
//! too, and what makes records, which the report does not have, stands apart.

use super::Job;
use super::report::Origin;
use super::summary::{Summary, median};
use super::timing::{Stage, interleave};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::input::Input;
use crate::postponement::Interruption;
use crate::progress::Progress;
use osculate::gpu::{Device, Measure, Prepared, Recording};
use osculate::{
    Camera, Culling, Drawing, DrawingDesc, Engine, EngineError, Refinement, Shade, Surface, Target, Targets,
};
use serde::Serialize;
use std::fmt;
use std::time::Instant;

/// The subdivision stage of one cage.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Table {
    table: u32,
    cage: String,
    faces: usize,
    scheme: String,
    refine: &'static str,
    steps: u32,
    level: f32,
    /// Frames with an update of the surface and frames without.
    with_ms: Summary,
    without_ms: Summary,
    /// Median of the rounds' differences: the report's method.
    difference_ms: f64,
    /// The whole update in a submission of its own.
    update_ms: Summary,
    /// Sums over passes of their medians, each pass in a submission of its own; less what an empty submission takes.
    copy_ms: f64,
    subdivide_ms: f64,
    records_ms: f64,
    passes: Vec<Pass>,
    #[serde(flatten)]
    origin: Origin,
}

/// A pass of the update.
#[derive(Clone, Debug, Serialize)]
struct Pass {
    name: String,
    ms: Summary,
}

/// What is timed of one cage.
struct Update {
    /// With the update, without, the update alone, nothing, then pass by pass.
    submissions: Vec<Prepared>,
    names: Vec<String>,
}

const WITH: usize = 0;
const WITHOUT: usize = 1;
const ALONE: usize = 2;
const NOTHING: usize = 3;
const FIRST_PASS: usize = 4;

/// Measures every cage by the first scheme, level and way to refine.
pub(super) fn measure(
    engine: &Engine,
    job: &Job,
    inputs: &[Input],
    global: &GlobalArgs,
    interruption: &Interruption,
) -> Result<Vec<Table>, Failure> {
    let progress = Progress::new(global.quiet, inputs.len() as u64, "measuring");
    let mut tables = Vec::new();
    for (cage, input) in job.cages.iter().zip(inputs) {
        if interruption.is_requested() {
            break;
        }
        let configuration = &job.groups[0].configurations[0];
        let desc = configuration.surface(input.boundary);
        let surface = Surface::new(engine, &input.cage, &desc)?;
        let targets = Targets::new(engine, configuration.size, Target::of(Shade::Peer, configuration.samples))?;
        let desc = DrawingDesc {
            tessellation: configuration.tessellation(),
            shade: Shade::Peer,
            cage: false,
            target: targets.target(),
            culling: Culling::NONE,
            camera: Camera::fit(input.cage.bounds()),
            size: configuration.size,
        };
        let drawing = Drawing::new(&surface, &desc)?;
        let mut update = Update::new(engine.device(), &surface, &drawing, &targets)?;
        let times = interleave(&job.timing, update.submissions.len(), interruption, &mut update)?;
        let Some(with_ms) = Summary::of(&times[WITH].frames) else { break };
        let pair = |a: usize, b: usize| times[a].rounds.iter().zip(&times[b].rounds).map(|(a, b)| 1e3 * (a - b));
        let summary = |index: usize| Summary::of(&times[index].frames).unwrap_or(with_ms);
        let beyond = |index: usize| median(pair(index, NOTHING)).unwrap_or_default().max(0.0);
        let sum = |start: &str| -> f64 {
            let of_kind = |(_, name): &(usize, &String)| name.starts_with(start);
            (FIRST_PASS..).zip(&update.names).filter(of_kind).map(|(index, _)| beyond(index)).sum()
        };
        tables.push(Table {
            table: 1,
            cage: cage.name(),
            faces: input.cage.face_count(),
            scheme: configuration.scheme.name().to_owned(),
            refine: Refinement::from(configuration.refine).name(),
            steps: surface.plan().steps(),
            level: configuration.level,
            with_ms,
            without_ms: summary(WITHOUT),
            difference_ms: median(pair(WITH, WITHOUT)).unwrap_or_default(),
            update_ms: summary(ALONE),
            copy_ms: sum("copy"),
            subdivide_ms: sum("subdivide/"),
            records_ms: sum("records/"),
            passes: (FIRST_PASS..)
                .zip(&update.names)
                .map(|(index, name)| Pass { name: name.clone(), ms: summary(index) })
                .collect(),
            origin: Origin::new(engine),
        });
        progress.advance(1);
    }
    Ok(tables)
}

impl Update {
    fn new(device: &Device, surface: &Surface, drawing: &Drawing, targets: &Targets) -> Result<Self, EngineError> {
        let mut alone = Recording::new();
        surface.record_update(&mut alone)?;
        let mut without = Recording::new();
        without.render(targets.pass(drawing.draws().to_vec(), Some([0.1, 0.1, 0.1, 1.0])));
        let mut with = alone.clone();
        with.append(&without);
        let mut named = alone.clone();
        named.measure(Measure { timings: true, statistics: false });
        let names = device.run(&named)?.timings.into_iter().map(|(name, _)| name).collect();
        let all = [with, without, alone.clone(), Recording::new()].into_iter().chain(alone.split());
        let submissions = all.map(|recording| device.prepare(&recording)).collect::<Result<_, _>>()?;
        Ok(Self { submissions, names })
    }
}

impl Stage for Update {
    fn draw(&mut self, scene: usize, _: u32) -> Result<f64, Failure> {
        let start = Instant::now();
        self.submissions[scene].run().map_err(EngineError::from)?;
        Ok(start.elapsed().as_secs_f64())
    }

    fn end_turn(&mut self, _: usize) -> Result<(), Failure> {
        Ok(())
    }
}

impl fmt::Display for Table {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cage, faces, scheme, steps, .. } = self;
        write!(
            out,
            "{cage} ({faces} faces, {steps} steps, {scheme}): difference {:.3} ms; passes: subdivision {:.3} ms, records {:.3} ms, copy {:.3} ms; \
             in one submission {:.3} ms",
            self.difference_ms, self.subdivide_ms, self.records_ms, self.copy_ms, self.update_ms.median
        )
    }
}
