//! Pictures.

use osculate_cage::Cage;
use osculate_gpu::{
    BufferDesc, BufferUsage, ColorTarget, DepthTarget, Draw, Format, Image, ImageDesc, ImageUsage, Memory, Recording,
    RenderPass,
};
use osculate_shaders::{binding, constant};

use crate::alpha::{alpha_multiplied_in, divide_alpha_out};
use crate::draw::{DEPTH_FORMAT, Output, PipelineKey, Target, runs};
use crate::frame::FrameDesc;
use crate::{Camera, Engine, EngineError, Surface, Tessellation};

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
    /// Mean curvature.
    Curvature,
    /// The two-sided headlight of comparisons with other renderers, without sRGB encoding.
    Peer,
}

impl Shade {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::Lit,
        Self::Normals,
        Self::Patches,
        Self::Valence,
        Self::Wireframe,
        Self::Zebra,
        Self::Curvature,
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
            Self::Curvature => "curvature",
            Self::Peer => "peer",
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
            Self::Curvature => constant::SHADE_CURVATURE,
            Self::Peer => constant::SHADE_PEER,
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
    /// Background, linear RGBA, alpha not multiplied in.
    pub background: [f32; 4],
}

/// Dark slate, sRGB (49, 54, 62).
const BACKGROUND: [f32; 4] = [0.0307, 0.0369, 0.0482, 1.0];
/// Edges of triangles.
const WIRE: [f32; 4] = [0.012, 0.014, 0.020, 0.85];
/// Edges of the cage, orange.
const CAGE: [f32; 4] = [0.90, 0.27, 0.035, 1.0];
/// How much of them shines through the surface.
const CAGE_BEHIND: f32 = 0.18;

