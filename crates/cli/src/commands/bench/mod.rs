//! `bench`: how long frames take.

mod baseline;
mod cages;
mod figure;
mod matrix;
mod report;
mod scene;
mod summary;
mod table1;
mod timing;

use crate::args::GlobalArgs;
use crate::device::with_engine;
use crate::failure::{Failure, Verdict};
use crate::options::{CullArg, DrawEvaluator, Level, Output, RefineArg, SchemeChoice, SchemeName, Size, check_place};
use crate::postponement::Interruption;
use crate::progress::Progress;
use cages::BenchCage;
use clap::Args;
use matrix::{Configuration, Group};
use osculate::Engine;
use std::num::NonZeroU32;
use std::path::PathBuf;
use timing::Timing;

/// Measure how long frames take.
///
/// Draws every cage in every scheme, at every level, by every evaluator, and prints a JSON object per configuration. A frame is
/// the wall time from handing over its work to the fence behind it, one frame in flight, nothing read back. All configurations
/// of one cage and level are drawn in turn, round after round, so that what else the machine does befalls all of them; the
/// first frames of each round are not counted. Ctrl-C ends the measuring and keeps what has been measured.
///
/// With --json the objects go to that file and a table for people to stdout.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct BenchArgs {
    /// Control cages: files, or torus:N for a generated torus of about N quads.
    #[arg(required = true, value_name = "CAGE")]
    cages: Vec<String>,

    /// Schemes to measure. Default: gregory2, with --figure5 all.
    #[arg(long, alias = "scheme", value_name = "SCHEMES", value_delimiter = ',')]
    schemes: Vec<SchemeChoice>,

    /// Which faces of the cage are refined: one way, or both with a comma between.
    #[arg(long, value_name = "FACES", value_delimiter = ',', default_value = "everywhere")]
    refine: Vec<RefineArg>,

    /// Levels to measure: segments per patch edge. Default: 8, with --figure5 1,2,4,8,16,32.
    #[arg(long, alias = "level", value_name = "LEVELS", value_delimiter = ',', allow_hyphen_values = true)]
    levels: Vec<Level>,

    /// Evaluators to measure, with commas between. Default: tessellator,compute, with --figure5 tessellator.
    #[arg(long, alias = "evaluators", value_name = "EVALUATORS", value_delimiter = ',')]
    evaluator: Vec<DrawEvaluator>,

    /// Move all points of the cage in every frame: p (1 + 0.05 sin(0.1 frame + 4 y / r)), computed by the host beforehand and
    /// uploaded within the frame. Without it the surface rests, and so does the compute evaluator.
    #[arg(long)]
    animate: bool,

    /// Draw the same triangles from vertices that stay, too: the limit of any evaluator. Adds the ratio to it to every object.
    #[arg(long)]
    limit: bool,

    /// What to leave out, of the limit too. The picture stays the same, but for the backs.
    #[arg(long, value_name = "WHAT", value_enum, default_value = "none")]
    cull: CullArg,

    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    /// Samples per pixel.
    #[arg(long, value_name = "N", default_value = "1")]
    samples: u32,

    /// Frames that are counted, of each configuration.
    #[arg(long, value_name = "N", default_value = "60")]
    frames: NonZeroU32,

    /// Rounds that the frames are spread over.
    #[arg(long, value_name = "N", default_value = "5")]
    rounds: NonZeroU32,

    /// Stop a configuration after so many seconds, once every round had a frame.
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    max_seconds: f64,

    #[command(flatten)]
    results: ResultArgs,
}

/// What is made of the measurements.
#[derive(Args, Debug)]
#[command(next_help_heading = "Results")]
struct ResultArgs {
    /// Write a JSON object per line here, and a table to stdout.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Write a row per configuration here.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,

    /// Plot frames per second over the level, a panel per cage.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,

    /// Time the subdivision of each cage, as Table 1 of Loop's report does, in place of frames: by the difference of frames with
    /// and without it, and pass by pass. Of --schemes, --levels and --refine the first counts.
    #[arg(long, conflicts_with_all = ["animate", "limit", "plot", "figure5", "compare", "csv"])]
    table1: bool,

    /// Plot the tessellation of each cage as Figure 5 of Loop's report does: all schemes, levels 1 to 32.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "plot")]
    figure5: Option<PathBuf>,

    /// Compare with the JSON lines of an earlier run. Exit code 1 if a configuration has become slower beyond the noise: all its
    /// rounds slower than all earlier ones by more than --noise.
    #[arg(long, value_name = "OLD.json")]
    compare: Option<PathBuf>,

