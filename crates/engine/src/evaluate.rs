//! The compute evaluator: chunks of patches become vertices in a buffer, and triangles between them.

use std::ops::Range;

use bytemuck::{NoUninit, bytes_of};
use osculate_gpu::{Bindings, Buffer, BufferDesc, BufferUsage, ComputePass, Draw, Memory, Recording, Vertices};
use osculate_shaders::layout::{GridPatch, KernelPush};
use osculate_shaders::{binding, constant};
use osculate_subdiv::PatchForm;

use crate::draw::{Output, PipelineKey};
use crate::frame::FrameDesc;
use crate::grid::{Chunk, GridPlan, GridPlanDesc, GridRates, Layout};
use crate::kernels::{Kernel, fold};
use crate::pipelines::KernelKey;
use crate::{CapturedVertex, EngineError, Factors, Shade, Surface, Tessellation};

/// Most bytes of vertices made at once, unless the device allows less.
const CHUNK_BYTES: u64 = 64 << 20;

/// The kernel of a form, for surfaces with texture coordinates or without.
fn kernel(form: PatchForm, mapped: bool) -> &'static str {
    match (form, mapped) {
        (PatchForm::Bicubic, false) => "evaluate/bicubic.comp",
        (PatchForm::Gregory, false) => "evaluate/gregory.comp",
        (PatchForm::Stam, false) => "evaluate/stam.comp",
        (PatchForm::Biseptic, false) => "evaluate/biseptic.comp",
        (PatchForm::Triangle, false) => "evaluate/triangle.comp",
        (PatchForm::Bicubic, true) => "evaluate/bicubic.comp#mapped",
        (PatchForm::Gregory, true) => "evaluate/gregory.comp#mapped",
        (PatchForm::Stam, true) => "evaluate/stam.comp#mapped",
        (PatchForm::Biseptic, true) => "evaluate/biseptic.comp#mapped",
        (PatchForm::Triangle, true) => "evaluate/triangle.comp#mapped",
    }
}

/// What vertices hold beside position and normal: few shades differ there, so that kernels do not multiply by shades.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Measured {
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
    /// What pictures in a shade need; `None` is no picture.
    fn of(shade: Option<Shade>) -> Self {
        match shade {
            None => Self::Parameters,
            Some(Shade::Curvature | Shade::Gaussian) => Self::Curvature,
            Some(Shade::Wireframe) => Self::Width,
            Some(Shade::Factors) => Self::Segments,
            Some(Shade::Textured | Shade::Uv) => Self::Texture,
            Some(_) => Self::Outline,
        }
    }

    /// A shade that measures this.
    pub(crate) fn shade(self) -> u32 {
        match self {
            Self::Parameters => constant::SHADE_NONE,
            Self::Outline => constant::SHADE_LIT,
            Self::Curvature => constant::SHADE_CURVATURE,
            Self::Width => constant::SHADE_WIREFRAME,
            Self::Segments => constant::SHADE_FACTORS,
            Self::Texture => constant::SHADE_UV,
        }
    }

    /// The name for tools.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Parameters => "parameters",
            Self::Outline => "outline",
            Self::Curvature => "curvature",
            Self::Width => "width",
            Self::Segments => "segments",
            Self::Texture => "texture",
        }
    }
}

/// The grids of a surface.
pub(crate) struct Grids<'a> {
    surface: &'a Surface,
    rates: &'a GridRates,
    layout: Layout,
    measure: Measured,
    /// Where vertices go: the device, or where the host can read them.
    memory: Memory,
    bindings: Bindings,
}

/// A chunk on the device.
#[derive(Clone)]
pub(crate) struct GridChunk {
    /// Receives [`CapturedVertex`] words; what `uv` holds depends on the shade of the frame.
    pub(crate) vertices: Buffer,
    /// The patches.
    pub(crate) patches: Range<u32>,
    /// Three vertices for each triangle.
    pub(crate) indices: Vec<u32>,
    bindings: Bindings,
}

impl GridChunk {
    /// The same once the triangles are in a buffer.
    pub(crate) fn without_indices(self) -> Self {
        Self { indices: Vec::new(), ..self }
    }

    /// Number of vertices.
    pub(crate) fn vertex_count(&self) -> u64 {
        self.vertices.size() / size_of::<CapturedVertex>() as u64
    }

