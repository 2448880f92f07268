//! Results: JSON lines, CSV, tables for people, plots.

use super::summary::{Ratio, Summary};
use super::table1::Table;
use super::{Job, figure};
use crate::failure::{Failure, Verdict};
use crate::stdout;
use osculate::{Engine, Refinement};
use osculate_compare::whole_file;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};
use std::path::Path;

/// What was measured of one configuration: an object of the JSON lines.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) cage: String,
    pub(super) faces: usize,
    pub(super) scheme: String,
    /// Which faces are refined.
    #[serde(default = "everywhere")]
    pub(super) refine: String,
    /// Segments per patch edge.
    pub(super) level: f32,
    pub(super) evaluator: String,
    pub(super) animated: bool,
    /// What is left out.
    #[serde(default = "nothing")]
    pub(super) culling: String,
    /// Width x height.
    pub(super) size: String,
    pub(super) samples: u32,
    /// Refinement steps: each halves the edges of the cage.
    pub(super) steps: u32,
    pub(super) patches: usize,
    pub(super) triangles: Option<u64>,
    /// Vertices that the compute evaluator makes.
    pub(super) vertices: Option<u64>,
    /// Times of frames that count.
    pub(super) frame_ms: Summary,
    /// The same by the device's clock, of a few frames that are not among them.
    pub(super) gpu_ms: Option<Summary>,
    pub(super) frames: usize,
    /// Median of each round.
    pub(super) rounds_ms: Vec<f64>,
    /// Ratio to the first configuration of the same cage and level.
    pub(super) to_first: Ratio,
    /// Frames that draw the same triangles from vertices that stay.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) limit_ms: Option<Summary>,
    /// Ratio to them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) to_limit: Option<Ratio>,
    /// From the cage in memory to the end of its first frame, pipelines that were not there yet included.
    pub(super) first_frame_ms: f64,
    /// Pipelines made for it: those that an earlier configuration needed too are not among them.
    pub(super) pipelines: usize,
    pub(super) work: Work,
    pub(super) bytes: Bytes,
    #[serde(flatten)]
    pub(super) origin: Origin,
}

/// What a frame asks of the device.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Work {
    pub(super) vertex_invocations: Option<u64>,
    pub(super) evaluation_invocations: Option<u64>,
    pub(super) fragment_invocations: Option<u64>,
    pub(super) draws: u64,
    pub(super) dispatches: u64,
    pub(super) barriers: u64,
    pub(super) bytes_uploaded: u64,
}

/// Bytes on the device.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Bytes {
    /// Tables, points and records.
    pub(super) surface: u64,
    /// What drawing takes beyond them.
    pub(super) drawing: u64,
    /// All that is there while the group is measured.
    pub(super) device: u64,
}

/// What was measured on, and with what.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Origin {
    pub(super) device: String,
    pub(super) driver: String,
    pub(super) revision: String,
}

impl Origin {
    pub(super) fn new(engine: &Engine) -> Self {
        let info = engine.device().info();
        Self {
            device: info.name.clone(),
            driver: format!("{} {}", info.driver_name, info.driver_info),
            revision: env!("OSCULATE_REVISION").to_owned(),
        }
    }
}

/// Hands out rows in all forms that were asked for.
pub(super) fn rows(job: &Job, rows: &[Row]) -> Result<(), Failure> {
    match &job.json {
        Some(file) => {
            json_lines(file, rows)?;
            stdout::print::<io::Error>(|out| table(out, rows))?;
        }
        None => rows.iter().try_for_each(stdout::print_json)?,
    }
    if let Some(file) = &job.csv {
        whole_file::write(file, |out| csv(out, rows)).map_err(|error: io::Error| Failure::output(file, error))?;
    }
    match &job.plot {
        Some(file) => figure::write(file, rows),
        None => Ok(()),
    }
}

/// Hands out Table 1.
pub(super) fn tables(job: &Job, tables: &[Table]) -> Result<Verdict, Failure> {
    match &job.json {
        Some(file) => {
            json_lines(file, tables)?;
            stdout::print::<io::Error>(|out| tables.iter().try_for_each(|table| writeln!(out, "{table}")))?;
        }
        None => tables.iter().try_for_each(stdout::print_json)?,
    }
    Ok(Verdict::Pass)
}

fn json_lines<T: Serialize>(file: &Path, objects: &[T]) -> Result<(), Failure> {
    let write = |out: &mut dyn Write| -> io::Result<()> {
        for object in objects {
            serde_json::to_writer(&mut *out, object)?;
            writeln!(out)?;
        }
        Ok(())
    };
    whole_file::write(file, write).map_err(|error| Failure::output(file, error))
}

/// What rows leave out that do not say.
fn nothing() -> String {
    "none".to_owned()
}

/// Which faces are refined in rows that do not say.
pub(super) fn everywhere() -> String {
    Refinement::Everywhere.name().to_owned()
}

