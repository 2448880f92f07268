//! Compiles the shaders folder and writes what `lib.rs` embeds: SPIR-V, sources, binding numbers and constants.
//!
//! Every stage file (`.vert .tesc .tese .frag .comp`) outside `include/` becomes one shader per row of its stage's variant
//! table. A shader that does not compile fails the build with a line `shaders/<file>:<line>: <message>`.

#[path = "build/defines.rs"]
mod defines;
#[path = "build/generate.rs"]
mod generate;
#[path = "build/tree.rs"]
mod tree;

use osculate_shader_compiler::{CompileDesc, CompileError, Folder, Stage, compile};
use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// The shaders folder, from this crate's.
const SHADERS: &str = "../../shaders";
/// Where `#include` looks after the including file's own folder, relative to the shaders folder.
const INCLUDE_DIRS: &[&str] = &["", "include"];

type Defines = &'static [(&'static str, Option<&'static str>)];

/// Variants of a stage: what is added to the file's path to name the shader, and the macros that make it. `SPACING` is the
/// tessellator's spacing, which is a layout qualifier and so no specialization constant; `CAPTURE` sends outputs to transform feedback; `MAPPED` is for
/// surfaces with texture coordinates, which may be displaced.
const EVALUATION_VARIANTS: &[(&str, Defines)] = &[
    ("#equal", &[("SPACING", Some("equal_spacing"))]),
    ("#odd", &[("SPACING", Some("fractional_odd_spacing"))]),
    ("#even", &[("SPACING", Some("fractional_even_spacing"))]),
    ("#equal,capture", &[("SPACING", Some("equal_spacing")), ("CAPTURE", None)]),
    ("#odd,capture", &[("SPACING", Some("fractional_odd_spacing")), ("CAPTURE", None)]),
    ("#even,capture", &[("SPACING", Some("fractional_even_spacing")), ("CAPTURE", None)]),
    ("#equal,mapped", &[("SPACING", Some("equal_spacing")), ("MAPPED", None)]),
    ("#odd,mapped", &[("SPACING", Some("fractional_odd_spacing")), ("MAPPED", None)]),
    ("#even,mapped", &[("SPACING", Some("fractional_even_spacing")), ("MAPPED", None)]),
    ("#equal,capture,mapped", &[("SPACING", Some("equal_spacing")), ("CAPTURE", None), ("MAPPED", None)]),
    ("#odd,capture,mapped", &[("SPACING", Some("fractional_odd_spacing")), ("CAPTURE", None), ("MAPPED", None)]),
    ("#even,capture,mapped", &[("SPACING", Some("fractional_even_spacing")), ("CAPTURE", None), ("MAPPED", None)]),
];
/// Stages that evaluate or colour patches: with `MAPPED` for surfaces with texture coordinates.
const MAPPED_VARIANTS: &[(&str, Defines)] = &[("", &[]), ("#mapped", &[("MAPPED", None)])];
const ONE_VARIANT: &[(&str, Defines)] = &[("", &[])];

/// Control stages that write as many vertices as the net has points, which SPIR-V wants as a literal: one variant for each net of 2n+8 points.
const NET_SIZE_STAGE: &str = "patch/stam.tesc";
const NET_SIZE_VARIANTS: &[(&str, Defines)] = &[
    ("#14", &[("POINTS_OUT", Some("14"))]),
    ("#18", &[("POINTS_OUT", Some("18"))]),
    ("#20", &[("POINTS_OUT", Some("20"))]),
    ("#22", &[("POINTS_OUT", Some("22"))]),
    ("#24", &[("POINTS_OUT", Some("24"))]),
    ("#26", &[("POINTS_OUT", Some("26"))]),
    ("#28", &[("POINTS_OUT", Some("28"))]),
    ("#30", &[("POINTS_OUT", Some("30"))]),
    ("#32", &[("POINTS_OUT", Some("32"))]),
];

/// The stage that colours patches, and the folder of the kernels that evaluate them.
const SURFACE_STAGE: &str = "shade/surface.frag";
const EVALUATION_FOLDER: &str = "evaluate/";
/// One of them that evaluates none.
const FACTORS_STAGE: &str = "evaluate/factors.comp";

