//! `view`: a window.

use crate::args::GlobalArgs;
use crate::cache;
use crate::failure::{Failure, Verdict};
use crate::options::{DisplaceArgs, DrawEvaluator, Level, Pixels, ReadArgs, SchemeName, Size, SpacingArg};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use etcetera::{BaseStrategy, choose_base_strategy};
use osculate::{EngineError, Evaluator, Shade, Spacing};
use osculate_cage::Sequence;
use osculate_viewer::{CameraPose, Dress, LookDesc, ViewerDesc, ViewerError};
use std::path::PathBuf;

/// Look at surfaces in a window.
///
/// Turn them, switch scheme, level and shading while they are drawn, compare two schemes, move vertices of the cage, read frame
/// times. F1 shows the keys. Models can be dropped onto the window. What is chosen there is kept for the next run, unless
/// OSCULATE_SETTINGS names another file or is off.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ViewArgs {
    /// The control cages: .obj, .ply, .off, .gltf, .glb, .usd, or frames by a pattern as in render. N and P go from one to the next.
    #[arg(value_name = "FILES")]
    files: Vec<PathBuf>,

    /// How the surface is put together at first.
    #[arg(long, value_name = "SCHEME", help = SchemeName::help())]
    scheme: Option<SchemeName>,

    /// What the colours mean at first; docs/shading.md has pictures.
    #[arg(long, value_name = "SHADE", value_parser = shades())]
    shade: Option<Shade>,

    /// Segments per patch edge at first, from 1 to 64.
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    level: Option<Level>,

    /// Choose levels so that triangle edges are at most about this many pixels long.
    #[arg(long, value_name = "PX", allow_negative_numbers = true, conflicts_with = "level")]
    adaptive: Option<Pixels>,

    /// How a level that is not an integer is met at first.
    #[arg(long, value_name = "SPACING")]
    spacing: Option<SpacingArg>,

    /// Who evaluates the surface at first.
    #[arg(long, value_name = "EVALUATOR")]
    evaluator: Option<DrawEvaluator>,

    /// Draw the edges of the cage too.
    #[arg(long)]
    cage: bool,

    /// Look from EYE towards AT: three points or directions x,y,z in the units of the file, and the vertical angle of view in
    /// degrees. Y in the window prints this.
    #[arg(long, value_name = "EYE:AT:UP:FOVY", allow_hyphen_values = true)]
    camera: Option<CameraPose>,

    /// Size of the window. Default: that of the last run.
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    size: Option<Size>,

    /// Folder that screenshots go to. Default: the current one.
    #[arg(long, value_name = "FOLDER", default_value = ".", hide_default_value = true)]
    screenshots: PathBuf,

    /// For tests: say that the window is out of date in every frame of N.
    #[arg(long, value_name = "N", hide = true, value_parser = clap::value_parser!(u64).range(1..))]
    force_out_of_date: Option<u64>,

    /// For tests: say that the device is lost in this frame.
    #[arg(long, value_name = "N", hide = true)]
    lose_device: Option<u64>,

    /// The picture that the shade textured shows, in place of the model's own.
    #[arg(long, value_name = "PICTURE")]
    texture: Option<PathBuf>,

    #[command(flatten)]
    displace: DisplaceArgs,

    #[command(flatten)]
    read: ReadArgs,
}

/// Shades of the window.
const SHADES: [Shade; 14] = [
    Shade::Lit,
    Shade::Normals,
    Shade::Patches,
    Shade::Valence,
    Shade::Wireframe,
    Shade::Zebra,
    Shade::Reflection,
    Shade::Curvature,
    Shade::Gaussian,
    Shade::Factors,
    Shade::Textured,
    Shade::Uv,
    Shade::Difference,
    Shade::Leaks,
];

/// One of them by its name.
fn shades() -> impl TypedValueParser<Value = Shade> {
    let named = |name: String| SHADES.into_iter().find(|shade| shade.name() == name).ok_or("no such shade");
    PossibleValuesParser::new(SHADES.map(Shade::name)).try_map(named)
}

const EXAMPLES: &str = "\
Examples:
  osculate view assets/cages/*.obj
  osculate view creature.glb --shade zebra --scheme biseptic
  osculate view cube.obj --camera 2,1,3:0,0,0:0,1,0:30 --cage";

/// The variable that names another file for settings, or switches them off.
const SETTINGS: &str = "OSCULATE_SETTINGS";

impl ViewArgs {
    /// Checks what can be checked without a window.
    pub(crate) fn validate(self, global: &GlobalArgs) -> Result<ViewerDesc, Failure> {
        for file in self.files.iter().filter(|file| !Sequence::is_pattern(file)) {
            let reason = std::fs::metadata(file).err().map(|error| format!("{}: {error}", file.display()));
            reason.map_or(Ok(()), |reason| Err(Failure::unreadable(reason)))?;
        }
        let scheme = self.scheme.map(SchemeName::in_this_build).transpose()?;
        Ok(ViewerDesc {
            look: LookDesc {
                scheme,
                evaluator: self.evaluator.map(Evaluator::from),
                level: self.level.map(Level::get),
                adaptive: self.adaptive.map(Pixels::get),
                spacing: self.spacing.map(Spacing::from),
                shade: self.shade,
                cage: self.cage.then_some(true),
            },
            dress: Some(dress(self.displace, self.texture)),
            files: self.files,
            read: self.read.desc()?,
            device: global.device.clone(),
            validation: global.validation,
            camera: self.camera,
            size: self.size.map(|size| [size.width, size.height]),
            settings: settings(),
            pipeline_cache: cache::folder(),
            screenshots: self.screenshots,
            force_out_of_date: self.force_out_of_date,
            lose_device: self.lose_device,
        })
    }
}

/// What gives surfaces their maps.
fn dress(displace: DisplaceArgs, texture: Option<PathBuf>) -> Dress {
    Dress::new(texture.is_some(), move |surface, cage, file, shade| {
        let maps = displace.load(cage).and_then(|maps| maps.for_shade(shade, texture.as_deref(), cage));
        maps.and_then(|maps| maps.apply(surface, cage, file)).map_err(|failure| failure.sentence())
    })
}

/// The file that settings are kept in.
fn settings() -> Option<PathBuf> {
    match std::env::var_os(SETTINGS) {
        Some(value) if value.is_empty() || value.eq_ignore_ascii_case("off") => None,
        Some(value) => Some(PathBuf::from(value)),
        None => choose_base_strategy().ok().map(|strategy| strategy.config_dir().join("osculate").join("viewer.json")),
    }
}

/// Opens the window, and waits until it is closed.
pub(crate) fn run(desc: ViewerDesc) -> Result<Verdict, Failure> {
    osculate_viewer::run(desc)?;
    Ok(Verdict::Pass)
}

impl From<ViewerError> for Failure {
    fn from(error: ViewerError) -> Self {
        match error {
            ViewerError::NoDisplay { .. } => Self::device(error).with_hint(
                "set DISPLAY or WAYLAND_DISPLAY to a running window system, or use render, which needs none",
            ),
            ViewerError::Device(error) => error.into(),
            ViewerError::Gpu(error) => EngineError::from(error).into(),
            ViewerError::Engine(error) => error.into(),
            ViewerError::Validation { .. } => Self::device(error),
            _ => Self::device(error).with_hint("another --device or a newer driver may do it; -v says more"),
        }
    }
}