/// Columns of the CSV file and what goes into them.
type Column = (&'static str, fn(&Row) -> String);

const COLUMNS: [Column; 27] = [
    ("cage", |row| row.cage.clone()),
    ("faces", |row| row.faces.to_string()),
    ("scheme", |row| row.scheme.clone()),
    ("refine", |row| row.refine.clone()),
    ("level", |row| row.level.to_string()),
    ("evaluator", |row| row.evaluator.clone()),
    ("animated", |row| row.animated.to_string()),
    ("culling", |row| row.culling.clone()),
    ("size", |row| row.size.clone()),
    ("samples", |row| row.samples.to_string()),
    ("steps", |row| row.steps.to_string()),
    ("patches", |row| row.patches.to_string()),
    ("triangles", |row| optional(row.triangles)),
    ("frames", |row| row.frames.to_string()),
    ("frame_ms_median", |row| row.frame_ms.median.to_string()),
    ("frame_ms_mean", |row| row.frame_ms.mean.to_string()),
    ("frame_ms_min", |row| row.frame_ms.min.to_string()),
    ("frame_ms_max", |row| row.frame_ms.max.to_string()),
    ("frame_ms_p95", |row| row.frame_ms.p95.to_string()),
    ("gpu_ms_median", |row| optional(row.gpu_ms.map(|ms| ms.median))),
    ("limit_ms_median", |row| optional(row.limit_ms.map(|ms| ms.median))),
    ("to_limit", |row| optional(row.to_limit.map(|ratio| ratio.median))),
    ("to_first", |row| row.to_first.median.to_string()),
    ("first_frame_ms", |row| row.first_frame_ms.to_string()),
    ("device", |row| row.origin.device.clone()),
    ("driver", |row| row.origin.driver.clone()),
    ("revision", |row| row.origin.revision.clone()),
];

fn optional<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

fn csv(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    writeln!(out, "{}", COLUMNS.map(|(name, _)| name).join(","))?;
    for row in rows {
        writeln!(out, "{}", COLUMNS.map(|(_, cell)| quoted(cell(row))).join(","))?;
    }
    Ok(())
}

/// A cell that holds a separator stands in quotes.
fn quoted(cell: String) -> String {
    if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
}

fn table(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    let cage = rows.iter().map(|row| row.cage.chars().count()).max().unwrap_or_default().max(4);
    writeln!(
        out,
        "{:cage$}  scheme    refine      level  evaluator    triangles  frame ms   p95      to first              to limit",
        "cage"
    )?;
    for row in rows {
        let spread = |ratio: &Ratio| format!("{:.2} ({:.2} to {:.2})", ratio.median, ratio.low, ratio.high);
        writeln!(
            out,
            "{:cage$}  {:8}  {:10}  {:>5}  {:11}  {:>9}  {:>8.3}  {:>8.3}  {:20}  {}",
            row.cage,
            row.scheme,
            row.refine,
            row.level,
            row.evaluator,
            optional(row.triangles),
            row.frame_ms.median,
            row.frame_ms.p95,
            spread(&row.to_first),
            row.to_limit.as_ref().map_or_else(String::new, spread),
        )?;
    }
    Ok(())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A row with that median.
    pub(in super::super) fn row(cage: &str, scheme: &str, level: f32, median: f64) -> Row {
        let ms = Summary { median, mean: median, min: median, max: median, p95: median };
        let one = Ratio { median: 1.0, low: 1.0, high: 1.0 };
        Row {
            cage: cage.to_owned(),
            faces: 6,
            scheme: scheme.to_owned(),
            refine: everywhere(),
            level,
            evaluator: "tessellator".to_owned(),
            animated: false,
            culling: nothing(),
            size: "64x64".to_owned(),
            samples: 1,
            steps: 1,
            patches: 24,
            triangles: Some(48),
            vertices: None,
            frame_ms: ms,
            gpu_ms: None,
            frames: 1,
            rounds_ms: vec![median],
            to_first: one,
            limit_ms: None,
            to_limit: None,
            first_frame_ms: median,
            pipelines: 1,
            work: Work {
                vertex_invocations: None,
                evaluation_invocations: None,
                fragment_invocations: None,
                draws: 1,
                dispatches: 0,
                barriers: 1,
                bytes_uploaded: 0,
            },
            bytes: Bytes { surface: 1, drawing: 1, device: 2 },
            origin: Origin { device: "d".to_owned(), driver: "v".to_owned(), revision: "r".to_owned() },
        }
    }

    /// What is written is what `--compare` reads.
    #[test]
    fn rows_are_read_as_they_were_written() {
        let written = row("cube", "stam", 2.5, 0.125);
        let text = serde_json::to_string(&written).unwrap();
        let read: Row = serde_json::from_str(&text).unwrap();
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
        assert_eq!((read.level, read.frame_ms.median), (2.5, 0.125));
    }

    #[test]
    fn cells_with_separators_are_quoted() {
        assert_eq!(quoted("llvmpipe (LLVM 15, 256 bits)".into()), "\"llvmpipe (LLVM 15, 256 bits)\"");
        assert_eq!(quoted("5\" disk".into()), "\"5\"\" disk\"");
        assert_eq!(quoted("plain".into()), "plain");
    }
}
