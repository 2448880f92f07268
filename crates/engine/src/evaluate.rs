//! The compute evaluator: chunks of patches become vertices in a buffer, and triangles between them.

mod by_record;
mod kernels;
mod measured;

use std::ops::Range;

use bytemuck::{NoUninit, bytes_of};
use osculate_gpu::{
    Bindings, Buffer, BufferDesc, BufferUsage, ComputePass, Draw, Memory, Recording, TexelFormat, Vertices,
};
use osculate_shaders::layout::{GridPatch, KernelPush};
use osculate_shaders::{binding, constant};
use osculate_subdiv::PatchForm;

use crate::draw::{Output, PipelineKey};
use crate::frame::FrameDesc;
use crate::grid::{Chunk, GridPlan, GridPlanDesc, GridRates, Layout};
use crate::kernels::{Kernel, fold};
use crate::pipelines::KernelKey;
use crate::{CapturedVertex, EngineError, Factors, Surface, Tessellation};
use kernels::{GridKernel, Share, grid_kernels};
pub(crate) use measured::Measured;

/// Most bytes of vertices made at once, unless the device allows less: of patches in chunks, and of all patches numbered by records.
const CHUNK_BYTES: u64 = 64 << 20;
const BY_RECORD_BYTES: u64 = 512 << 20;

/// The grids of a surface.
pub(crate) struct Grids<'a> {
    surface: &'a Surface,
    rates: &'a GridRates,
    layout: Layout,
    measure: Measured,
    /// Where vertices go: the device, or where the host can read them.
    memory: Memory,
    /// Parameters of all rates.
    parameters: Buffer,
    bindings: Bindings,
}

/// A chunk on the device.
#[derive(Clone)]
pub(crate) struct GridChunk {
    /// Receives [`CapturedVertex`] words; what `uv` holds depends on what is measured. If nothing is, positions and normals alone.
    pub(crate) vertices: Buffer,
    /// The patches.
    pub(crate) patches: Range<u32>,
    /// Three vertices for each triangle.
    pub(crate) indices: Vec<u32>,
    vertex_count: u32,
    /// Whether any patch has vertices inside.
    has_inside: bool,
    bindings: Bindings,
}

impl GridChunk {
    /// The same once the triangles are in a buffer.
    pub(crate) fn without_indices(self) -> Self {
        Self { indices: Vec::new(), ..self }
    }

    /// Number of vertices.
    pub(crate) fn vertex_count(&self) -> u64 {
        self.vertex_count.into()
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
    /// Those that are drawn: on the device.
    pub(crate) fn drawn(surface: &'a Surface, rates: &'a GridRates, output: Output) -> Result<Self, EngineError> {
        let layout = if by_record::fits(surface, rates, output) { Layout::ByRecord } else { output.layout() };
        Self::new(surface, rates, output, layout, Memory::Device)
    }

    /// Those that the host reads.
    pub(crate) fn read(surface: &'a Surface, rates: &'a GridRates, layout: Layout) -> Result<Self, EngineError> {
        Self::new(surface, rates, Output::Capture, layout, Memory::Readback)
    }

    fn new(
        surface: &'a Surface,
        rates: &'a GridRates,
        output: Output,
        layout: Layout,
        memory: Memory,
    ) -> Result<Self, EngineError> {
        let measure = Measured::of(output);
        surface.engine().prepare(surface.grid_kernels(output, layout), [])?;
        let device = surface.engine().device();
        let parameters = device.upload("grid parameters", BufferUsage::TEXELS, rates.parameters())?;
        let bindings =
            surface.patch_bindings().with_texels(binding::GRID_PARAMETERS, &parameters, TexelFormat::R32Float);
        Ok(Self { surface, rates, layout, measure, memory, parameters, bindings })
    }

    /// The chunks, made one at a time.
    pub(crate) fn chunks(&self) -> impl Iterator<Item = Result<GridChunk, EngineError>> {
        GridPlan::new(self.grid_plan()).into_chunks().map(|chunk| self.upload(chunk))
    }

    fn grid_plan(&self) -> GridPlanDesc<'_> {
        GridPlanDesc {
            surface: self.surface.plan(),
            rates: self.rates,
            layout: self.layout,
            max_vertices: self.max_vertices(),
        }
    }

    fn max_vertices(&self) -> u32 {
        self.surface.max_grid_vertices(CHUNK_BYTES, self.measure)
    }

    fn upload(&self, chunk: Chunk) -> Result<GridChunk, EngineError> {
        let size = u64::from(chunk.vertex_count) * self.measure.vertex_bytes();
        let usage = BufferUsage::STORAGE | BufferUsage::VERTEX;
        let desc = BufferDesc { name: "grid vertices", size, usage, memory: self.memory };
        let vertices = self.surface.engine().device().buffer(&desc)?;
        let bindings = self
            .bindings
            .clone()
            .with(binding::GRID_PATCHES, &upload(self.surface, "grid patches", &chunk.patches)?)
            .with(binding::GRID_VERTICES, &vertices);
        let (patches, vertex_count, has_inside) = (chunk.patch_range(), chunk.vertex_count, chunk.has_inside);
        Ok(GridChunk { vertices, patches, indices: chunk.indices, vertex_count, has_inside, bindings })
    }

