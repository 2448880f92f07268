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
#[path = "build/variants.rs"]
mod variants;

use osculate_shader_compiler::{CompileDesc, CompileError, Folder, compile};
use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use variants::{Define, Variant};

/// The shaders folder, from this crate's.
const SHADERS: &str = "../../shaders";
/// Where `#include` looks after the including file's own folder, relative to the shaders folder.
const INCLUDE_DIRS: &[&str] = &["", "include"];

/// One shader to compile: a variant of a stage file.
struct Job {
    /// Path of the file plus the variant's suffix: `patch/regular.tese#equal`.
    name: String,
    /// Path of the file, relative to the shaders folder.
    path: String,
    defines: Vec<Define>,
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
    let job = |Variant { suffix, defines }| Job { name: format!("{path}{suffix}"), path: path.to_owned(), defines };
    variants::of(path).into_iter().map(job).collect()
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
        defines: &job.defines,
        debug_info: env::var_os("CARGO_FEATURE_DEBUG_INFO").is_some(),
    })
    .map_err(|error| match error {
        CompileError::Rejected(diagnostics) => diagnostics.iter().map(|found| format!("shaders/{found}")).collect(),
        other => vec![format!("shaders/{}: {other}", job.name)],
    })
}
