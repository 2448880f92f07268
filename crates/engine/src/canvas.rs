//! Drawing surfaces into images.

use osculate_gpu::{
    Buffer, BufferDesc, BufferUsage, ColorTarget, DepthTarget, Draw, Format, Image, ImageDesc, ImageUsage, Memory,
    Recording, RenderPass,
};
use osculate_shaders::binding;

use crate::alpha::{alpha_multiplied_in, divide_alpha_out};
use crate::draw::{DEPTH_FORMAT, Output, PipelineKey, Target, runs};
use crate::evaluate::{GridChunk, Grids};
use crate::frame::FrameDesc;
use crate::grid::Layout;
use crate::{Engine, EngineError, Picture, RenderDesc, Shade, Surface};

/// Edges of triangles.
const WIRE: [f32; 4] = [0.012, 0.014, 0.020, 0.85];
/// Edges of the cage, orange.
const CAGE: [f32; 4] = [0.90, 0.27, 0.035, 1.0];
/// How much of them shines through the surface.
const CAGE_BEHIND: f32 = 0.18;

/// A picture in the making.
pub(crate) struct Canvas<'a> {
    engine: &'a Engine,
    desc: &'a RenderDesc,
    targets: Targets,
    /// Draws of the next pass.
    draws: Vec<Draw>,
    /// Whether a pass has begun the picture.
    begun: bool,
}

impl<'a> Canvas<'a> {
    /// An empty picture.
    pub(crate) fn new(engine: &'a Engine, desc: &'a RenderDesc) -> Result<Self, EngineError> {
        let info = engine.device().info();
        if desc.shade == Shade::Wireframe && !info.features.wireframe {
            return Err(EngineError::Unsupported {
                device: info.name.clone(),
                what: "draw the edges of triangles".to_owned(),
                hint: "choose another shade".to_owned(),
            });
        }
        Ok(Self { engine, desc, targets: Targets::new(engine, desc)?, draws: Vec::new(), begun: false })
    }

    /// Makes all pipelines that surfaces will need.
    pub(crate) fn prepare(&self, surfaces: &[&Surface]) -> Result<(), EngineError> {
        let (target, tessellation) = (self.targets.target, &self.desc.tessellation);
        let cage = self.desc.cage.then_some([false, true].map(|hidden| PipelineKey::Cage { target, hidden }));
        let cage = cage.into_iter().flatten();
        if tessellation.renders_in_compute() {
            let kernels = surfaces.iter().flat_map(|surface| surface.grid_kernels());
            return self.engine.prepare(kernels, self.outputs().map(|output| PipelineKey::Grid { output }).chain(cage));
        }
        let patches = |output| surfaces.iter().flat_map(move |surface| surface.pipelines(tessellation.spacing, output));
        self.engine.prepare([], self.outputs().flat_map(patches).chain(cage))
    }

    /// Draws a surface, and its cage if that is asked for.
    pub(crate) fn add(&mut self, surface: &Surface) -> Result<(), EngineError> {
        if self.desc.tessellation.renders_in_compute() {
            self.add_grids(surface)?;
        } else {
            self.add_patches(surface)?;
        }
        self.add_cage(surface)
    }

    /// What becomes of the triangles, in order.
    fn outputs(&self) -> impl Iterator<Item = Output> + use<> {
        let target = self.targets.target;
        let lines = (self.desc.shade == Shade::Wireframe).then_some(Output::Lines(target));
        std::iter::once(Output::Fill(target)).chain(lines)
    }

    /// The frame of a surface.
    pub(crate) fn frame<'b>(&'b self, surface: &'b Surface) -> FrameDesc<'b> {
        FrameDesc {
            space: surface.space(),
            radius: surface.radius(),
            tessellation: &self.desc.tessellation,
            view: Some((&self.desc.camera, self.desc.size)),
            shade: self.desc.shade,
            line_color: WIRE,
        }
    }

    fn add_patches(&mut self, surface: &Surface) -> Result<(), EngineError> {
        let tessellation = &self.desc.tessellation;
        let frame = self.frame(surface).upload(self.engine.device())?;
        let bindings = surface.buffers().patches.clone().with(binding::FRAME, &frame);
        let longest = self.engine.patches_per_draw(tessellation.max_segments()?);
        for output in self.outputs() {
            for run in runs(&surface.plan().lists, longest) {
                self.draws.push(surface.draw(run, &bindings, tessellation, output)?);
            }
        }
        Ok(())
    }

