//! How finely surfaces are tessellated.

use osculate_gpu::Device;

use crate::{Camera, EngineError};

/// How the tessellator places vertices on an edge; at level 3.5:
///
#[doc = include_str!("../doc/spacing.svg")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Spacing {
    /// Equal segments; a fractional level is rounded up.
    #[default]
    Equal,
    /// An odd number of segments, two of which grow from nothing as the level rises.
    Odd,
    /// An even number of segments, likewise.
    Even,
}

impl Spacing {
    /// The variant of evaluation shaders with this spacing.
    pub(crate) fn variant(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Odd => "odd",
            Self::Even => "even",
        }
    }
}

/// Tessellation factors of patch edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// The same level, 1 to 64, for all.
    Uniform(f32),
    /// As many segments as make edges of about `pixels` pixels in a picture of that height, 1 to 64.
    Adaptive {
        /// Length of a segment in pixels.
        pixels: f32,
        /// Where it is looked at from.
        camera: Camera,
        /// Height of the picture in pixels.
        height: u32,
    },
}

/// Who turns patches into triangles. Both evaluate the same formulas, and at equal parameters get equal points; the tessellator may place parameters a little
/// differently, and joins them in its own pattern.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Evaluator {
    /// The tessellator where the device can do what is asked with it, else compute.
    #[default]
    Auto,
    /// Tessellation stages of the graphics pipeline.
    Tessellator,
    /// Compute kernels that write vertices, shared between patches, for plain indexed draws.
    Compute,
}

/// How finely surfaces are tessellated, and by whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tessellation {
    /// Factors of patch edges.
    pub factors: Factors,
    /// Spacing of the vertices.
    pub spacing: Spacing,
    /// Who does it.
    pub evaluator: Evaluator,
}

impl Default for Tessellation {
    fn default() -> Self {
        Self { factors: Factors::Uniform(8.0), spacing: Spacing::Equal, evaluator: Evaluator::Auto }
    }
}

impl Tessellation {
    /// The same level for all edges, equally spaced.
    pub fn uniform(level: f32) -> Self {
        Self { factors: Factors::Uniform(level), ..Self::default() }
    }

    /// Whether compute kernels make pictures.
    pub(crate) fn renders_in_compute(&self, device: &Device) -> bool {
        match self.evaluator {
            Evaluator::Auto => !device.info().features.tessellation,
            Evaluator::Tessellator => false,
            Evaluator::Compute => true,
        }
    }

    /// Fails if the tessellator is asked for and there is none.
    pub(crate) fn check_evaluator(&self, device: &Device) -> Result<(), EngineError> {
        if self.renders_in_compute(device) || device.info().features.tessellation {
            return Ok(());
        }
        Err(EngineError::Unsupported {
            device: device.info().name.clone(),
            what: "tessellate: it has no tessellationShader".to_owned(),
            hint: "choose the compute evaluator, or another device".to_owned(),
        })
    }

    /// Most segments that an edge can get.
    pub(crate) fn max_segments(&self) -> Result<u32, EngineError> {
        match self.factors {
            Factors::Uniform(level) if (1.0..=64.0).contains(&level) => {
                let whole = level.ceil() as u32;
                Ok(match self.spacing {
                    Spacing::Equal => whole,
                    Spacing::Odd => (whole | 1).min(64),
                    Spacing::Even => whole + (whole & 1),
                })
            }
            Factors::Uniform(level) => Err(EngineError::Level { level }),
            Factors::Adaptive { .. } => Ok(64),
        }
    }
}
