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

/// The kernel that evaluates patches of a form, a workgroup each: their insides, and their borders where those are measured by the patch's own formula.
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

/// The kernel that evaluates insides of patches of a form, a thread each, if there is one.
fn lane_kernel(form: PatchForm, mapped: bool) -> Option<&'static str> {
    match (form, mapped) {
        (PatchForm::Bicubic, false) => Some("evaluate/bicubic_lanes.comp"),
        (PatchForm::Gregory, false) => Some("evaluate/gregory_lanes.comp"),
        (PatchForm::Bicubic, true) => Some("evaluate/bicubic_lanes.comp#mapped"),
        (PatchForm::Gregory, true) => Some("evaluate/gregory_lanes.comp#mapped"),
        (PatchForm::Stam | PatchForm::Biseptic | PatchForm::Triangle, _) => None,
    }
}

/// The kernel that evaluates borders of patches of a form from records alone, a thread for each corner and side.
fn border_kernel(form: PatchForm, mapped: bool) -> &'static str {
    match (form, mapped) {
        (PatchForm::Bicubic | PatchForm::Gregory, false) => "evaluate/border_quad.comp",
        (PatchForm::Stam, false) => "evaluate/border_stam.comp",
        (PatchForm::Biseptic, false) => "evaluate/border_biseptic.comp",
        (PatchForm::Triangle, false) => "evaluate/border_triangle.comp",
        (PatchForm::Bicubic | PatchForm::Gregory, true) => "evaluate/border_quad.comp#mapped",
        (PatchForm::Stam, true) => "evaluate/border_stam.comp#mapped",
        (PatchForm::Biseptic, true) => "evaluate/border_biseptic.comp#mapped",
        (PatchForm::Triangle, true) => "evaluate/border_triangle.comp#mapped",
    }
}

/// What evaluates a patch.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Share {
    Workgroup,
    Thread,
    /// A thread for each corner and the side that leaves it.
    FourThreads,
}

/// One of the kernels that evaluate patches of a form.
#[derive(Clone, Copy)]
struct GridKernel {
    shader: &'static str,
    share: Share,
    /// Whether it makes inner vertices alone.
    inside: bool,
}

/// The kernels that evaluate patches of a form. Where places are all that is measured, borders need no control points, and have a kernel of their own.
///
/// `lanes`: threads are lanes of a vector, so that a thread for each patch is better than a workgroup.
fn grid_kernels(form: PatchForm, mapped: bool, measure: Measured, lanes: bool) -> impl Iterator<Item = GridKernel> {
    let apart = !measure.takes_patch();
    let border = GridKernel { shader: border_kernel(form, mapped), share: Share::FourThreads, inside: false };
    let whole = GridKernel { shader: kernel(form, mapped), share: Share::Workgroup, inside: apart };
    let lane = lane_kernel(form, mapped).filter(|_| lanes && apart);
    let inside = lane.map_or(whole, |shader| GridKernel { shader, share: Share::Thread, inside: true });
    apart.then_some(border).into_iter().chain([inside])
}

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
            Output::Fill(_, shade) if shade.layout() == Layout::Shared => Self::Nothing,
            Output::Fill(_, shade) | Output::Material(_, shade) => Self::of_patch(shade),
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
    fn vertex_bytes(self) -> u64 {
        let words = if self == Self::Nothing { constant::GRID_PLACE_WORDS } else { constant::GRID_VERTEX_WORDS };
        4 * u64::from(words)
    }

    /// Whether it follows from the whole patch, its formula or how it is divided, on its border too (`shade_measures_patch` in
    /// shaders/include/measure.glsl).
    fn takes_patch(self) -> bool {
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
        Self::new(surface, rates, output, output.layout(), Memory::Device)
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
        surface.engine().prepare(surface.grid_kernels(output), [])?;
        let parameters = upload(surface, "grid parameters", rates.parameters())?;
        let bindings = surface.patch_bindings().with(binding::GRID_PARAMETERS, &parameters);
        Ok(Self { surface, rates, layout, measure, memory, bindings })
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
        engine.desc().grid_vertices.unwrap_or((bytes / self.measure.vertex_bytes()) as u32)
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
            let kernels = self.surface.grid_kernels_of(list.kind.form(), self.measure);
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
            pipeline: engine.kernel(KernelKey { shader: kernel.shader, measure: self.measure })?,
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
    pub(crate) fn grid_kernels(&self, output: Output) -> impl Iterator<Item = KernelKey> {
        let measure = Measured::of(output);
        let kernels = move |form| self.grid_kernels_of(form, measure);
        let shaders = self.plan().lists.iter().flat_map(move |list| kernels(list.kind.form()));
        shaders.map(move |kernel| KernelKey { shader: kernel.shader, measure })
    }

    fn grid_kernels_of(&self, form: PatchForm, measure: Measured) -> impl Iterator<Item = GridKernel> + use<> {
        grid_kernels(form, self.is_mapped(), measure, self.engine().grid_lanes())
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
