//! Times what stands between a file and the first picture, and the two ways to make face points of quads (docs/measurements.md).
//!
//! ```sh
//! cargo run --release -p osculate --example measure_stages -- assets/cages/dragon.obj torus:20000     # stages and kernels
//! cargo run --release -p osculate --example measure_stages -- --faces torus:20000 torus:250000        # face points of quads, two kernels
//! cargo run --release -p osculate --example measure_stages -- --pictures assets/cages/dragon.obj      # first picture, cold and warm
//! ```
//! `torus:N` and `grid:N` stand for generated cages of about N quads. `--runs N` sets how often each thing is timed, `--json` prints a line of JSON for
//! each result, `--only-host` leaves the device alone.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use osculate::{BoundaryRule, Cage, Device, DeviceDesc, Engine, RenderDesc, Surface, SurfaceDesc, SurfacePlan, render};
use osculate_cage::{CageDesc, write_obj};
use osculate_gpu::{Bindings, Buffer, BufferUsage, ComputePass, ComputePipelineDesc, Measure, Recording, Report};
use osculate_shaders::constant::{GROUP_SIZE, GROUPS_X};
use osculate_shaders::{binding, layout::KernelPush};
use osculate_subdiv::{PlanDesc, RefineTables};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    match Options::parse(std::env::args().skip(1)).and_then(|options| measure(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn measure(options: &Options) -> Result<()> {
    options.cages.iter().try_for_each(|cage| match options.mode {
        Mode::Stages => stages(cage, options),
        Mode::Faces => face_kernels(cage, options),
        Mode::Pictures => pictures(cage, options),
        Mode::OnePicture => one_picture(cage),
    })
}

#[derive(Clone, Copy, Default)]
enum Mode {
    #[default]
    Stages,
    Faces,
    Pictures,
    /// What [`Mode::Pictures`] starts: the times of the parts of one picture.
    OnePicture,
}

struct Options {
    mode: Mode,
    runs: usize,
    json: bool,
    only_host: bool,
    cages: Vec<String>,
}

impl Options {
    fn parse(mut args: impl Iterator<Item = String>) -> Result<Self> {
        let mut options = Self { mode: Mode::default(), runs: 11, json: false, only_host: false, cages: Vec::new() };
        while let Some(arg) = args.next() {
            match arg.as_str() {
                "--faces" => options.mode = Mode::Faces,
                "--pictures" => options.mode = Mode::Pictures,
                "--one-picture" => options.mode = Mode::OnePicture,
                "--json" => options.json = true,
                "--only-host" => options.only_host = true,
                "--runs" => options.runs = args.next().ok_or("--runs needs a number")?.parse::<usize>()?.max(1),
                flag if flag.starts_with('-') => return Err(format!("unknown option {flag}").into()),
                _ => options.cages.push(arg),
            }
        }
        if options.cages.is_empty() {
            Err("no cage given: name OBJ files, torus:N or grid:N".into())
        } else {
            Ok(options)
        }
    }

    /// Prints the median and the quartiles of times in milliseconds.
    fn report(&self, cage: &str, what: &str, times: &[f64]) -> Result<()> {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |part: f64| sorted[(part * (sorted.len() - 1) as f64).round() as usize];
        let (median, q1, q3) = (at(0.5), at(0.25), at(0.75));
        if self.json {
            let [median_ms, q1_ms, q3_ms] = [median, q1, q3].map(|time| (1e4 * time).round() / 1e4);
            let line = Line { cage, what: what.trim(), median_ms, q1_ms, q3_ms, runs: times.len(), load: load() };
            println!("{}", serde_json::to_string(&line)?);
        } else {
            let runs = times.len();
            println!("{cage:24} {what:42} {median:9.3} ms  ({q1:.3} to {q3:.3}, {runs} runs, load {:.1})", load());
        }
        Ok(())
    }
}

/// One result.
#[derive(serde::Serialize)]
struct Line<'a> {
    cage: &'a str,
    what: &'a str,
    median_ms: f64,
    q1_ms: f64,
    q3_ms: f64,
    runs: usize,
    /// Processes that wanted to run, in the mean of the last minute; 0 where the system does not tell.
    load: f64,
}

fn load() -> f64 {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace().next().and_then(|load| load.parse().ok()).unwrap_or_default()
}

/// The result of some work, and its time in milliseconds.
fn timed<T>(work: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let start = Instant::now();
    let result = work()?;
    Ok((result, start.elapsed().as_secs_f64() * 1e3))
}

/// A cage as a file: the one named, or a generated one.
struct CageFile {
    path: PathBuf,
    _generated: Option<tempfile::TempPath>,
}

impl CageFile {
    fn new(name: &str) -> Result<Self> {
        let side = |quads: &str| -> Result<u32> { Ok(quads.parse::<f64>()?.sqrt().round() as u32) };
        let cage = match name.split_once(':') {
            Some(("torus", quads)) => torus(side(quads)?)?,
            Some(("grid", quads)) => grid(side(quads)?)?,
            _ => return Ok(Self { path: name.into(), _generated: None }),
        };
        let file = tempfile::Builder::new().suffix(".obj").tempfile()?;
        write_obj(&cage, std::io::BufWriter::new(&file))?;
        let generated = file.into_temp_path();
        Ok(Self { path: generated.to_path_buf(), _generated: Some(generated) })
    }
}

/// A closed torus of side x side quads.
fn torus(side: u32) -> Result<Cage> {
    let point = |i: u32, j: u32| {
        let [a, b] = [i, j].map(|k| TAU * f64::from(k) / f64::from(side));
        DVec3::new((3.0 + b.cos()) * a.cos(), b.sin(), (3.0 + b.cos()) * a.sin())
    };
    lattice(side, side, |i, j| i % side + side * (j % side), point)
}

/// An open grid of side x side quads.
fn grid(side: u32) -> Result<Cage> {
    let point = |i: u32, j: u32| DVec3::new(i.into(), j.into(), (0.1 * f64::from(i + 2 * j)).sin());
    lattice(side, side + 1, |i, j| i + (side + 1) * j, point)
}

fn lattice(
    side: u32,
    points: u32,
    vertex: impl Fn(u32, u32) -> u32,
    point: impl Fn(u32, u32) -> DVec3,
) -> Result<Cage> {
    let pairs = |n: u32| (0..n).flat_map(move |j| (0..n).map(move |i| (i, j)));
    let quad = |(i, j)| [vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)];
    Ok(Cage::new(CageDesc {
        positions: pairs(points).map(|(i, j)| point(i, j)).collect(),
        face_offsets: (0..=side * side).map(|face| 4 * face).collect(),
        face_vertices: pairs(side).flat_map(quad).collect(),
        ..CageDesc::default()
    })?)
}

