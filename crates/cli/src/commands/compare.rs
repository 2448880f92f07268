//! `compare`: two pictures, as a person would see them.

use crate::failure::{Failure, PLACE_HINT, Verdict};
use crate::options::Output;
use crate::stdout;
use clap::Args;
use osculate_compare::{CompareDesc, CompareError, Comparison, Limits, Picture, compare, load};
use serde::Serialize;
use std::path::PathBuf;

/// Compare two pictures as a person would see them.
///
/// The measure is FLIP: how visible a difference is to someone who flips between the pictures. 0 is equal, 1 the largest
/// difference there is. Differences of alpha count. Exit code 1 means that the pictures differ more than the limits allow,
/// or in size.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct CompareArgs {
    /// The reference picture.
    a: PathBuf,

    /// The picture to be judged.
    b: PathBuf,

    /// Largest mean of the FLIP values that passes, 0 to 1. The default lets roundings of a driver pass.
    #[arg(long, value_name = "FLIP", default_value_t = Limits::SAME_DRIVER.mean, allow_negative_numbers = true)]
    mean: f32,

    /// Largest 99th percentile that passes, 0 to 1: it catches small spots that the mean overlooks.
    #[arg(long, value_name = "FLIP", default_value_t = Limits::SAME_DRIVER.p99, allow_negative_numbers = true)]
    p99: f32,

    /// Write a picture of the differences: black is equal, through purple and orange to light yellow.
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,

    /// Print one JSON object instead of a line of text.
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  osculate compare golden.png new.png
  osculate compare golden.png new.png --mean 0.01 --p99 0.2 -o diff.png";

/// A comparison that can be made.
pub(crate) struct Job {
    a: PathBuf,
    b: PathBuf,
    limits: Limits,
    output: Option<Output<()>>,
    json: bool,
}

impl CompareArgs {
    /// Checks the limits and the place of the output.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        let output = self.output.map(|path| Output::new(path, &[("png", ())])?.apart_from([self.a.as_path(), &self.b]));
        let output = output.transpose()?;
        for (name, limit) in [("mean", self.mean), ("p99", self.p99)] {
            if !(0.0..=1.0).contains(&limit) {
                return Err(Failure::usage(format_args!("--{name} {limit}: FLIP values are from 0 to 1"))
                    .with_hint("0 lets no difference pass, 1 any"));
            }
        }
        let limits = Limits { mean: self.mean, p99: self.p99 };
        Ok(Job { a: self.a, b: self.b, limits, output, json: self.json })
    }
}

/// Compares, writes the picture of differences, prints the figures.
pub(crate) fn run(job: &Job) -> Result<Verdict, Failure> {
    let picture = |path| load(path).map_err(Failure::unreadable);
    let comparison = match compare_pictures(&picture(&job.a)?, &picture(&job.b)?)? {
        Ok(comparison) => comparison,
        Err(sizes) => return print_sizes(job, &sizes),
    };
    if let Some(output) = &job.output {
        comparison.picture().write(&output.path).map_err(|error| Failure::usage(error).with_hint(PLACE_HINT))?;
    }
    let verdict = Verdict::of(job.limits.check(&comparison).is_ok());
    print_figures(job, &comparison, verdict)?;
    Ok(verdict)
}

/// The comparison; or, as a result and not a failure, that the sizes differ.
fn compare_pictures(a: &Picture, b: &Picture) -> Result<Result<Comparison, CompareError>, Failure> {
    match compare(a, b, &CompareDesc::default()) {
        Ok(comparison) => Ok(Ok(comparison)),
        Err(sizes @ CompareError::SizesDiffer { .. }) => Ok(Err(sizes)),
        Err(error) => Err(Failure::input(error)),
    }
}

fn print_sizes(job: &Job, sizes: &CompareError) -> Result<Verdict, Failure> {
    if job.json {
        stdout::print_json(&Figures { reason: Some(sizes.to_string()), ..Figures::none(job.limits) })?;
    } else {
        stdout::print_line(format_args!("different: {sizes}"))?;
    }
    Ok(Verdict::Fail)
}

/// What is printed as JSON. A struct, because the numbers of a `serde_json::Value` are all f64, which would print 0.002 with
/// the digits of its rounding.
#[derive(Serialize)]
struct Figures {
    same: bool,
    /// Why the pictures could not be compared; absent if they were.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    // Null where the sizes differ.
    mean: Option<f32>,
    p99: Option<f32>,
    max: Option<f32>,
    alpha: Option<u8>,
    mean_limit: f32,
    p99_limit: f32,
}

impl Figures {
    /// What is known of pictures that could not be compared.
    fn none(Limits { mean: mean_limit, p99: p99_limit }: Limits) -> Self {
        Self { same: false, reason: None, mean: None, p99: None, max: None, alpha: None, mean_limit, p99_limit }
    }
}

fn print_figures(job: &Job, comparison: &Comparison, verdict: Verdict) -> Result<(), Failure> {
    let Comparison { mean, p99, max, alpha, .. } = *comparison;
    let Limits { mean: mean_limit, p99: p99_limit } = job.limits;
    let same = verdict == Verdict::Pass;
    if job.json {
        let (mean, p99, max, alpha) = (Some(mean), Some(p99), Some(max), Some(alpha));
        return stdout::print_json(&Figures { same, mean, p99, max, alpha, ..Figures::none(job.limits) });
    }
    let word = if same { "same" } else { "different" };
    let remark = if same || alpha == 0 { "" } else { " (alpha differs)" };
    stdout::print_line(format_args!(
        "{word}: FLIP mean {mean:.6} (limit {mean_limit}), p99 {p99:.6} (limit {p99_limit}), max {max:.6}, alpha {alpha}/255{remark}"
    ))
}
