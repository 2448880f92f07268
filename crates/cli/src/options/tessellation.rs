//! How finely the surface is cut into triangles.

use super::{CameraArgs, Level, Pixels};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use osculate::{Evaluator, Factors, Spacing, Tessellation};
use osculate_cage::Bounds;

/// Options of commands that draw at one level.
#[derive(Args, Debug)]
#[command(next_help_heading = "Tessellation")]
pub(crate) struct TessellationArgs {
    /// Segments per patch edge, a real number from 1 to 64. An edge of the cage's quads carries two patch edges.
    #[arg(long, value_name = "L", default_value = "8", allow_negative_numbers = true)]
    level: Level,

    /// How a level that is not an integer is met.
    #[arg(long, value_name = "SPACING", default_value = "equal")]
    spacing: SpacingArg,

    /// Choose levels so that triangle edges are at most about this many pixels long in the camera's picture; --level is
    /// ignored.
    #[arg(long, value_name = "PX", allow_negative_numbers = true)]
    adaptive: Option<Pixels>,

    /// Who evaluates the surface.
    #[arg(long, value_name = "EVALUATOR", default_value = "auto")]
    evaluator: DrawEvaluator,
}

impl TessellationArgs {
    /// The tessellation for a cage with this box.
    pub(crate) fn tessellation(&self, camera: &CameraArgs, bounds: Bounds) -> Result<Tessellation, Failure> {
        let factors = match self.adaptive {
            Some(pixels) => adaptive(pixels, camera, bounds)?,
            None => Factors::Uniform(self.level.get()),
        };
        Ok(Tessellation { factors, spacing: self.spacing.into(), evaluator: self.evaluator.into() })
    }
}

/// Factors that make edges of so many pixels in the camera's picture.
fn adaptive(pixels: Pixels, camera: &CameraArgs, bounds: Bounds) -> Result<Factors, Failure> {
    let (pixels, height) = (pixels.get(), camera.size.height);
    Ok(Factors::Adaptive { pixels, camera: camera.camera(bounds)?, height })
}

/// Names of the spacings.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SpacingArg {
    /// Segments of equal length; the level is rounded up to an integer.
    Equal,
    /// An odd number of segments, at most 63, two of which grow from nothing: moves smoothly with the level.
    Odd,
    /// An even number of segments, at least 2, two of which grow from nothing: moves smoothly too.
    Even,
}

impl SpacingArg {
    /// The name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Odd => "odd",
            Self::Even => "even",
        }
    }
}

impl From<SpacingArg> for Spacing {
    fn from(arg: SpacingArg) -> Self {
        match arg {
            SpacingArg::Equal => Self::Equal,
            SpacingArg::Odd => Self::Odd,
            SpacingArg::Even => Self::Even,
        }
    }
}

/// Evaluators that can draw.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum DrawEvaluator {
    /// The tessellator where the device can do what is asked with it, else compute.
    Auto,
    /// The tessellation stages of the graphics pipeline.
    Tessellator,
    /// Compute kernels, and plain indexed triangles; equal points at equal parameters.
    Compute,
}

impl From<DrawEvaluator> for Evaluator {
    fn from(arg: DrawEvaluator) -> Self {
        match arg {
            DrawEvaluator::Auto => Self::Auto,
            DrawEvaluator::Tessellator => Self::Tessellator,
            DrawEvaluator::Compute => Self::Compute,
        }
    }
}