    /// How much slower is still noise, in percent.
    #[arg(long, value_name = "PERCENT", default_value = "10", value_parser = percent)]
    noise: f64,
}

const EXAMPLES: &str = "\
Examples:
  osculate bench twohole.obj --levels 2,8,32 --animate --limit --json now.json
  osculate bench twohole.obj --levels 2,8,32 --animate --limit --compare now.json
  osculate bench twohole.obj torus:20000 --table1
  osculate bench twohole.obj bigguy.obj --figure5 figure5.svg";

fn seconds(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&s: &f64| s.is_finite() && s > 0.0).ok_or_else(|| "expected seconds above 0".into())
}

fn percent(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&p: &f64| p.is_finite() && p >= 0.0).ok_or_else(|| "expected percents, 0 or more".into())
}

/// Measurements that can be made.
pub(crate) struct Job {
    cages: Vec<BenchCage>,
    groups: Vec<Group>,
    timing: Timing,
    limit: bool,
    table1: bool,
    json: Option<PathBuf>,
    csv: Option<PathBuf>,
    plot: Option<PathBuf>,
    compare: Option<PathBuf>,
    noise: f64,
}

impl BenchArgs {
    /// Checks names and places, so that a typo is not found after minutes of work.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        let results = self.results;
        let figure5 = results.figure5.is_some();
        let plot = results.figure5.or(results.plot).map(|file| Output::new(file, &[("svg", ())])).transpose()?;
        results.json.iter().chain(&results.csv).try_for_each(|file| check_place(file))?;
        let schemes = match (self.schemes.as_slice(), figure5) {
            ([], true) => vec![SchemeChoice::All],
            ([], false) => vec![SchemeChoice::One(SchemeName::Gregory2)],
            _ => self.schemes,
        };
        let levels = match (self.levels.as_slice(), figure5) {
            ([], true) => [1, 2, 4, 8, 16, 32].map(|level| level as f32).to_vec(),
            ([], false) => vec![8.0],
            (levels, _) => levels.iter().map(|level| level.get()).collect(),
        };
        let evaluators = match (self.evaluator.as_slice(), figure5) {
            ([], true) => vec![DrawEvaluator::Tessellator],
            ([], false) => vec![DrawEvaluator::Tessellator, DrawEvaluator::Compute],
            _ => self.evaluator,
        };
        let cages = self.cages.iter().map(|name| name.parse()).collect::<Result<Vec<BenchCage>, _>>()?;
        let template = Configuration {
            cage: 0,
            scheme: SchemeChoice::schemes(&schemes)?[0],
            refine: self.refine[0],
            level: levels[0],
            evaluator: evaluators[0].into(),
            animated: self.animate,
            culling: self.cull,
            size: [self.size.width, self.size.height],
            samples: self.samples,
        };
        let surfaces = matrix::surfaces(&SchemeChoice::schemes(&schemes)?, &self.refine);
        let groups = matrix::groups(&template, cages.len(), &surfaces, &levels, &evaluators);
        let timing = Timing { frames: self.frames.get(), rounds: self.rounds.get(), max_seconds: self.max_seconds };
        Ok(Job {
            cages,
            groups,
            timing,
            limit: self.limit,
            table1: results.table1,
            json: results.json,
            csv: results.csv,
            plot: plot.map(|output| output.path),
            compare: results.compare,
            noise: results.noise / 100.0,
        })
    }
}

/// Measures, and hands out the results.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let old = job.compare.as_deref().map(baseline::read).transpose()?;
    let inputs = job.cages.iter().map(|cage| cage.read(global)).collect::<Result<Vec<_>, _>>()?;
    let interruption = Interruption::postpone();
    if job.table1 {
        let tables =
            with_engine(global, |engine: &Engine| table1::measure(engine, job, &inputs, global, &interruption))?;
        return report::tables(job, &tables);
    }
    let rows = with_engine(global, |engine: &Engine| {
        let total: usize = job.groups.iter().map(|group| group.configurations.len()).sum();
        let progress = Progress::new(global.quiet, total as u64 * u64::from(job.timing.rounds), "measuring");
        let mut rows = Vec::new();
        for group in &job.groups {
            if interruption.is_requested() {
                break;
            }
            let input = &inputs[group.cage];
            rows.extend(scene::measure(engine, group, input, job, &progress, &interruption)?);
        }
        Ok(rows)
    })?;
    if rows.is_empty() {
        return Err(Failure::usage("interrupted before anything was measured").with_hint("let it run longer"));
    }
    report::rows(job, &rows)?;
    let Some(old) = old else { return Ok(Verdict::Pass) };
    baseline::compare(&old, &rows, job.noise)
}
