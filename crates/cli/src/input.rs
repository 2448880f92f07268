//! Reading a cage and deciding which boundary rule applies to it.

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::generated::{torus, torus_quads};
use crate::options::ReadArgs;
use crate::progress::Progress;
use clap::{Args, ValueEnum};
use osculate::{EngineError, PlanError};
use osculate_cage::{
    BoundaryRule, Cage, CageError, LimitError, ReadDesc, ReadError, ReadObserver, ReadProgress, Sequence,
};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// The cage and what happens at its boundary.
#[derive(Args, Debug)]
pub(crate) struct InputArgs {
    /// The control cage: .obj, .ply, .off, .gltf, .glb, .usd, .usda, .usdc or .usdz. Of numbered files, named by a pattern such
    /// as walk_####.obj or walk_%04d.obj, and of time samples in a file it is the first frame. torus:N is a generated torus of about
    /// N quads.
    pub(crate) file: PathBuf,

    /// What happens where the cage ends. Default: what the file's tags say, else edge-and-corner.
    #[arg(long, value_name = "RULE")]
    boundary: Option<BoundaryArg>,

    #[command(flatten)]
    read: ReadArgs,
}

/// Names of the boundary rules.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum BoundaryArg {
    /// The boundary is a smooth curve; vertices with a single face are corners that stay fixed.
    EdgeAndCorner,
    /// The boundary is a smooth curve throughout.
    EdgeOnly,
    /// Faces that touch the boundary are dropped.
    None,
}

impl From<BoundaryArg> for BoundaryRule {
    fn from(arg: BoundaryArg) -> Self {
        match arg {
            BoundaryArg::EdgeAndCorner => Self::EdgeAndCorner,
            BoundaryArg::EdgeOnly => Self::EdgeOnly,
            BoundaryArg::None => Self::None,
        }
    }
}

/// The name of a rule on the command line.
pub(crate) fn boundary_name(rule: BoundaryRule) -> &'static str {
    match rule {
        BoundaryRule::EdgeAndCorner => "edge-and-corner",
        BoundaryRule::EdgeOnly => "edge-only",
        BoundaryRule::None => "none",
    }
}

/// A cage with the boundary rule that applies to it.
pub(crate) struct Input {
    /// The cage.
    pub(crate) cage: Cage,
    /// The rule: the option, else the file's tag, else the default.
    pub(crate) boundary: BoundaryRule,
}

impl InputArgs {
    /// Reads the cage, passing its warnings on.
    pub(crate) fn read(&self, global: &GlobalArgs) -> Result<Input, Failure> {
        let generated = self.file.to_str().and_then(torus_quads);
        let cage = match generated {
            Some(count) => torus(count?)?,
            None => read(&self.file, &self.read.desc()?, global)?,
        };
        let input = self.input(cage);
        warn(&self.file, &input.cage);
        Ok(input)
    }

    /// Reads the cage with all its frames, numbered files at that rate, passing its warnings on.
    pub(crate) fn read_frames(&self, rate: Option<f64>, global: &GlobalArgs) -> Result<(Input, Sequence), Failure> {
        let mut sequence = open(&self.file, &self.read.desc()?, global)?;
        if let Some(rate) = rate {
            sequence = sequence.with_frames_per_second(rate);
        }
        let input = self.input(sequence.cage().clone());
        warn(&self.file, &input.cage);
        Ok((input, sequence))
    }

    /// Reads the cage and tells when its frames are, for a command whose result holds the warnings.
    pub(crate) fn read_silently(&self, global: &GlobalArgs) -> Result<(Input, Vec<f64>), Failure> {
        let sequence = open(&self.file, &self.read.desc()?, global)?;
        let times = sequence.times().to_vec();
        Ok((self.input(sequence.into_cage()), times))
    }

    fn input(&self, cage: Cage) -> Input {
        let boundary = self.boundary.map(BoundaryRule::from).or(cage.boundary_rule()).unwrap_or_default();
        Input { cage, boundary }
    }

