//! How finely the surface is cut into triangles.

use super::{CameraArgs, Level, Pixels};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use osculate::{Factors, Spacing, Tessellation};
use osculate_cage::Bounds;

/// Options of commands that draw at one level.
#[derive(Args, Debug)]
#[command(next_help_heading = "Tessellation")]
pub(crate) struct TessellationArgs {
    /// Segments per patch edge, a real number from 1 to 64. An edge of the cage's quads carries two patch edges.
    #[arg(long, value_name = "L", default_value = "8")]
    level: Level,

    /// How a level that is not an integer is met.
    #[arg(long, value_name = "SPACING", default_value = "equal")]
    spacing: SpacingArg,

    /// Choose levels so that triangle edges are about this many pixels long in the camera's picture; --level is
    /// ignored.
    #[arg(long, value_name = "PX")]
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
        Ok(Tessellation { factors, spacing: self.spacing.into() })
    }
}

/// Factors that make edges of so many pixels in the camera's picture.
pub(crate) fn adaptive(pixels: Pixels, camera: &CameraArgs, bounds: Bounds) -> Result<Factors, Failure> {
    let (pixels, height) = (pixels.get(), camera.size.height);
    Ok(Factors::Adaptive { pixels, camera: camera.camera(bounds)?, height })
}

/// Names of the spacings.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SpacingArg {
    /// Segments of equal length; the level is rounded up.
    Equal,
    /// An odd number of segments, two of which grow from nothing: moves smoothly with the level.
    Odd,
    /// An even number of segments, two of which grow from nothing.
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
    /// The best for the device; in this build the tessellator.
    Auto,
    /// The tessellation stages of the graphics pipeline.
    Tessellator,
}