/// One shader to compile: a variant of a stage file.
struct Job {
    /// Path of the file plus the variant's suffix: `patch/regular.tese#equal`.
    name: String,
    /// Path of the file, relative to the shaders folder.
    path: String,
    defines: Defines,
}

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed={SHADERS}");
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(messages) => {
            for message in messages {
                println!("cargo::error={message}");
            }
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Vec<String>> {
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or_else(|| vec!["OUT_DIR is not set".to_owned()])?);
    let root = Path::new(SHADERS).canonicalize().map_err(|error| vec![format!("{SHADERS}: {error}")])?;
    let folder = Folder(root.clone());
    let files = tree::sources(&root).map_err(|error| vec![error])?;
    let jobs: Vec<Job> = files.iter().flat_map(|path| jobs_of(path)).collect();
    let compiled = compile_all(&folder, &jobs)?;
    let bindings = defines::parse(&folder, "include/bindings.glsl", "BINDING_")?;
    let constants = defines::parse(&folder, "include/constants.glsl", "")?;
    generate::write(&out, &root, &files, &jobs, &compiled)
        .and_then(|()| generate::write_constants(&out.join("binding.rs"), &bindings))
        .and_then(|()| generate::write_constants(&out.join("constant.rs"), &constants))
        .map_err(|error| vec![format!("cannot write generated code to {}: {error}", out.display())])
}

/// The shaders that a file stands for: none for includes, one per variant for stages.
fn jobs_of(path: &str) -> Vec<Job> {
    let variants = match Stage::of_path(path) {
        Ok(Stage::TessellationEvaluation) => EVALUATION_VARIANTS,
        Ok(_) if path == NET_SIZE_STAGE => NET_SIZE_VARIANTS,
        Ok(Stage::Fragment) if path == SURFACE_STAGE => MAPPED_VARIANTS,
        Ok(Stage::Compute) if path.starts_with(EVALUATION_FOLDER) && path != FACTORS_STAGE => MAPPED_VARIANTS,
        Ok(_) => ONE_VARIANT,
        Err(_) => &[],
    };
    let job =
        |&(suffix, defines): &(&str, Defines)| Job { name: format!("{path}{suffix}"), path: path.to_owned(), defines };
    variants.iter().map(job).collect()
}

/// Compiles all jobs on all cores; the SPIR-V comes in the order of `jobs`, or else the errors of all that failed.
fn compile_all(folder: &Folder, jobs: &[Job]) -> Result<Vec<Vec<u32>>, Vec<String>> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some((at, job)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|at| Some((at, jobs.get(at)?)))
        {
            done.push((at, compile_job(folder, job)));
        }
        done
    };
    let threads = thread::available_parallelism().map_or(1, usize::from).min(jobs.len().max(1));
    let mut results: Vec<_> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a compiling thread does not panic")).collect()
    });
    results.sort_by_key(|&(at, _)| at);
    let (compiled, failed): (Vec<_>, Vec<_>) = results.into_iter().map(|(_, result)| result).partition(Result::is_ok);
    let mut messages: Vec<String> = failed.into_iter().filter_map(Result::err).flatten().collect();
    if messages.is_empty() {
        return Ok(compiled.into_iter().filter_map(Result::ok).collect());
    }
    // Variants of one file mostly share their errors.
    messages.sort();
    messages.dedup();
    Err(messages)
}

fn compile_job(folder: &Folder, job: &Job) -> Result<Vec<u32>, Vec<String>> {
    let source = folder.load(&job.path).ok_or_else(|| vec![format!("shaders/{}: not readable as UTF-8", job.path)])?;
    let load = |path: &str| folder.load(path);
    compile(&CompileDesc {
        name: &job.path,
        source: &source,
        include_dirs: INCLUDE_DIRS,
        load: &load,
        defines: job.defines,
        debug_info: env::var_os("CARGO_FEATURE_DEBUG_INFO").is_some(),
    })
    .map_err(|error| match error {
        CompileError::Rejected(diagnostics) => diagnostics.iter().map(|found| format!("shaders/{found}")).collect(),
        other => vec![format!("shaders/{}: {other}", job.name)],
    })
}