    /// Bytes on the device: of vertices and patches.
    pub(crate) fn bytes(&self) -> u64 {
        self.vertices.size() + self.patches.len() as u64 * size_of::<GridPatch>() as u64
    }

    /// The same triangles between other vertices.
    pub(crate) fn with_vertices(&self, vertices: Buffer) -> Self {
        let bindings = self.bindings.clone().with(binding::GRID_VERTICES, &vertices);
        Self { vertices, bindings, ..self.clone() }
    }
}

impl<'a> Grids<'a> {
    /// Those that are drawn in a shade: on the device.
    pub(crate) fn drawn(surface: &'a Surface, rates: &'a GridRates, shade: Shade) -> Result<Self, EngineError> {
        Self::new(surface, rates, Some(shade), shade.layout(), Memory::Device)
    }

    /// Those that the host reads.
    pub(crate) fn read(surface: &'a Surface, rates: &'a GridRates, layout: Layout) -> Result<Self, EngineError> {
        Self::new(surface, rates, None, layout, Memory::Readback)
    }

    fn new(
        surface: &'a Surface,
        rates: &'a GridRates,
        shade: Option<Shade>,
        layout: Layout,
        memory: Memory,
    ) -> Result<Self, EngineError> {
        surface.engine().prepare(surface.grid_kernels(shade), [])?;
        let parameters = upload(surface, "grid parameters", rates.parameters())?;
        let bindings = surface.patch_bindings().with(binding::GRID_PARAMETERS, &parameters);
        Ok(Self { surface, rates, layout, measure: Measured::of(shade), memory, bindings })
    }

    /// The chunks, made one at a time.
    pub(crate) fn chunks(&self) -> impl Iterator<Item = Result<GridChunk, EngineError>> {
        let desc = GridPlanDesc {
            surface: self.surface.plan(),
            rates: self.rates,
            layout: self.layout,
            max_vertices: self.max_vertices(),
        };
        GridPlan::new(desc).into_chunks().map(|chunk| self.upload(chunk))
    }

    fn max_vertices(&self) -> u32 {
        let engine = self.surface.engine();
        let bytes = CHUNK_BYTES.min(engine.device().info().limits.max_storage_buffer_range);
        engine.desc().grid_vertices.unwrap_or((bytes / size_of::<CapturedVertex>() as u64) as u32)
    }

    fn upload(&self, chunk: Chunk) -> Result<GridChunk, EngineError> {
        let size = u64::from(chunk.vertex_count) * size_of::<CapturedVertex>() as u64;
        let desc = BufferDesc { name: "grid vertices", size, usage: BufferUsage::STORAGE, memory: self.memory };
        let vertices = self.surface.engine().device().buffer(&desc)?;
        let bindings = self
            .bindings
            .clone()
            .with(binding::GRID_PATCHES, &upload(self.surface, "grid patches", &chunk.patches)?)
            .with(binding::GRID_VERTICES, &vertices);
        Ok(GridChunk { vertices, patches: chunk.patch_range(), indices: chunk.indices, bindings })
    }

    /// Adds the kernels that write a chunk's vertices, one for each patch list that it has patches of.
    pub(crate) fn record(
        &self,
        chunk: &GridChunk,
        frame: &Buffer,
        recording: &mut Recording,
    ) -> Result<(), EngineError> {
        for list in &self.surface.plan().lists {
            let first = list.first_patch.max(chunk.patches.start);
            let end = (list.first_patch + list.count).min(chunk.patches.end);
            if first >= end {
                continue;
            }
            let push = KernelPush { count: end - first, first: first - chunk.patches.start, old_distance: 0 };
            let name = kernel(list.kind.form(), self.surface.is_mapped());
            recording.compute(ComputePass {
                name: name.to_owned(),
                pipeline: self.surface.engine().kernel(KernelKey { shader: name, measure: self.measure })?,
                bindings: chunk.bindings.clone().with(binding::FRAME, frame),
                push: bytes_of(&push).to_vec(),
                // One workgroup for each patch.
                groups: fold(push.count),
            });
        }
        Ok(())
    }

