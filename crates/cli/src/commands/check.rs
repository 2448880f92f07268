//! `check`: the proof that the drawn surface has no cracks.

use crate::args::GlobalArgs;
use crate::device::with_engine;
use crate::failure::{Failure, Verdict};
use crate::input::InputArgs;
use crate::options::{
    CameraArgs, DisplaceArgs, DrawEvaluator, Level, Maps, PartsArgs, Pixels, RefineArg, SchemeChoice, SpacingArg,
};
use crate::progress::Progress;
use crate::stdout;
use clap::Args;
use osculate::{
    CheckReport, Engine, Factors, Parts, PartsProof, Scheme, SurfaceDesc, Tessellation, WholeOrParts, check,
};
use osculate_cage::{BoundaryRule, Bounds};
use serde::Serialize;

/// Prove that the drawn surface has no cracks.
///
/// Corners of triangles that lie on a common edge or vertex of patches must have the same bits in position and normal,
/// whichever patch drew them, and the triangles must close over them. Prints a line per scheme and level: triangles, then
/// what must be zero, which is open (edges without a partner), over_shared (edges with too many), split_normals (corners that
/// differ), inverted (triangles the wrong way round) and, if not zero, wrong_patches (those that the device left out, drew twice
/// or made up).
/// split_positions (corners that differ in position) stands there too if there are any. Degenerate triangles, which have two
/// corners at one parameter of the patch, are counted and allowed. After the semicolon: the same counts when vertices are
/// joined by equal positions instead of by records; for information.
///
/// Exit code 1 means that a proof failed.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    input: InputArgs,

    /// Schemes to prove.
    #[arg(long, alias = "scheme", value_name = "SCHEMES", help = SchemeChoice::help(), value_delimiter = ',', default_value = "all")]
    schemes: Vec<SchemeChoice>,

    /// Which faces of the cage are refined.
    #[arg(long, value_name = "FACES", default_value = "everywhere")]
    refine: RefineArg,

    /// Levels to prove: segments per patch edge, real numbers from 1 to 64.
    #[arg(
        long,
        alias = "level",
        value_name = "LEVELS",
        value_delimiter = ',',
        default_value = "1,5,8",
        allow_hyphen_values = true
    )]
    levels: Vec<Level>,

    /// How levels that are not integers are met.
    #[arg(long, value_name = "SPACING", default_value = "equal")]
    spacing: SpacingArg,

    /// Prove the tessellation whose edges are at most about this many pixels long in the camera's picture; --levels is ignored.
    #[arg(long, value_name = "PX", allow_negative_numbers = true)]
    adaptive: Option<Pixels>,

    /// With --adaptive: prove the tessellations of so many views, on a full turn about the up axis of the camera that comes to half
    /// its distance in the middle and back.
    #[arg(long, value_name = "VIEWS", requires = "adaptive", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    orbit: Option<u32>,

    /// Who evaluates the surface.
    #[arg(long, value_name = "EVALUATOR", default_value = "auto")]
    evaluator: DrawEvaluator,

    /// Print one JSON object per line.
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    displace: DisplaceArgs,

    #[command(flatten)]
    camera: CameraArgs,

    #[command(flatten)]
    parts: PartsArgs,
}

const EXAMPLES: &str = "\
Examples:
  osculate check cube.obj
  osculate check cube.obj --levels 1,2.5,64 --spacing odd --json
  osculate check cube.obj --adaptive 4 --camera 1,0,1:0,0,0:0,1,0:60
  osculate check cube.obj --adaptive 4 --orbit 24 --spacing odd
  osculate check unwrapped.obj --displace bricks.png:0.05";

/// Proofs that can be tried.
pub(crate) struct Job {
    input: InputArgs,
    schemes: Vec<Scheme>,
    refine: RefineArg,
    fineness: Fineness,
    spacing: SpacingArg,
    evaluator: DrawEvaluator,
    json: bool,
    displace: DisplaceArgs,
    camera: CameraArgs,
    parts: PartsArgs,
}

/// What decides the tessellation factors.
enum Fineness {
    Levels(Vec<Level>),
    Adaptive {
        pixels: Pixels,
        /// Number of views of a turn; none is the camera alone.
        orbit: Option<u32>,
    },
}

impl CheckArgs {
    /// Checks the schemes.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        Ok(Job {
            schemes: SchemeChoice::schemes(&self.schemes)?,
            refine: self.refine,
            input: self.input,
            fineness: match self.adaptive {
                Some(pixels) => Fineness::Adaptive { pixels, orbit: self.orbit },
                None => Fineness::Levels(self.levels),
            },
            spacing: self.spacing,
            evaluator: self.evaluator,
            json: self.json,
            displace: self.displace,
            camera: self.camera,
            parts: self.parts,
        })
    }
}

/// Tries the proofs and prints what came of them.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let input = job.input.read(global)?;
    let maps = job.displace.load(&input.cage)?;
    let cases = job.cases(input.cage.bounds())?;
    let progress = Progress::new(global.quiet, (job.schemes.len() * cases.len()) as u64, "proving");
    with_engine(global, |engine: &Engine| {
        let mut watertight = true;
        for &scheme in &job.schemes {
            let desc = SurfaceDesc { scheme, boundary: Some(input.boundary), refinement: job.refine.into() };
            let made = WholeOrParts::new(engine, &input.cage, &job.parts.desc(desc));
            let mut finish = |case, report: &CheckReport| {
                watertight &= report.is_watertight();
                job.print(scheme, case, report)
            };
            match made.map_err(|error| job.input.refuse(error))? {
                WholeOrParts::Whole(surface) => {
                    let surface = maps.apply(surface, &input.cage, &job.input.file)?;
                    for case in &cases {
                        finish(case, &check(&surface, &case.tessellation)?)?;
                        progress.advance(1);
                    }
                }
                WholeOrParts::Parts(parts) => {
                    let reports = job.check_parts(parts, &cases, &maps, input.boundary)?;
                    cases.iter().zip(&reports).try_for_each(|(case, report)| finish(case, report))?;
                    progress.advance(cases.len() as u64);
                }
            }
        }
        Ok(Verdict::of(watertight))
    })
}

