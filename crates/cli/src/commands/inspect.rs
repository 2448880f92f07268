//! `inspect`: what a cage is made of.

use crate::args::GlobalArgs;
use crate::failure::{Failure, Verdict};
use crate::input::{InputArgs, boundary_name};
use crate::stdout;
use clap::Args;
use osculate::{PatchKind, PlanError, Scheme, SurfacePlan};
use osculate_cage::{BoundaryRule, Cage, Inspection, inspect};
use osculate_subdiv::PlanDesc;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt::{Display, Write};

/// Say what a cage is made of.
///
/// Prints vertices, faces, valences, boundaries, tags, the patches that each scheme makes of the cage, and what may be a
/// mistake. The valence of a vertex is the number of its edges, at the boundary too; vertices at the boundary are also
/// counted alone. A readable cage exits with 0, whatever its problems; exit code 3 means that it cannot be read or is
/// refused.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct InspectArgs {
    #[command(flatten)]
    input: InputArgs,

    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  osculate inspect cube.obj
  osculate inspect cube.obj --json
  osculate inspect walk_####.obj";

/// A cage to look at.
pub(crate) struct Job {
    input: InputArgs,
    json: bool,
}

impl InspectArgs {
    /// Nothing can be wrong.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        Ok(Job { input: self.input, json: self.json })
    }
}

/// What is printed as JSON.
#[derive(Serialize)]
struct Findings {
    #[serde(flatten)]
    cage: Inspection,
    /// What moves by frames.
    frames: Frames,
    /// The boundary rule in force.
    boundary_rule: &'static str,
    /// What each scheme of this build makes of the cage.
    schemes: BTreeMap<&'static str, SchemePlan>,
    /// What keeps the schemes from drawing the cage; absent if nothing does.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_drawn: Option<String>,
}

/// The frames of numbered files or of time samples; one of a cage that stands still.
#[derive(Clone, Copy, Serialize)]
struct Frames {
    count: usize,
    /// When the first one is, in seconds.
    first: f64,
    /// When the last one is.
    last: f64,
}

impl Frames {
    fn new(times: &[f64]) -> Self {
        let time = |time: Option<&f64>| time.copied().unwrap_or_default();
        Self { count: times.len().max(1), first: time(times.first()), last: time(times.last()) }
    }
}

impl Display for Frames {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{}, from {} s to {} s", self.count, self.first, self.last)
    }
}

/// The patches that a scheme makes of a cage.
#[derive(Serialize)]
struct SchemePlan {
    patches: usize,
    /// In the order of the lists: by valence.
    #[serde(serialize_with = "as_map")]
    by_kind: Vec<(String, u32)>,
    steps: u32,
    bytes: usize,
}

/// Looks at the cage and prints what there is.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let (input, times) = job.input.read_silently(global)?;
    let findings = Findings { frames: Frames::new(&times), ..Findings::new(&input.cage, input.boundary) };
    if job.json {
        stdout::print_json(&findings)?;
    } else {
        stdout::print_line(findings.text().trim_end())?;
    }
    Ok(Verdict::Pass)
}

impl Findings {
    fn new(cage: &Cage, boundary: BoundaryRule) -> Self {
        let plan = |&scheme: &Scheme| {
            let plan = SurfacePlan::build(cage, &PlanDesc { boundary: Some(boundary), scheme, ..PlanDesc::default() })?;
            Ok((scheme.name(), SchemePlan::new(&plan)))
        };
        let (schemes, not_drawn) = match Scheme::ALL.iter().map(plan).collect::<Result<_, PlanError>>() {
            Ok(schemes) => (schemes, None),
            Err(error) => (BTreeMap::new(), Some(error.to_string())),
        };
        Self {
            cage: inspect(cage),
            frames: Frames::new(&[]),
            boundary_rule: boundary_name(boundary),
            schemes,
            not_drawn,
        }
    }

    fn text(&self) -> String {
        let cage = &self.cage;
        let tags = [(cage.creases, "crease"), (cage.corners, "corner"), (cage.holes, "hole")];
        let tags = tags.map(|(n, noun)| count(n, noun));
        let mut text = String::new();
        let mut row = |name: &str, value: &dyn Display| {
            writeln!(text, "{name:16} {value}").expect("writing to a string does not fail");
        };
        row("vertices", &cage.vertices);
        row("edges", &cage.edges);
        row("faces", &cage.faces);
        row("face sizes", &histogram(&cage.faces_by_size));
        row("valences", &histogram(&cage.valence));
        if !cage.boundary_valence.is_empty() {
            row("at the boundary", &histogram(&cage.boundary_valence));
        }
        row("boundary edges", &format_args!("{} in {}", cage.boundary_edges, count(cage.boundaries, "curve")));
        row("boundary rule", &self.boundary_rule);
        row("components", &cage.components);
        row("genus", &cage.genus);
        row("euler", &cage.euler);
        row("tags", &tags.join(", "));
        if self.frames.count > 1 {
            row("frames", &self.frames);
        }
        if let Some(polygons) = &cage.polygons {
            row("polygons", polygons);
        }
        for (name, plan) in &self.schemes {
            row(name, plan);
        }
        if let Some(reason) = &self.not_drawn {
            row("not drawn", reason);
        }
        for problem in &cage.problems {
            row("problem", problem);
            if !problem.hint().is_empty() {
                row("  hint", &problem.hint());
            }
        }
        if cage.problems.is_empty() {
            row("problems", &"none");
        }
        text
    }
}

/// `1 hole`, `2 holes`.
fn count(n: usize, noun: &str) -> String {
    let ending = match noun {
        _ if n == 1 => "",
        "patch" => "es",
        _ => "s",
    };
    format!("{n} {noun}{ending}")
}

/// `value x count` pairs, or `none`.
fn histogram(counts: &BTreeMap<u32, usize>) -> String {
    let pairs: Vec<String> = counts.iter().map(|(value, count)| format!("{value} (x{count})")).collect();
    if pairs.is_empty() { "none".into() } else { pairs.join(", ") }
}

impl SchemePlan {
    fn new(plan: &SurfacePlan) -> Self {
        let by_kind = plan.lists.iter().map(|list| (kind_name(list.kind), list.count)).collect();
        Self { patches: plan.patches.len(), by_kind, steps: plan.steps(), bytes: plan.bytes() }
    }
}

fn as_map<S: Serializer>(pairs: &[(String, u32)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, count)| (name, count)))
}

fn kind_name(kind: PatchKind) -> String {
    match kind {
        PatchKind::Unrefined => "unrefined".into(),
        PatchKind::Regular => "regular".into(),
        PatchKind::Extraordinary { form, valence } => format!("{}_valence_{valence}", form.name()),
        PatchKind::Stored { form } => format!("{}_stored", form.name()),
    }
}

impl Display for SchemePlan {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let kinds: Vec<String> = self.by_kind.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
        let (patches, steps) = (count(self.patches, "patch"), count(self.steps as usize, "step"));
        write!(out, "{patches} ({}) after {steps}, {} bytes of tables", kinds.join(", "), self.bytes)
    }
}