    /// Evaluates and draws chunk after chunk, so that only one is in memory.
    fn add_grids(&mut self, surface: &Surface) -> Result<(), EngineError> {
        let rates = surface.grid_rates(&self.desc.tessellation)?;
        let grids = Grids::new(surface, &rates, self.desc.shade.layout(), Memory::Device)?;
        let frame = self.frame(surface).upload(self.engine.device())?;
        for chunk in grids.chunks() {
            let chunk = chunk?;
            let mut recording = Recording::new();
            grids.record(&chunk, &frame, &mut recording)?;
            self.add_chunk(&grids, &chunk, &frame, recording)?;
        }
        Ok(())
    }

    /// Runs what is recorded, then draws a chunk.
    pub(crate) fn add_chunk(
        &mut self,
        grids: &Grids<'_>,
        chunk: &GridChunk,
        frame: &Buffer,
        recording: Recording,
    ) -> Result<(), EngineError> {
        let indices = self.engine.device().upload("grid indices", BufferUsage::INDEX, &chunk.indices)?;
        for output in self.outputs() {
            self.draws.push(grids.draw(chunk, &indices, frame, output)?);
        }
        self.flush(recording)
    }

    /// Draws the cage of a surface, if that is asked for.
    pub(crate) fn add_cage(&mut self, surface: &Surface) -> Result<(), EngineError> {
        if !self.desc.cage {
            return Ok(());
        }
        let target = self.targets.target;
        for (hidden, opacity) in [(true, CAGE_BEHIND), (false, 1.0)] {
            let [r, g, b, _] = CAGE;
            let frame = FrameDesc { line_color: [r, g, b, opacity], ..self.frame(surface) };
            let frame = frame.upload(self.engine.device())?;
            self.draws.push(Draw {
                pipeline: self.engine.pipeline(PipelineKey::Cage { target, hidden })?,
                bindings: surface.buffers().cage_edges.clone().with(binding::FRAME, &frame),
                push: Vec::new(),
                vertices: (0..2 * surface.cage_edge_count()).into(),
                instances: 0..1,
                scissor: None,
            });
        }
        Ok(())
    }

    /// Runs what is recorded, then the draws so far.
    fn flush(&mut self, mut recording: Recording) -> Result<(), EngineError> {
        self.record_pass(&mut recording);
        self.engine.device().run(&recording)?;
        Ok(())
    }

    fn record_pass(&mut self, recording: &mut Recording) {
        let draws = std::mem::take(&mut self.draws);
        recording.render(self.targets.pass(self.desc, draws, self.begun));
        self.begun = true;
    }

    /// The picture.
    pub(crate) fn finish(mut self) -> Result<Picture, EngineError> {
        let mut recording = Recording::new();
        if !self.draws.is_empty() || !self.begun {
            self.record_pass(&mut recording);
        }
        let [width, height] = self.desc.size;
        let size = u64::from(width) * u64::from(height) * 4;
        let (usage, memory) = (BufferUsage::STORAGE, Memory::Readback);
        let pixels = self.engine.device().buffer(&BufferDesc { name: "picture", size, usage, memory })?;
        recording.copy_image_to_buffer(self.targets.result(), &pixels);
        self.engine.device().run(&recording)?;
        let mut rgba = pixels.read(0..size)?;
        if self.desc.background[3] < 1.0 {
            divide_alpha_out(&mut rgba, self.targets.target.color);
        }
        Ok(Picture { size: self.desc.size, rgba })
    }
}

impl Shade {
    /// Whose vertices a shade takes: one that shows something of each patch needs vertices of its own.
    fn layout(self) -> Layout {
        match self {
            Self::Lit | Self::Normals | Self::Zebra | Self::Peer => Layout::Shared,
            _ => Layout::Own,
        }
    }
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
            engine.device().image(&ImageDesc { name, size: desc.size, format, samples, usage, ..ImageDesc::default() })
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

    /// A pass that begins the picture, or adds to what is there.
    fn pass(&self, desc: &RenderDesc, draws: Vec<Draw>, add: bool) -> RenderPass {
        RenderPass {
            name: "picture".to_owned(),
            color: Some(ColorTarget {
                image: self.color.clone(),
                clear: (!add).then(|| alpha_multiplied_in(desc.background)),
                resolve: self.resolved.clone(),
            }),
            depth: Some(DepthTarget { image: self.depth.clone(), clear: (!add).then_some(1.0) }),
            viewport: desc.size.into(),
            area: None,
            draws,
        }
    }
}