/// From the file to records on the device. Each run takes all stages in turn.
fn stages(name: &str, options: &Options) -> Result<()> {
    let file = CageFile::new(name)?;
    let mut host = [Vec::new(), Vec::new()];
    for _ in 0..options.runs {
        let (cage, read) = timed(|| Ok(Cage::read(&file.path)?))?;
        let (_, planned) = timed(|| Ok(SurfacePlan::build(&cage, &PlanDesc::default())?))?;
        host[0].push(read);
        host[1].push(planned);
    }
    options.report(name, "file to cage with topology", &host[0])?;
    options.report(name, "tables and plan", &host[1])?;
    if options.only_host { Ok(()) } else { device_stages(name, &Cage::read(&file.path)?, options) }
}

fn device_stages(name: &str, cage: &Cage, options: &Options) -> Result<()> {
    let engine = open()?;
    let make = || Ok(Surface::new(&engine, cage, &SurfaceDesc::default())?);
    let surface = make()?; // Makes the pipelines, too.
    let mut device = [Vec::new(), Vec::new(), Vec::new()];
    for _ in 0..options.runs {
        let (_, planned) = timed(|| Ok(SurfacePlan::build(cage, &PlanDesc::default())?))?;
        let (_, made) = timed(make)?;
        let (_, updated) = timed(|| {
            let mut recording = Recording::new();
            surface.record_update(&mut recording)?;
            Ok(engine.device().run(&recording)?)
        })?;
        device[0].push(made);
        device[1].push(made - planned - updated);
        device[2].push(updated);
    }
    options.report(name, "surface: plan, upload, update", &device[0])?;
    options.report(name, "  upload: the surface less plan and update", &device[1])?;
    options.report(name, "  update: all passes in one submission", &device[2])?;
    kernels(name, &surface, options)
}

fn open() -> Result<Engine> {
    Ok(Engine::new(Device::new(&DeviceDesc { application: "measure_stages".to_owned(), ..DeviceDesc::default() })?))
}

/// Each pass of an update in a submission of its own: on llvmpipe, times within one submission do not separate passes.
fn kernels(name: &str, surface: &Surface, options: &Options) -> Result<()> {
    let mut recording = Recording::new();
    recording.measure(Measure { timings: true, ..Measure::default() });
    surface.record_update(&mut recording)?;
    let passes: Vec<Recording> = recording.split().collect();
    let mut results: Vec<(String, Vec<f64>)> = vec![Default::default(); passes.len()];
    for _ in 0..options.runs {
        for (pass, (name, times)) in passes.iter().zip(&mut results) {
            let report = surface.engine().device().run(pass)?;
            times.push(milliseconds(&report)?);
            name.clone_from(&report.timings[0].0);
        }
    }
    (1..)
        .zip(&results)
        .try_for_each(|(i, (shader, times))| options.report(name, &format!("    pass {i}: {shader}"), times))
}

