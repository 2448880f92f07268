//! Runs the fuzzer of `fuzz/` from the kept corpora and keeps what it finds worth keeping; see docs/fuzzing.md.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail, ensure};

use crate::cargo;

/// What to fuzz, and for how long.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Minutes for each target; 0 only runs the corpora.
    #[arg(long, default_value_t = 30)]
    minutes: u32,
    /// Make the minimised corpora the kept ones.
    #[arg(long)]
    keep: bool,
    /// Targets, files of fuzz/targets without `.rs`; all of them by default.
    targets: Vec<String>,
}

/// Readers alone refuse files that are longer; what a fuzzer can tell, it can tell with less.
const MAX_LENGTH: &str = "-max_len=4096";
/// An input that takes more seconds or more mebibytes than this is a finding.
const LIMITS: [&str; 2] = ["-timeout=10", "-rss_limit_mb=1024"];

pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    ensure!(
        cargo::run(&["fuzz", "--version"], &[]).is_ok_and(|status| status.success()),
        "cargo-fuzz is missing; install it with `cargo install cargo-fuzz --locked`"
    );
    let targets = if arguments.targets.is_empty() { all_targets()? } else { arguments.targets.clone() };
    for target in &targets {
        fuzz(target, arguments.minutes)?;
        if arguments.keep {
            keep(target)?;
        }
    }
    Ok(())
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz")
}

fn all_targets() -> anyhow::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder().join("targets"))? {
        let path = entry?.path();
        if let Some(stem) = path.file_stem().filter(|_| path.extension().is_some_and(|ending| ending == "rs")) {
            names.push(stem.to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

fn fuzz(target: &str, minutes: u32) -> anyhow::Result<()> {
    let corpus = format!("fuzz/corpus/{target}");
    checked(&["run", "--quiet", "--package", "osculate-fuzzing", "--bin", "corpus", "unpack", target, &corpus], &[])
        .with_context(|| format!("unpacking the corpus of {target}"))?;
    let time = format!("-max_total_time={}", 60 * minutes);
    let dictionary = format!("-dict=fuzz/dictionaries/{target}.dict");
    let mut options = vec![MAX_LENGTH, LIMITS[0], LIMITS[1]];
    if minutes == 0 {
        options.push("-runs=0");
    } else {
        options.push(&time);
    }
    if folder().join(format!("dictionaries/{target}.dict")).exists() {
        options.push(&dictionary);
    }
    if run_target(target, &[&corpus], &options).is_err() {
        bail!(
            "{target} has a finding in fuzz/artifacts/{target}; make it small with \
             `RUSTC_BOOTSTRAP=1 cargo fuzz tmin -s none {target} FILE`"
        );
    }
    Ok(())
}

/// Packs the smallest inputs that reach what the whole corpus does.
fn keep(target: &str) -> anyhow::Result<()> {
    let (corpus, smallest) = (format!("fuzz/corpus/{target}"), format!("fuzz/corpus/{target}-smallest"));
    let there = folder().join(format!("corpus/{target}-smallest"));
    if there.exists() {
        fs::remove_dir_all(&there)?;
    }
    fs::create_dir_all(&there)?;
    // How often a line runs is no reason to keep an input.
    run_target(target, &[&smallest, &corpus], &["-merge=1", "-use_counters=0", MAX_LENGTH])?;
    checked(&["run", "--quiet", "--package", "osculate-fuzzing", "--bin", "corpus", "pack", target, &smallest], &[])
}

fn run_target(target: &str, folders: &[&str], options: &[&str]) -> anyhow::Result<()> {
    let arguments = [&["fuzz", "run", "--sanitizer", "none", target], folders, &["--"], options].concat();
    // Instrumentation is an option of the compiler that is not stable.
    checked(&arguments, &[("RUSTC_BOOTSTRAP", "1")])
}

fn checked(arguments: &[&str], environment: &[(&str, &str)]) -> anyhow::Result<()> {
    ensure!(cargo::run(arguments, environment)?.success(), "cargo {} failed", arguments.join(" "));
    Ok(())
}
