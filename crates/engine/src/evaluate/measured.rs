//! What the compute evaluator's vertices hold.

use osculate_shaders::constant;

use crate::Shade;
use crate::draw::Output;
use crate::grid::Layout;

/// What vertices hold beside position and normal: few shades differ there, so that kernels do not multiply by shades. Unless it is nothing, the number of the
/// patch comes with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Measured {
    /// Nothing.
    Nothing,
    /// (u,v) as it is: of vertices that are not drawn.
    Parameters,
    /// What patches are outlined by.
    Outline,
    /// Mean and Gaussian curvature.
    Curvature,
    /// Width of the triangles in pixels.
    Width,
    /// Segments across the patch.
    Segments,
    /// Texture coordinates.
    Texture,
}

impl Measured {
    /// What the fragments of an output look at.
    pub(crate) fn of(output: Output) -> Self {
        match output {
            Output::Fill(_, shade, _) if shade.layout() == Layout::Shared => Self::Nothing,
            Output::Fill(_, shade, _) | Output::Material(_, shade) => Self::of_patch(shade),
            Output::Lines(_) => Self::Width,
            Output::Capture => Self::Parameters,
        }
    }

    fn of_patch(shade: Shade) -> Self {
        match shade {
            Shade::Curvature | Shade::Gaussian => Self::Curvature,
            Shade::Wireframe => Self::Width,
            Shade::Factors => Self::Segments,
            Shade::Textured | Shade::Uv => Self::Texture,
            _ => Self::Outline,
        }
    }

    /// Bytes of a vertex.
    pub(super) fn vertex_bytes(self) -> u64 {
        let vectors = if self == Self::Nothing { constant::GRID_PLACE_VECTORS } else { constant::GRID_VERTEX_VECTORS };
        12 * u64::from(vectors)
    }

    /// Whether it follows from the whole patch, its formula or how it is divided, on its border too (`shade_measures_patch` in
    /// shaders/include/measure.glsl).
    pub(super) fn takes_patch(self) -> bool {
        matches!(self, Self::Curvature | Self::Width | Self::Segments)
    }

    /// A shade that measures this.
    pub(crate) fn shade(self) -> u32 {
        match self {
            Self::Nothing => constant::SHADE_LIT,
            Self::Parameters => constant::SHADE_NONE,
            Self::Outline => constant::SHADE_PATCHES,
            Self::Curvature => constant::SHADE_CURVATURE,
            Self::Width => constant::SHADE_WIREFRAME,
            Self::Segments => constant::SHADE_FACTORS,
            Self::Texture => constant::SHADE_UV,
        }
    }

    /// The name for tools.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Nothing => "places",
            Self::Parameters => "parameters",
            Self::Outline => "outline",
            Self::Curvature => "curvature",
            Self::Width => "width",
            Self::Segments => "segments",
            Self::Texture => "texture",
        }
    }
}
