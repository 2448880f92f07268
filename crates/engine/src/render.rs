//! Pictures.

use osculate_cage::{Bounds, Cage};
use osculate_shaders::constant;

use crate::canvas::Canvas;
use crate::{Camera, Culling, Engine, EngineError, Surface, Tessellation};

/// What the colours of a picture mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shade {
    /// Porcelain under three lights; the inside of an open surface is blue-grey.
    #[default]
    Lit,
    /// The normal as a colour.
    Normals,
    /// Patches by kind.
    Patches,
    /// Patches by the valence of their corner.
    Valence,
    /// Lit, with the edges of the triangles.
    Wireframe,
    /// Reflected stripes.
    Zebra,
    /// Mirrored light tubes: reflection lines.
    Reflection,
    /// Mean curvature.
    Curvature,
    /// Gaussian curvature.
    Gaussian,
    /// How finely patches are divided: segments across them.
    Factors,
    /// The two-sided headlight of comparisons with other renderers, without sRGB encoding.
    Peer,
    /// The distance to another surface of the same cage: [`crate::render_difference`] draws it.
    Difference,
    /// Lit, in the colours of [`crate::Coloring`]; for surfaces with maps.
    Textured,
    /// Squares in the plane of texture coordinates, sixteen along a unit; for surfaces with maps.
    Uv,
    /// Dim from outside, magenta from inside: before a background of that colour every hole of a closed surface stands out.
    Leaks,
}

impl Shade {
    /// All that show one surface for its own sake, whatever it is made of: [`Self::Textured`] and [`Self::Uv`] need maps, [`Self::Leaks`] looks for
    /// defects.
    pub const ALL: &'static [Self] = &[
        Self::Lit,
        Self::Normals,
        Self::Patches,
        Self::Valence,
        Self::Wireframe,
        Self::Zebra,
        Self::Reflection,
        Self::Curvature,
        Self::Gaussian,
        Self::Factors,
        Self::Peer,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lit => "lit",
            Self::Normals => "normals",
            Self::Patches => "patches",
            Self::Valence => "valence",
            Self::Wireframe => "wireframe",
            Self::Zebra => "zebra",
            Self::Reflection => "reflection",
            Self::Curvature => "curvature",
            Self::Gaussian => "gaussian",
            Self::Factors => "factors",
            Self::Peer => "peer",
            Self::Difference => "difference",
            Self::Textured => "textured",
            Self::Uv => "uv",
            Self::Leaks => "leaks",
        }
    }

    /// Whether it shows texture coordinates.
    pub fn is_mapped(self) -> bool {
        matches!(self, Self::Textured | Self::Uv)
    }

    /// What its fragments look at.
    pub(crate) fn seen(self) -> Seen {
        match self {
            Self::Peer => Seen::Normal,
            Self::Lit | Self::Normals | Self::Zebra | Self::Reflection | Self::Leaks | Self::Wireframe => {
                Seen::Position
            }
            _ => Seen::Patch,
        }
    }

    /// The number by which shaders know it.
    pub(crate) fn constant(self) -> u32 {
        match self {
            Self::Lit => constant::SHADE_LIT,
            Self::Normals => constant::SHADE_NORMALS,
            Self::Patches => constant::SHADE_PATCHES,
            Self::Valence => constant::SHADE_VALENCE,
            Self::Wireframe => constant::SHADE_WIREFRAME,
            Self::Zebra => constant::SHADE_ZEBRA,
            Self::Reflection => constant::SHADE_REFLECTION,
            Self::Curvature => constant::SHADE_CURVATURE,
            Self::Gaussian => constant::SHADE_GAUSSIAN,
            Self::Factors => constant::SHADE_FACTORS,
            Self::Peer => constant::SHADE_PEER,
            Self::Difference => constant::SHADE_DIFFERENCE,
            Self::Textured => constant::SHADE_TEXTURED,
            Self::Uv => constant::SHADE_UV,
            Self::Leaks => constant::SHADE_LEAKS,
        }
    }
}

/// What fragments look at: vertices hold no more where less is enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Seen {
    /// Normals alone.
    Normal,
    /// Positions too.
    Position,
    /// All of that, the patch, and what is measured on it.
    Patch,
}

impl Seen {
    /// The word in names of shaders.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Position => "position",
            Self::Patch => "",
        }
    }
}

/// What a picture shows.
#[derive(Clone, Copy, Debug)]
pub struct RenderDesc {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Where from.
    pub camera: Camera,
    /// How finely.
    pub tessellation: Tessellation,
    /// In which colours.
    pub shade: Shade,
    /// Whether the edges of the cage are drawn over it.
    pub cage: bool,
    /// Samples per pixel.
    pub samples: u32,
    /// What is left out because nothing of it is seen.
    pub culling: Culling,
    /// Background, linear RGBA, alpha not multiplied in.
    pub background: [f32; 4],
}

/// Dark slate, sRGB (49, 54, 62).
const BACKGROUND: [f32; 4] = [0.0307, 0.0369, 0.0482, 1.0];
impl RenderDesc {
    /// The whole cage from its upper right front, lit, at four samples a pixel.
    pub fn fit(cage: &Cage, size: [u32; 2]) -> Self {
        Self::fit_box(cage.bounds(), size)
    }

    /// The same for whatever is in a box: a cage in a pose.
    pub fn fit_box(bounds: Bounds, size: [u32; 2]) -> Self {
        Self {
            size,
            camera: Camera::fit(bounds),
            tessellation: Tessellation::default(),
            shade: Shade::Lit,
            cage: false,
            samples: 4,
            culling: Culling::NONE,
            background: BACKGROUND,
        }
    }
}

/// A picture: rows from the top, four bytes a pixel (red, green, blue, alpha), sRGB but for [`Shade::Peer`]. Alpha is not multiplied in: a pixel half covered
/// by the surface before a transparent background has the surface's colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The pixels.
    pub rgba: Vec<u8>,
}

/// Draws surfaces. All must be of one engine.
///
/// # Errors
/// If the level is out of range, the shade takes two surfaces, the picture has no pixels, it or the number of samples exceeds what the device can do, or the device fails.
pub fn render(engine: &Engine, surfaces: &[&Surface], desc: &RenderDesc) -> Result<Picture, EngineError> {
    if desc.shade == Shade::Difference {
        return Err(EngineError::OneSurface);
    }
    let mut canvas = Canvas::new(engine, desc)?;
    canvas.prepare(surfaces)?;
    for surface in surfaces {
        canvas.add(surface)?;
    }
    canvas.finish()
}