impl RenderDesc {
    /// The whole cage from its upper right front, lit, at four samples a pixel.
    pub fn fit(cage: &Cage, size: [u32; 2]) -> Self {
        Self {
            size,
            camera: Camera::fit(cage.bounds()),
            tessellation: Tessellation::default(),
            shade: Shade::Lit,
            cage: false,
            samples: 4,
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
/// If the level is out of range, the picture has no pixels, it or the number of samples exceeds what the device can do, or the device fails.
pub fn render(engine: &Engine, surfaces: &[&Surface], desc: &RenderDesc) -> Result<Picture, EngineError> {
    check_wireframe(engine, desc.shade)?;
    let targets = Targets::new(engine, desc)?;
    engine.prepare([], surfaces.iter().flat_map(|surface| pipelines(surface, desc, targets.target)))?;
    let mut draws = Vec::new();
    for surface in surfaces {
        add_surface(surface, desc, targets.target, &mut draws)?;
    }
    let mut recording = Recording::new();
    recording.render(targets.pass(desc, draws));
    let [width, height] = desc.size;
    let size = u64::from(width) * u64::from(height) * 4;
    let (usage, memory) = (BufferUsage::STORAGE, Memory::Readback);
    let pixels = engine.device().buffer(&BufferDesc { name: "picture", size, usage, memory })?;
    recording.copy_image_to_buffer(targets.result(), &pixels);
    engine.device().run(&recording)?;
    let mut rgba = pixels.read(0..size)?;
    if desc.background[3] < 1.0 {
        divide_alpha_out(&mut rgba, targets.target.color);
    }
    Ok(Picture { size: desc.size, rgba })
}

/// What becomes of the patches in a picture.
fn outputs(desc: &RenderDesc, target: Target) -> impl Iterator<Item = Output> {
    let lines = (desc.shade == Shade::Wireframe).then_some(Output::Lines(target));
    std::iter::once(Output::Fill(target)).chain(lines)
}

/// All pipelines that a surface is drawn with.
fn pipelines(surface: &Surface, desc: &RenderDesc, target: Target) -> impl Iterator<Item = PipelineKey> {
    let patches = outputs(desc, target).flat_map(|output| surface.pipelines(desc.tessellation.spacing, output));
    let cage = desc.cage.then_some([false, true].map(|hidden| PipelineKey::Cage { target, hidden }));
    patches.chain(cage.into_iter().flatten())
}

fn add_surface(surface: &Surface, desc: &RenderDesc, target: Target, draws: &mut Vec<Draw>) -> Result<(), EngineError> {
    let device = surface.engine().device();
    let frame = |line_color| FrameDesc {
        space: surface.space(),
        radius: surface.radius(),
        tessellation: &desc.tessellation,
        view: Some((&desc.camera, desc.size)),
        shade: desc.shade,
        line_color,
    };
    let bindings = surface.buffers().patches.clone().with(binding::FRAME, &frame(WIRE).upload(device)?);
    let longest = surface.engine().patches_per_draw(desc.tessellation.max_segments()?);
    for output in outputs(desc, target) {
        for run in runs(&surface.plan().lists, longest) {
            draws.push(surface.draw(run, &bindings, &desc.tessellation, output)?);
        }
    }
    if desc.cage {
        for (hidden, opacity) in [(true, CAGE_BEHIND), (false, 1.0)] {
            let [r, g, b, _] = CAGE;
            let frame = frame([r, g, b, opacity]).upload(device)?;
            draws.push(Draw {
                pipeline: surface.engine().pipeline(PipelineKey::Cage { target, hidden })?,
                bindings: surface.buffers().cage_edges.clone().with(binding::FRAME, &frame),
                push: Vec::new(),
                vertices: (0..2 * surface.cage_edge_count()).into(),
                instances: 0..1,
            });
        }
    }
    Ok(())
}

fn check_wireframe(engine: &Engine, shade: Shade) -> Result<(), EngineError> {
    let info = engine.device().info();
    if shade != Shade::Wireframe || info.features.wireframe {
        return Ok(());
    }
    Err(EngineError::Unsupported {
        device: info.name.clone(),
        what: "draw the edges of triangles".to_owned(),
        hint: "choose another shade".to_owned(),
    })
}

fn check_size(engine: &Engine, [width, height]: [u32; 2]) -> Result<(), EngineError> {
    if width > 0 && height > 0 {
        return Ok(());
    }
    Err(EngineError::Unsupported {
        device: engine.device().info().name.clone(),
        what: format!("draw a picture of {width}x{height} pixels"),
        hint: "give it at least one pixel each way".to_owned(),
    })
}

/// Images that a picture is drawn to.
struct Targets {
    target: Target,
    color: Image,
    depth: Image,
    /// Receives the average of the samples, if there are several.
    resolved: Option<Image>,
}

impl Targets {
    fn new(engine: &Engine, desc: &RenderDesc) -> Result<Self, EngineError> {
        let limits = &engine.device().info().limits;
        check_size(engine, desc.size)?;
        if !limits.sample_counts.contains(&desc.samples) {
            return Err(EngineError::Unsupported {
                device: engine.device().info().name.clone(),
                what: format!("draw {} samples per pixel", desc.samples),
                hint: format!("it can do {:?}", limits.sample_counts),
            });
        }
        let color = if desc.shade == Shade::Peer { Format::Rgba8Unorm } else { Format::Rgba8Srgb };
        let image = |name: &str, format, samples, usage| {
            engine.device().image(&ImageDesc { name, size: desc.size, format, samples, usage })
        };
        let (drawn, read) = (ImageUsage::TARGET, ImageUsage::TARGET | ImageUsage::COPY_SRC);
        let several = desc.samples > 1;
        Ok(Self {
            target: Target { color, samples: desc.samples },
            color: image("colour", color, desc.samples, if several { drawn } else { read })?,
            depth: image("depth", DEPTH_FORMAT, desc.samples, drawn)?,
            resolved: if several { Some(image("resolved colour", color, 1, read)?) } else { None },
        })
    }

    fn result(&self) -> &Image {
        self.resolved.as_ref().unwrap_or(&self.color)
    }

    fn pass(&self, desc: &RenderDesc, draws: Vec<Draw>) -> RenderPass {
        RenderPass {
            name: "picture".to_owned(),
            color: Some(ColorTarget {
                image: self.color.clone(),
                clear: Some(alpha_multiplied_in(desc.background)),
                resolve: self.resolved.clone(),
            }),
            depth: Some(DepthTarget { image: self.depth.clone(), clear: Some(1.0) }),
            size: desc.size,
            draws,
        }
    }
}