    /// The failure for a cage of which the boundary rule leaves nothing.
    pub(crate) fn require_faces(&self, input: &Input, drawn: &[bool]) -> Result<(), Failure> {
        if drawn.contains(&true) {
            return Ok(());
        }
        Err(self.refuse(EngineError::Plan(PlanError::NothingToDraw { faces: input.cage.face_count() })))
    }

    /// The failure for a cage that cannot become a surface.
    pub(crate) fn refuse(&self, error: EngineError) -> Failure {
        match error {
            // What the command line asks for, not the cage, is at fault.
            EngineError::Plan(PlanError::UnrefinedParts) => error.into(),
            EngineError::Plan(error) => Failure::input(format_args!("{}: {error}", self.file.display()))
                .with_hint("inspect says what the cage is made of"),
            EngineError::TooLarge { .. } => Failure::input(format_args!("{}: {error}", self.file.display())).with_hint(
                "render (of one picture), check and export work at such a cage in parts; other commands need the whole",
            ),
            other => other.into(),
        }
    }
}

/// Reads a cage, the first frame of a pattern, with a bar where that takes long.
pub(crate) fn read(file: &Path, desc: &ReadDesc, global: &GlobalArgs) -> Result<Cage, Failure> {
    if Sequence::is_pattern(file) {
        return open(file, desc, global).map(Sequence::into_cage);
    }
    let desc = ReadDesc { observer: Some(show_reading(global.quiet)), ..desc.clone() };
    Cage::read_with(file, &desc).map_err(|error| refusal(error, &desc))
}

/// Reads the first frame of a sequence, with a bar where that takes long.
fn open(file: &Path, desc: &ReadDesc, global: &GlobalArgs) -> Result<Sequence, Failure> {
    let desc = ReadDesc { observer: Some(show_reading(global.quiet)), ..desc.clone() };
    Sequence::open(file, &desc).map_err(|error| refusal(error, &desc))
}

/// A bar that stays as long as the observer. Reading writes nothing, so an interruption ends the process without asking it.
fn show_reading(quiet: bool) -> ReadObserver {
    let bar = Progress::in_stages(quiet);
    ReadObserver::new(move |ReadProgress { stage, done, total }| {
        bar.stage(stage.name(), done, total);
        ControlFlow::Continue(())
    })
}

/// Passes the warnings of a cage on.
pub(crate) fn warn(file: &Path, cage: &Cage) {
    for warning in cage.warnings() {
        tracing::warn!("{}: {warning}", file.display());
    }
    if cage.bounds().half_diagonal() == 0.0 {
        tracing::warn!("{}: all vertices are at the same place; the surface is a point", file.display());
    }
}

/// The failure for a file that is not read. Messages about what is in it say what to change.
fn refusal(error: ReadError, desc: &ReadDesc) -> Failure {
    if let Some(limit) = error.limit() {
        let option = match limit {
            LimitError::FileBytes { .. } => "--max-file-size",
            LimitError::Faces { .. } => "--max-faces",
            _ => "--max-memory",
        };
        return Failure::input(&error).with_hint(format_args!("{option} raises the limit"));
    }
    match error {
        ReadError::Io { .. } => Failure::unreadable(error),
        // These say what to do.
        ReadError::Sequence { .. } => Failure::input(error),
        ReadError::UnknownFormat { .. } => Failure::input(error).with_hint("convert the model to one of these formats"),
        ReadError::Refused { error: CageError::Topology(_), .. } if desc.repair.is_none() => {
            Failure::input(error).with_hint("correct the model, or let --repair make a manifold mesh of it")
        }
        ReadError::Refused { .. } => Failure::input(error)
            .with_hint("correct the model: a cage is a manifold mesh, and its tags name elements that exist"),
        _ => Failure::input(error).with_hint("correct the file there, or export the model again"),
    }
}