    /// Adds the kernels that write a chunk's vertices.
    pub(crate) fn record(
        &self,
        chunk: &GridChunk,
        frame: &Buffer,
        recording: &mut Recording,
    ) -> Result<(), EngineError> {
        if self.layout == Layout::ByRecord {
            self.record_border(chunk, recording)?;
        }
        self.record_patches(chunk, frame, recording)
    }

    /// Adds the kernels that take a patch at a time.
    fn record_patches(&self, chunk: &GridChunk, frame: &Buffer, recording: &mut Recording) -> Result<(), EngineError> {
        let bindings = chunk.bindings.clone().with(binding::FRAME, frame);
        for (kernel, patches) in self.kernels(chunk) {
            let (count, first) = (patches.len() as u32, patches.start - chunk.patches.start);
            recording.compute(self.pass(kernel, &bindings, KernelPush { count, first, old_distance: 0 })?);
        }
        Ok(())
    }

    /// The kernels of a chunk and their patches. Lists that follow each other go through the same kernel at once.
    fn kernels(&self, chunk: &GridChunk) -> Vec<(GridKernel, Range<u32>)> {
        let mut all: Vec<(GridKernel, Range<u32>)> = Vec::new();
        for list in &self.surface.plan().lists {
            let first = list.first_patch.max(chunk.patches.start);
            let end = (list.first_patch + list.count).min(chunk.patches.end);
            if first >= end {
                continue;
            }
            let kernels = self.surface.grid_kernels_of(list.kind.form(), self.measure, self.layout);
            for kernel in kernels.filter(|kernel| chunk.has_inside || !kernel.inside) {
                match all.iter_mut().find(|(known, range)| known.shader == kernel.shader && range.end == first) {
                    Some((_, range)) => range.end = end,
                    None => all.push((kernel, first..end)),
                }
            }
        }
        all
    }

    fn pass(&self, kernel: GridKernel, bindings: &Bindings, push: KernelPush) -> Result<ComputePass, EngineError> {
        let engine = self.surface.engine();
        let groups = match kernel.share {
            Share::Workgroup => push.count,
            Share::Thread => push.count.div_ceil(engine.grid_group()),
            Share::FourThreads => (4 * push.count).div_ceil(constant::GROUP_SIZE),
        };
        Ok(ComputePass {
            name: kernel.shader.to_owned(),
            pipeline: engine.kernel(self.surface.grid_kernel_key(kernel.shader, self.measure))?,
            bindings: bindings.clone(),
            push: bytes_of(&push).to_vec(),
            groups: fold(groups),
        })
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
            attributes: Some(chunk.vertices.clone()),
            scissor: None,
        })
    }
}

fn upload<T: NoUninit>(surface: &Surface, name: &str, data: &[T]) -> Result<Buffer, EngineError> {
    Ok(surface.engine().device().upload(name, BufferUsage::STORAGE, data)?)
}

impl Surface {
    /// The kernels that its patches need for an output.
    pub(crate) fn grid_kernels(&self, output: Output, layout: Layout) -> impl Iterator<Item = KernelKey> {
        let measure = Measured::of(output);
        let kernels = move |form| self.grid_kernels_of(form, measure, layout);
        let shaders = self.plan().lists.iter().flat_map(move |list| kernels(list.kind.form()));
        let edges = by_record::EDGE_KERNELS.into_iter().filter(move |_| layout == Layout::ByRecord);
        shaders.map(move |kernel| self.grid_kernel_key(kernel.shader, measure)).chain(edges.map(KernelKey::from))
    }

    fn grid_kernel_key(&self, shader: &'static str, measure: Measured) -> KernelKey {
        KernelKey { shader, measure, sides_by_tag: self.has_unrefined() }
    }

    fn grid_kernels_of(
        &self,
        form: PatchForm,
        measure: Measured,
        layout: Layout,
    ) -> impl Iterator<Item = GridKernel> + use<> {
        let kernels = grid_kernels(form, self.is_mapped(), measure, self.engine().grid_lanes());
        kernels.filter(move |kernel| kernel.inside || layout != Layout::ByRecord)
    }

    /// Most vertices in so many bytes, unless the device, or who wants small chunks, allows fewer.
    fn max_grid_vertices(&self, bytes: u64, measure: Measured) -> u32 {
        let bytes = bytes.min(self.engine().device().info().limits.max_storage_buffer_range);
        self.engine().desc().grid_vertices.unwrap_or((bytes / measure.vertex_bytes()) as u32)
    }

    /// How vertices of an output are likely laid out: as it turns out, unless there are too many for one chunk.
    pub(crate) fn likely_grid_layout(&self, output: Output, tessellation: &Tessellation) -> Layout {
        let uniform = matches!(tessellation.factors, Factors::Uniform(_));
        if uniform && by_record::suits(self, output) { Layout::ByRecord } else { output.layout() }
    }

    /// How the edges are divided.
    pub(crate) fn grid_rates(&self, tessellation: &Tessellation) -> Result<GridRates, EngineError> {
        // Refuses levels out of range.
        self.max_segments(tessellation)?;
        Ok(match tessellation.factors {
            Factors::Uniform(level) if self.has_unrefined() => {
                GridRates::where_needed(level, self.plan().whole_edge_count())
            }
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
