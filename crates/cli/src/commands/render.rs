//! `render`: a picture, or one for each frame of an animation.

use crate::args::GlobalArgs;
use crate::device::with_engine;
use crate::failure::{Failure, Verdict};
use crate::input::InputArgs;
use crate::options::{
    AnimationArgs, CameraArgs, Colour, CullArg, DisplaceArgs, Maps, NumberedPath, Output, PartsArgs, RefineArg,
    SchemeName, TessellationArgs,
};
use crate::progress::Progress;
use clap::{Args, ValueEnum};
use osculate::{RenderDesc, Scheme, Shade};
use osculate_cage::{Bounds, Cage};
use std::path::PathBuf;

mod film;
mod scene;

/// Draw the surface to a PNG file, or an animation to numbered ones.
///
/// No window is needed. Without options the whole cage is shown, lit, in 1024 x 1024 pixels.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    input: InputArgs,

    /// The picture to write; for --frames with the place of the number in its name, such as frame_%04d.png.
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,

    /// How the surface is put together.
    #[arg(long, alias = "schemes", value_name = "SCHEME", default_value = "gregory2", help = SchemeName::help())]
    scheme: SchemeName,

    /// Which faces of the cage are refined.
    #[arg(long, value_name = "FACES", default_value = "everywhere")]
    refine: RefineArg,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    tessellation: TessellationArgs,

    #[command(flatten)]
    displace: DisplaceArgs,

    #[command(flatten)]
    camera: CameraArgs,

    #[command(flatten)]
    animation: AnimationArgs,

    #[command(flatten)]
    parts: PartsArgs,
}

/// What the picture looks like.
#[derive(Args, Debug)]
#[command(next_help_heading = "Look")]
struct LookArgs {
    /// What the colours mean; docs/shading.md has pictures and the full legends.
    #[arg(long, value_name = "SHADE", default_value = "lit")]
    shade: ShadeArg,

    /// For the shade difference: the scheme that distances are measured to. Default: stam, the exact surface.
    #[arg(long, value_name = "SCHEME")]
    against: Option<SchemeName>,

    /// For the shade difference: the distance at which the colours end, in the cage's units. Default: the largest.
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = length)]
    range: Option<f64>,

    /// For the shade textured: the picture to show, PNG or JPEG. Default: that of the model's own material.
    #[arg(long, value_name = "IMAGE")]
    texture: Option<PathBuf>,

    /// Draw the edges of the cage too.
    #[arg(long)]
    cage: bool,

    /// Samples per pixel, which smooth the outlines: 1, 2, 4 or 8, as far as the device has them. Default: 4, for the
    /// shade peer 1.
    #[arg(long, value_name = "N", value_parser = samples, allow_negative_numbers = true)]
    samples: Option<u32>,

    /// What is left out: patches before they are tessellated, and triangles that show their backs. The picture stays the same, but for the backs.
    #[arg(long, value_name = "WHAT", default_value = "none")]
    cull: CullArg,

    /// Colour behind the surface: #RRGGBB, #RRGGBBAA, black, white or transparent. Default: dark grey.
    #[arg(long, value_name = "COLOUR")]
    background: Option<Colour>,
}

/// Names of the shades.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ShadeArg {
    /// Porcelain under three lights; the inside of an open surface is blue-grey.
    Lit,
    /// The unit normal as a colour: red, green, blue are 0.5 + 0.5 n.
    Normals,
    /// The patches by kind: off-white and blue are bicubic and exact, other colours are the scheme's patches by valence.
    Patches,
    /// The patches by the valence of their irregular vertex; paler where regular at a boundary.
    Valence,
    /// Lit, with the edges of the triangles that the tessellator made.
    Wireframe,
    /// Reflected stripes: they break where the surface has an edge, and kink where curvature jumps.
    Zebra,
    /// Mirrored light tubes, thin and parallel: lines break at edges, kink where curvature jumps, and waver where it does.
    Reflection,
    /// Mean curvature: white is flat, red bulges, blue is hollow.
    Curvature,
    /// Gaussian curvature: white is flat or bent one way only, orange is a dome or a bowl, violet a saddle.
    Gaussian,
    /// How finely patches are divided: segments across them, from off-white for 1 over orange for 8 to dark violet for 64.
    Factors,
    /// A two-sided headlight without sRGB encoding, for comparisons with other renderers.
    Peer,
    /// The distance to another scheme at the same places: off-white is none, dark violet the largest, which is printed.
    Difference,
    /// Lit, in the colours of the model's material or of --texture.
    Textured,
    /// Squares in the plane of texture coordinates, sixteen along a unit, redder with u and greener with v.
    Uv,
}

impl From<ShadeArg> for Shade {
    fn from(arg: ShadeArg) -> Self {
        match arg {
            ShadeArg::Lit => Self::Lit,
            ShadeArg::Normals => Self::Normals,
            ShadeArg::Patches => Self::Patches,
            ShadeArg::Valence => Self::Valence,
            ShadeArg::Wireframe => Self::Wireframe,
            ShadeArg::Zebra => Self::Zebra,
            ShadeArg::Reflection => Self::Reflection,
            ShadeArg::Curvature => Self::Curvature,
            ShadeArg::Gaussian => Self::Gaussian,
            ShadeArg::Factors => Self::Factors,
            ShadeArg::Peer => Self::Peer,
            ShadeArg::Textured => Self::Textured,
            ShadeArg::Uv => Self::Uv,
            ShadeArg::Difference => Self::Difference,
        }
    }
}

