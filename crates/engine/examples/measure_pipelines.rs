//! Times the way to the first picture of a cage in every scheme, with the caches of pipelines and shaders empty (cold) and filled (warm), and counts
//! the pipelines (docs/measurements.md).
//!
//! ```sh
//! cargo run --release -p osculate --example measure_pipelines -- --runs 5 assets/cages/stars.obj
//! ```
//! Each run is a process of its own. Cold runs come twice: with pipelines made on all threads and on one.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use osculate::{
    Cage, Device, DeviceDesc, Engine, EngineDesc, PipelineObserver, RenderDesc, Scheme, Surface, SurfaceDesc, render,
};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// What a run finds, in the order in which it prints it.
const PARTS: [&str; 6] =
    ["pipelines that draw", "kernels", "making both", "surface", "all to the first picture", "second picture"];

/// One number for each part, times in milliseconds.
type Run = [f64; PARTS.len()];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments.as_slice() {
        ["--one", scheme, cache, cage] => one(scheme, cache.into(), Path::new(cage)),
        ["--runs", runs, cage] => runs.parse().map_err(Into::into).and_then(|runs| measure(runs, cage)),
        [cage] if !cage.starts_with('-') => measure(5, cage),
        _ => Err("usage: measure_pipelines [--runs N] CAGE.obj".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints median and quartiles of each part, for each scheme and each state of the caches.
fn measure(runs: usize, cage: &str) -> Result<()> {
    for &scheme in Scheme::ALL {
        let mut found: [(&str, Vec<Run>); 3] = ["cold, one thread", "cold", "warm"].map(|state| (state, Vec::new()));
        for _ in 0..runs.max(1) {
            let [one, all] = [tempfile::tempdir()?, tempfile::tempdir()?];
            for ((_, times), cache) in found.iter_mut().zip([&one, &all, &all]) {
                let threads = if std::ptr::eq(cache, &one) { "1" } else { "0" };
                times.push(start(scheme, cache.path(), threads, cage)?);
            }
        }
        for (state, times) in found {
            for (part, what) in PARTS.iter().enumerate() {
                let mut sorted: Vec<f64> = times.iter().map(|run| run[part]).collect();
                sorted.sort_by(f64::total_cmp);
                let at = |share: f64| sorted[(share * (sorted.len() - 1) as f64).round() as usize];
                let (median, q1, q3) = (at(0.5), at(0.25), at(0.75));
                println!("{:9} {state:16} {what:25} {median:8.1} ({q1:.1} to {q3:.1})", scheme.name());
            }
        }
    }
    Ok(())
}

/// Measures in a new process.
fn start(scheme: Scheme, cache: &Path, threads: &str, cage: &str) -> Result<Run> {
    let output = Command::new(std::env::current_exe()?)
        .args(["--one", scheme.name()])
        .arg(cache)
        .arg(cage)
        .env("MESA_SHADER_CACHE_DIR", cache)
        .env_remove("MESA_SHADER_CACHE_DISABLE")
        .env("RAYON_NUM_THREADS", threads)
        .output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let numbers = String::from_utf8(output.stdout)?;
    let numbers = numbers.split_whitespace().map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
    numbers.try_into().map_err(|_| "a run did not print all numbers".into())
}

/// Draws a picture and prints a [`Run`].
fn one(scheme: &str, cache: PathBuf, cage: &Path) -> Result<()> {
    let begin = Instant::now();
    let cage = Cage::read(cage)?;
    let device = Device::new(&DeviceDesc { application: "measure_pipelines".to_owned(), ..DeviceDesc::default() })?;
    let (observer, making) = stopwatch();
    let desc = EngineDesc { pipeline_cache: Some(cache), observer: Some(observer), ..EngineDesc::default() };
    let engine = Engine::with(device, desc);
    let start = Instant::now();
    let surface = Surface::new(&engine, &cage, &SurfaceDesc { scheme: scheme.parse()?, ..SurfaceDesc::default() })?;
    let made = start.elapsed();
    let desc = RenderDesc::fit(&cage, [800, 600]);
    render(&engine, &[&surface], &desc)?;
    let first = begin.elapsed();
    let again = Instant::now();
    render(&engine, &[&surface], &desc)?;
    let again = again.elapsed();
    let (kernels, drawing): (Vec<_>, Vec<_>) =
        engine.pipeline_names().into_iter().partition(|name| name.ends_with(".comp"));
    println!("{}\n{}", drawing.len(), kernels.len());
    let making = *making.lock().map_err(|_| "the observer failed")?;
    [making, made, first, again].iter().for_each(|time| println!("{}", 1e3 * time.as_secs_f64()));
    Ok(())
}

/// The time in which pipelines were being made.
fn stopwatch() -> (PipelineObserver, Arc<Mutex<Duration>>) {
    let total = Arc::new(Mutex::new(Duration::ZERO));
    let (sum, begin) = (Arc::clone(&total), Mutex::new(Instant::now()));
    let observer = PipelineObserver::new(move |progress| {
        let (Ok(mut sum), Ok(mut begin)) = (sum.lock(), begin.lock()) else { return };
        match progress.done {
            0 => *begin = Instant::now(),
            done if done == progress.total => *sum += begin.elapsed(),
            _ => {}
        }
    });
    (observer, total)
}