    /// Evaluates a chunk and reads its vertices.
    pub(crate) fn run(&self, chunk: &GridChunk, frame: &Buffer) -> Result<Vec<CapturedVertex>, EngineError> {
        let mut recording = Recording::new();
        self.record(chunk, frame, &mut recording)?;
        self.surface.engine().device().run(&recording)?;
        Ok(chunk.vertices.read(..)?)
    }

    /// The draw of a chunk whose indices are in a buffer.
    pub(crate) fn draw(
        &self,
        chunk: &GridChunk,
        indices: &Buffer,
        frame: &Buffer,
        output: Output,
    ) -> Result<Draw, EngineError> {
        Ok(Draw {
            pipeline: self.surface.engine().pipeline(PipelineKey::Grid { output, mapped: self.surface.is_mapped() })?,
            bindings: chunk.bindings.clone().with(binding::FRAME, frame),
            push: Vec::new(),
            vertices: Vertices::Indexed { indices: indices.clone(), range: 0..(indices.size() / 4) as u32 },
            instances: 0..1,
            scissor: None,
        })
    }
}

fn upload<T: NoUninit>(surface: &Surface, name: &str, data: &[T]) -> Result<Buffer, EngineError> {
    Ok(surface.engine().device().upload(name, BufferUsage::STORAGE, data)?)
}

impl Surface {
    /// The kernels that its patches need for pictures in a shade, or for none.
    pub(crate) fn grid_kernels(&self, shade: Option<Shade>) -> impl Iterator<Item = KernelKey> {
        let (measure, mapped) = (Measured::of(shade), self.is_mapped());
        self.plan().lists.iter().map(move |list| KernelKey { shader: kernel(list.kind.form(), mapped), measure })
    }

    /// How the edges are divided.
    pub(crate) fn grid_rates(&self, tessellation: &Tessellation) -> Result<GridRates, EngineError> {
        // Refuses levels out of range.
        tessellation.max_segments()?;
        Ok(match tessellation.factors {
            Factors::Uniform(level) => GridRates::uniform(level, tessellation.spacing),
            Factors::Adaptive { .. } => GridRates::per_edge(&self.edge_factors(tessellation)?, tessellation.spacing),
        })
    }

    /// The frame of triangles that are not drawn: (u,v) is what the kernels measure.
    pub(crate) fn undrawn_frame<'a>(&'a self, tessellation: &'a Tessellation) -> FrameDesc<'a> {
        FrameDesc {
            radius: self.radius(),
            space: self.space(),
            tessellation,
            view: None,
            line_color: [0.0; 4],
            culling: None,
        }
    }

    /// The tessellation factor of each edge record.
    fn edge_factors(&self, tessellation: &Tessellation) -> Result<Vec<f32>, EngineError> {
        let device = self.engine().device();
        let count = self.plan().edge_record_count() as u32;
        let (size, usage, memory) = (u64::from(count) * 4, BufferUsage::STORAGE, Memory::Readback);
        let factors = device.buffer(&BufferDesc { name: "edge factors", size, usage, memory })?;
        let bindings = self
            .buffers()
            .patches
            .clone()
            .with(binding::FRAME, &self.undrawn_frame(tessellation).upload(device)?)
            .with(binding::EDGE_FACTORS, &factors);
        let mut recording = Recording::new();
        let push = KernelPush { count, first: 0, old_distance: 0 };
        Kernel { shader: "evaluate/factors.comp", bindings: &bindings, push, threads: count }
            .record(self.engine(), &mut recording)?;
        device.run(&recording)?;
        Ok(factors.read(0..size)?)
    }

    /// Evaluates all grids; hands the vertices of each chunk and its triangles to `sink`, in order.
    pub(crate) fn evaluate_grids<E: From<EngineError>>(
        &self,
        tessellation: &Tessellation,
        layout: Layout,
        mut sink: impl FnMut(&GridChunk, &[CapturedVertex]) -> Result<(), E>,
    ) -> Result<(), E> {
        let rates = self.grid_rates(tessellation)?;
        let grids = Grids::read(self, &rates, layout)?;
        let frame = self.undrawn_frame(tessellation).upload(self.engine().device())?;
        for chunk in grids.chunks() {
            let chunk = chunk?;
            sink(&chunk, &grids.run(&chunk, &frame)?)?;
        }
        Ok(())
    }
}
