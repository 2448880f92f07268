//! The compute evaluator: chunks of patches become vertices in a buffer, and triangles between them.

use std::ops::Range;

use bytemuck::{NoUninit, bytes_of};
use osculate_gpu::{Bindings, Buffer, BufferDesc, BufferUsage, ComputePass, Draw, Memory, Recording, Vertices};
use osculate_shaders::binding;
use osculate_shaders::layout::{GridPatch, KernelPush};
use osculate_subdiv::PatchForm;

use crate::draw::{Output, PipelineKey};
use crate::frame::FrameDesc;
use crate::grid::{Chunk, GridPlan, GridPlanDesc, GridRates, Layout};
use crate::kernels::{Kernel, fold};
use crate::{CapturedVertex, EngineError, Factors, Shade, Surface, Tessellation};

/// Most bytes of vertices made at once, unless the device allows less.
const CHUNK_BYTES: u64 = 64 << 20;

/// The kernel of a form.
fn kernel(form: PatchForm) -> &'static str {
    match form {
        PatchForm::Bicubic => "evaluate/bicubic.comp",
        PatchForm::Gregory => "evaluate/gregory.comp",
        PatchForm::Stam => "evaluate/stam.comp",
        PatchForm::Biseptic => "evaluate/biseptic.comp",
        PatchForm::Triangle => "evaluate/triangle.comp",
    }
}

/// The grids of a surface.
pub(crate) struct Grids<'a> {
    surface: &'a Surface,
    rates: &'a GridRates,
    layout: Layout,
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
    pub(crate) fn new(
        surface: &'a Surface,
        rates: &'a GridRates,
        layout: Layout,
        memory: Memory,
    ) -> Result<Self, EngineError> {
        surface.engine().prepare(surface.grid_kernels(), [])?;
        let parameters = upload(surface, "grid parameters", rates.parameters())?;
        let bindings = surface.buffers().patches.clone().with(binding::GRID_PARAMETERS, &parameters);
        Ok(Self { surface, rates, layout, memory, bindings })
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
            let name = kernel(list.kind.form());
            recording.compute(ComputePass {
                name: name.to_owned(),
                pipeline: self.surface.engine().kernel(name)?,
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
            pipeline: self.surface.engine().pipeline(PipelineKey::Grid { output })?,
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
    /// The kernels that its patches need.
    pub(crate) fn grid_kernels(&self) -> impl Iterator<Item = &'static str> {
        self.plan().lists.iter().map(|list| kernel(list.kind.form()))
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
            shade: Shade::Lit,
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
        let grids = Grids::new(self, &rates, layout, Memory::Readback)?;
        let frame = self.undrawn_frame(tessellation).upload(self.engine().device())?;
        for chunk in grids.chunks() {
            let chunk = chunk?;
            sink(&chunk, &grids.run(&chunk, &frame)?)?;
        }
        Ok(())
    }
}
