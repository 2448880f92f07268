//! `sample`: points of the surface as CSV.

use crate::args::GlobalArgs;
use crate::device::with_engine;
use crate::failure::{Failure, Verdict, WriteError};
use crate::input::{Input, InputArgs};
use crate::options::{SchemeName, check_apart, check_place};
use crate::progress::Progress;
use crate::samples::exact::Exact;
use crate::samples::{self, Places};
use crate::stdout;
use clap::{Args, ValueEnum};
use osculate::{Sample, Scheme, SubFace, Surface, SurfaceDesc, SurfacePoint};
use osculate_cage::Cage;
use osculate_compare::whole_file;
use osculate_surface::reference::Mesh;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Print points of the surface with derivatives and normals as CSV.
///
/// Columns: face, sub, s, t (the place on the cage), position, derivatives by s and by t, unit normal, ev.
///
/// A quad has sub = -1 and (s,t) = (0,0), (1,0), (1,1), (0,1) at its vertices. Any other face consists of one sub-face per
/// vertex, sub = 0, 1, ..: (0,0) is the vertex, (1,0) the middle of the edge to the next vertex, (1,1) the centre of the
/// face, (0,1) the middle of the edge to the previous vertex. Faces count from 0 in file
/// order, before any repair.
///
/// ev = 1: corner on an irregular vertex; do not use du, dv there. Positions and normals at vertices are exact for every
/// scheme; between them stam is exact everywhere, the others approximate next to irregular vertices.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SampleArgs {
    #[command(flatten)]
    input: InputArgs,

    /// How the surface is put together. Default: gregory2; with the reference evaluator stam, the exact limit surface.
    #[arg(long, alias = "schemes", value_name = "SCHEME")]
    scheme: Option<SchemeName>,

    /// Sample each face or sub-face at (N + 1) x (N + 1) points.
    #[arg(long, value_name = "N", default_value_t = 4, allow_negative_numbers = true, value_parser = steps)]
    grid: u32,

    /// Sample at the places in this CSV file instead: face,sub,s,t in each line.
    #[arg(long, value_name = "POINTS.csv", conflicts_with = "grid")]
    at: Option<PathBuf>,

    /// Who evaluates.
    #[arg(long, value_name = "EVALUATOR", default_value = "auto")]
    evaluator: EvaluatorArg,

    /// Where to write the CSV. Default: stdout.
    #[arg(short, long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
}

fn steps(text: &str) -> Result<u32, String> {
    text.parse().ok().filter(|&n| n > 0).ok_or_else(|| format!("expected a whole number from 1 to {}", u32::MAX))
}

/// Names of the evaluators.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum EvaluatorArg {
    /// The device.
    Auto,
    /// The device, running the code of the tessellation stages.
    Tessellator,
    /// The same code in a compute shader; gives equal results.
    Compute,
    /// The exact limit surface in double precision, without a device.
    Reference,
}

const EXAMPLES: &str = "\
Examples:
  osculate sample cube.obj --grid 8 -o cube.csv
  osculate sample cube.obj --scheme stam --evaluator reference | head
  osculate sample cube.obj --at points.csv -o found.csv";

/// What is sampled, by whom, where to.
pub(crate) struct Job {
    input: InputArgs,
    places: PlacesFrom,
    evaluator: Evaluator,
    output: Option<PathBuf>,
}

/// Who evaluates what.
enum Evaluator {
    /// The exact limit surface, without a device.
    Reference,
    /// The device, in this scheme.
    Device(Scheme),
}

/// Where the places come from.
enum PlacesFrom {
    /// A grid of so many steps on every face.
    Grid(u32),
    /// A CSV file.
    List(PathBuf),
}

impl SampleArgs {
    /// Checks that evaluator and scheme go together.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        let evaluator = match (self.evaluator, self.scheme) {
            (EvaluatorArg::Reference, None | Some(SchemeName::Stam)) => Evaluator::Reference,
            (EvaluatorArg::Reference, Some(scheme)) => return Err(reference_is_exact(scheme)),
            (_, scheme) => Evaluator::Device(scheme.unwrap_or(SchemeName::Gregory2).in_this_build()?),
        };
        if let Some(output) = &self.output {
            check_place(output)?;
            check_apart(output, [self.input.file.as_path()].into_iter().chain(self.at.as_deref()))?;
        }
        let places = self.at.map_or(PlacesFrom::Grid(self.grid), PlacesFrom::List);
        Ok(Job { input: self.input, places, evaluator, output: self.output })
    }
}

fn reference_is_exact(scheme: SchemeName) -> Failure {
    Failure::usage(format_args!(
        "--evaluator reference gives the exact limit surface, which is the scheme stam, not {scheme}"
    ))
    .with_hint("ask for --scheme stam, or leave --scheme away")
}

/// Samples and writes.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let input = job.input.read(global)?;
    let drawn = input.cage.drawn_faces(input.boundary);
    job.input.require_faces(&input, &drawn)?;
    let places = job.places.read(&input, &drawn)?;
    let path = job.output.as_deref();
    match job.evaluator {
        Evaluator::Reference => {
            let mesh = Mesh::from(&input.cage);
            let exact = Exact::new(&mesh, input.boundary)?;
            write_rows(path, &input.cage, places, &|places| exact.evaluate(places), global)?;
        }
        Evaluator::Device(scheme) => with_engine(global, |engine| {
            let desc = SurfaceDesc { scheme, boundary: Some(input.boundary), ..SurfaceDesc::default() };
            let surface = Surface::new(engine, &input.cage, &desc).map_err(|error| job.input.refuse(error))?;
            write_rows(path, &input.cage, places, &|places| Ok(surface.sample(places)?), global)
        })?,
    }
    Ok(Verdict::Pass)
}

impl PlacesFrom {
    fn read(&self, input: &Input, drawn: &[bool]) -> Result<Places, Failure> {
        match self {
            Self::Grid(n) => Ok(samples::grid(&input.cage, *n, drawn)),
            Self::List(path) => samples::read(path, &input.cage, drawn),
        }
    }
}

/// Evaluates a batch of places.
type Evaluate<'a> = &'a dyn Fn(&[SurfacePoint]) -> Result<Vec<Sample>, Failure>;

fn write_rows(
    path: Option<&Path>,
    cage: &Cage,
    places: Places,
    evaluate: Evaluate<'_>,
    global: &GlobalArgs,
) -> Result<(), Failure> {
    let count = places.len;
    let progress = Progress::new(global.quiet, count, "sampling");
    let write = |out: &mut dyn Write| -> Result<(), WriteError> {
        writeln!(out, "{}", samples::HEADER)?;
        for batch in places.batches() {
            for (place, found) in batch.iter().zip(evaluate(&batch)?) {
                let sub_face = SubFace { face: cage.source_face(place.sub_face.face), ..place.sub_face };
                samples::write_row(out, &SurfacePoint { sub_face, ..*place }, &found)?;
            }
            progress.advance(batch.len() as u64);
        }
        Ok(())
    };
    match path {
        Some(path) => whole_file::write(path, write).map_err(|error| error.to(path))?,
        None => stdout::print(write)?,
    }
    let bytes = path.and_then(|path| std::fs::metadata(path).ok()).map(|found| format!(", {} bytes", found.len()));
    tracing::info!("{count} places{}", bytes.unwrap_or_default());
    Ok(())
}