/// A tessellation, and how it is called in the results.
struct Case {
    tessellation: Tessellation,
    key: &'static str,
    value: f32,
    /// Which view of a turn.
    view: Option<u32>,
}

impl Job {
    /// Proves all cases of each part while it is on the device.
    fn check_parts(
        &self,
        mut parts: Parts<'_>,
        cases: &[Case],
        maps: &Maps,
        boundary: BoundaryRule,
    ) -> Result<Vec<CheckReport>, Failure> {
        let mut proofs: Vec<PartsProof> = cases.iter().map(|_| PartsProof::new(parts.cage(), Some(boundary))).collect();
        parts.for_each(|part| {
            let surface = maps.apply(part.surface().clone(), part.cage().cage(), &self.input.file)?;
            for (proof, case) in proofs.iter_mut().zip(cases) {
                proof.add(part, &surface, &case.tessellation)?;
            }
            let (number, count) = part.number();
            tracing::info!("part {} of {count} is proved", number + 1);
            Ok::<(), Failure>(())
        })?;
        Ok(proofs.into_iter().map(PartsProof::finish).collect())
    }

    fn cases(&self, bounds: Bounds) -> Result<Vec<Case>, Failure> {
        let case = |key, value, view, factors| {
            let tessellation = Tessellation { factors, spacing: self.spacing.into(), evaluator: self.evaluator.into() };
            Case { tessellation, key, value, view }
        };
        Ok(match &self.fineness {
            Fineness::Levels(levels) => {
                levels.iter().map(|level| case("level", level.get(), None, Factors::Uniform(level.get()))).collect()
            }
            Fineness::Adaptive { pixels, orbit } => {
                let camera = self.camera.camera(bounds)?;
                let views = orbit.map_or_else(|| vec![camera], |count| camera.orbit(count, bounds));
                let height = self.camera.size.height;
                let case = |(view, camera)| {
                    let factors = Factors::Adaptive { pixels: pixels.get(), camera, height };
                    case("adaptive", pixels.get(), orbit.map(|_| view), factors)
                };
                (0..).zip(views).map(case).collect()
            }
        })
    }

    fn print(&self, scheme: Scheme, case: &Case, report: &CheckReport) -> Result<(), Failure> {
        if self.json {
            return stdout::print_json(&self.object(scheme, case, report));
        }
        stdout::print_line(self.line(scheme, case, report))
    }

    fn line(&self, scheme: Scheme, case: &Case, report: &CheckReport) -> String {
        let CheckReport { triangles, open, over_shared, split_normals, inverted, degenerate, weld, .. } = report;
        let some = |count: u64, name: &str| if count == 0 { String::new() } else { format!("{count} {name}, ") };
        let split_positions = some(report.split_positions, "split_positions");
        let wrong_patches = some(report.wrong_patches, "wrong_patches");
        let (key, value, spacing) = (case.key, case.value, self.spacing.name());
        let view = case.view.map_or_else(String::new, |view| format!(" view {view}"));
        let verdict = if report.is_watertight() { "watertight" } else { "NOT WATERTIGHT" };
        format!(
            "{scheme} {key} {value}{view} {spacing}: {triangles} triangles, {open} open, {over_shared} over_shared, \
             {split_positions}{split_normals} split_normals, {inverted} inverted, {wrong_patches}{degenerate} degenerate; \
             by position {} open, {} over_shared: {verdict}",
            weld.open, weld.over_shared
        )
    }

    fn object(&self, scheme: Scheme, case: &Case, report: &CheckReport) -> Object {
        let value_of = |key| (case.key == key).then_some(case.value);
        Object {
            scheme: scheme.name(),
            level: value_of("level"),
            adaptive: value_of("adaptive"),
            view: case.view,
            spacing: self.spacing.name(),
            triangles: report.triangles,
            open: report.open,
            over_shared: report.over_shared,
            split_positions: report.split_positions,
            split_normals: report.split_normals,
            inverted: report.inverted,
            wrong_patches: report.wrong_patches,
            degenerate: report.degenerate,
            weld: Weld { open: report.weld.open, over_shared: report.weld.over_shared },
            watertight: report.is_watertight(),
        }
    }
}

/// What is printed as JSON. A struct, because the numbers of a `serde_json::Value` are all f64: level 5.3 would not be.
#[derive(Serialize)]
struct Object {
    scheme: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    level: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    adaptive: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    view: Option<u32>,
    spacing: &'static str,
    triangles: u64,
    open: u64,
    over_shared: u64,
    split_positions: u64,
    split_normals: u64,
    inverted: u64,
    wrong_patches: u64,
    degenerate: u64,
    weld: Weld,
    watertight: bool,
}

/// The same question asked of positions alone.
#[derive(Serialize)]
struct Weld {
    open: u64,
    over_shared: u64,
}