/// Face points of quads by the edge kernel (four indices in one load) and by the face kernel (spans, a loop), in turn.
fn face_kernels(name: &str, options: &Options) -> Result<()> {
    let cage = Cage::read(&CageFile::new(name)?.path)?;
    let tables = RefineTables::build(cage.topology(), BoundaryRule::default(), 0);
    if !tables.quads {
        return Err(format!("{name} has faces other than quads").into());
    }
    let engine = open()?;
    let device = engine.device();
    let mut contestants = ["subdivide/edge.comp", "subdivide/face.comp"]
        .map(|shader| FaceKernel::new(device, shader, &cage, &tables))
        .into_iter()
        .collect::<Result<Vec<_>>>()?;
    for kernel in &contestants {
        device.run(&kernel.pass)?; // Compiles.
    }
    for _ in 0..options.runs {
        contestants.iter_mut().try_for_each(|kernel| kernel.time(device))?;
    }
    let points = |kernel: &FaceKernel| device.download::<u32>(&kernel.points, ..);
    if points(&contestants[0])? != points(&contestants[1])? {
        return Err("the two kernels do not agree".into());
    }
    contestants
        .iter()
        .try_for_each(|kernel| options.report(name, &format!("face points by {}", kernel.shader), &kernel.times))
}

/// One of the kernels, on a point buffer of its own.
struct FaceKernel {
    shader: &'static str,
    pass: Recording,
    points: Buffer,
    times: Vec<f64>,
}

impl FaceKernel {
    fn new(device: &Device, shader: &'static str, cage: &Cage, tables: &RefineTables) -> Result<Self> {
        let upload = |name: &str, data: &[u8]| device.upload(name, BufferUsage::STORAGE, data);
        let (count, first) = (tables.face_count() as u32, tables.first_new);
        let mut points: Vec<f32> = cage.positions().iter().flat_map(|p| p.as_vec3().to_array()).collect();
        points.resize(3 * (first + count) as usize, 0.0);
        let points = upload("points", cast_slice(&points))?;
        let bindings = Bindings::new()
            .with(binding::POINTS, &points)
            .with(binding::INDICES, &upload("indices", cast_slice(&tables.face_indices))?)
            .with(binding::SPANS, &upload("spans", cast_slice(&tables.face_spans))?);
        let module = device.shader(shader, osculate_shaders::shader(shader).ok_or("no such shader")?)?;
        let pipeline =
            device.compute_pipeline(&ComputePipelineDesc { name: shader, shader: &module, specialization: &[] })?;
        let groups = count.div_ceil(GROUP_SIZE);
        let mut pass = Recording::new();
        pass.measure(Measure { timings: true, ..Measure::default() });
        pass.compute(ComputePass {
            name: shader.to_owned(),
            pipeline,
            bindings,
            push: bytes_of(&KernelPush { count, first, old_distance: 0 }).to_vec(),
            groups: [groups.min(GROUPS_X), groups.div_ceil(GROUPS_X), 1],
        });
        Ok(Self { shader, pass, points, times: Vec::new() })
    }

    fn time(&mut self, device: &Device) -> Result<()> {
        self.times.push(milliseconds(&device.run(&self.pass)?)?);
        Ok(())
    }
}

/// Time of the one pass that ran.
fn milliseconds(report: &Report) -> Result<f64> {
    let (_, nanoseconds) = report.timings.first().ok_or("the device does not measure time")?;
    Ok(*nanoseconds as f64 * 1e-6)
}

/// First pictures of new processes, with Mesa's cache of compiled shaders empty (cold) and filled (warm).
fn pictures(name: &str, options: &Options) -> Result<()> {
    let file = CageFile::new(name)?;
    let mut runs = Vec::new();
    for _ in 0..options.runs {
        let cache = tempfile::tempdir()?;
        for state in ["cold", "warm"] {
            let output = Command::new(std::env::current_exe()?)
                .arg("--one-picture")
                .arg(&file.path)
                .env("MESA_SHADER_CACHE_DIR", cache.path())
                .env_remove("MESA_SHADER_CACHE_DISABLE")
                .output()?;
            if !output.status.success() {
                return Err(String::from_utf8_lossy(&output.stderr).into());
            }
            for line in String::from_utf8(output.stdout)?.lines() {
                let (time, part) = line.split_once(' ').ok_or("a line without a time")?;
                runs.push((format!("{state}: {part}"), time.parse()?));
            }
        }
    }
    let mut seen: Vec<&str> = Vec::new();
    for (what, _) in &runs {
        if !seen.contains(&what.as_str()) {
            seen.push(what);
            let times: Vec<f64> = runs.iter().filter(|(other, _)| other == what).map(|(_, time)| *time).collect();
            options.report(name, what, &times)?;
        }
    }
    Ok(())
}

/// Prints a line for each part of a process's first picture: milliseconds, a space, what they went into.
fn one_picture(path: &str) -> Result<()> {
    let start = Instant::now();
    let (cage, read) = timed(|| Ok(Cage::read(Path::new(path))?))?;
    let (engine, opened) = timed(open)?;
    let (surface, made) = timed(|| Ok(Surface::new(&engine, &cage, &SurfaceDesc::default())?))?;
    let desc = RenderDesc::fit(&cage, [800, 600]);
    let draw = || Ok(render(&engine, &[&surface], &desc)?);
    let (_, drawn) = timed(draw)?;
    let first = start.elapsed().as_secs_f64() * 1e3;
    let (_, again) = timed(draw)?;
    println!("{read} file to cage\n{opened} device\n{made} surface\n{drawn} picture");
    println!("{first} all up to the first picture\n{again} second picture");
    Ok(())
}