const EXAMPLES: &str = "\
Examples:
  osculate render cube.obj -o cube.png
  osculate render cube.obj -o cube.png --shade patches --cage --size 800x600
  osculate render cube.obj -o far.png --shade difference --against stam
  osculate render walk.glb -o step.png --time 0.4
  osculate render walk.glb -o frame_%04d.png --frames 0..23 --fps 24
  osculate render 'walk_####.obj' -o frame_%04d.png --frames 1..120
  osculate render cube.obj -o close.png --camera 2,1,3:0,0,0:0,1,0:30 --adaptive 6 --background white";

/// Grey of the shade `peer`, the same number in all channels of a picture without sRGB encoding.
const PEER_BACKGROUND: [f32; 4] = [0.1, 0.1, 0.1, 1.0];

fn length(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|&length: &f64| length.is_finite() && length > 0.0)
        .ok_or_else(|| "expected a length greater than 0".into())
}

fn samples(text: &str) -> Result<u32, String> {
    text.parse().ok().filter(|n| [1, 2, 4, 8].contains(n)).ok_or_else(|| "expected 1, 2, 4 or 8".into())
}

/// A picture that can be asked for.
pub(crate) struct Job {
    input: InputArgs,
    output: Output<()>,
    /// Where the pictures of a sequence go.
    numbered: Option<NumberedPath>,
    scheme: Scheme,
    refine: RefineArg,
    /// What the shade difference compares with.
    against: Option<Scheme>,
    /// What the shade textured shows, if not the model's own material.
    texture: Option<PathBuf>,
    look: LookArgs,
    tessellation: TessellationArgs,
    displace: DisplaceArgs,
    camera: CameraArgs,
    animation: AnimationArgs,
    parts: PartsArgs,
}

impl RenderArgs {
    /// Checks the scheme and the place of the output.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        let numbered = self.animation.is_sequence().then(|| NumberedPath::new(&self.output)).transpose()?;
        Ok(Job {
            numbered,
            output: Output::new(self.output, &[("png", ())])?.apart_from([self.input.file.as_path()])?,
            scheme: self.scheme.in_this_build()?,
            refine: self.refine,
            against: self.look.against()?,
            texture: self.look.texture()?,
            input: self.input,
            look: self.look,
            tessellation: self.tessellation,
            displace: self.displace,
            camera: self.camera,
            animation: self.animation,
            parts: self.parts,
        })
    }
}

impl LookArgs {
    /// The picture of the shade textured, for that shade alone.
    fn texture(&self) -> Result<Option<PathBuf>, Failure> {
        if self.texture.is_some() && !matches!(self.shade, ShadeArg::Textured) {
            return Err(Failure::usage("--texture is for the shade textured alone").with_hint("add --shade textured"));
        }
        Ok(self.texture.clone())
    }

    /// The scheme that the shade difference compares with, for that shade alone.
    fn against(&self) -> Result<Option<Scheme>, Failure> {
        if matches!(self.shade, ShadeArg::Difference) {
            return Ok(Some(self.against.unwrap_or(SchemeName::Stam).in_this_build()?));
        }
        let option = self.against.map(|_| "--against").or(self.range.map(|_| "--range"));
        match option {
            Some(option) => Err(Failure::usage(format_args!("{option} is for the shade difference alone"))
                .with_hint("add --shade difference")),
            None => Ok(None),
        }
    }
}

impl Job {
    /// The pictures that the surface is mapped with.
    fn maps(&self, cage: &Cage) -> Result<Maps, Failure> {
        self.displace.load(cage)?.for_shade(self.look.shade.into(), self.texture.as_deref(), cage)
    }
}

/// Draws and writes the picture, or those of a sequence.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let _progress = (!job.animation.is_sequence()).then(|| Progress::waiting(global.quiet, "drawing"));
    if job.animation.is_film() {
        let frames = job.input.read_frames(job.animation.rate(), global)?;
        let film = job.animation.film(&job.input.file, &frames.1)?;
        with_engine(global, |engine| job.draw_film(engine, &frames, &film, global))?;
    } else {
        let input = job.input.read(global)?;
        with_engine(global, |engine| job.draw_still(engine, &input, global))?;
    }
    Ok(Verdict::Pass)
}

impl Job {
    /// What a picture of a cage in this box is like.
    fn desc(&self, bounds: Bounds) -> Result<RenderDesc, Failure> {
        let camera = self.camera.camera(bounds)?;
        let size = [self.camera.size.width, self.camera.size.height];
        let default = RenderDesc::fit_box(bounds, size);
        let shade = Shade::from(self.look.shade);
        let is_peer = shade == Shade::Peer;
        let default_background = if is_peer { PEER_BACKGROUND } else { default.background };
        let encoded = |colour: Colour| if is_peer { colour.plain() } else { colour.linear() };
        Ok(RenderDesc {
            camera,
            tessellation: self.tessellation.tessellation(&self.camera, bounds)?,
            shade,
            cage: self.look.cage,
            samples: self.look.samples.unwrap_or(if is_peer { 1 } else { default.samples }),
            culling: self.look.cull.into(),
            background: self.look.background.map_or(default_background, encoded),
            ..default
        })
    }
}
