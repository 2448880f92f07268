//! A plan of GPU work: passes as plain data, in order. Nothing happens until [`Device::submit`](crate::Device::submit).

use std::{ops::Range, sync::Arc};

use bytemuck::NoUninit;

use crate::{Bindings, Buffer, ComputePipeline, GraphicsPipeline, Image, ImageRegion, Rect};

/// A dispatch of a compute pipeline.
#[derive(Clone, Debug)]
pub struct ComputePass {
    /// Name for tools, messages and the report.
    pub name: String,
    /// What runs.
    pub pipeline: ComputePipeline,
    /// The buffers and images it runs on.
    pub bindings: Bindings,
    /// Push constants: exactly as many bytes as the shader declares.
    pub push: Vec<u8>,
    /// Work groups per dimension; none if any is 0.
    pub groups: [u32; 3],
}

/// Which vertices a draw takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Vertices {
    /// Consecutive values of `gl_VertexIndex`.
    Range(Range<u32>),
    /// Values of `gl_VertexIndex` read from a buffer of `u32`.
    Indexed {
        /// The indices.
        indices: Buffer,
        /// Which of them, counted in indices.
        range: Range<u32>,
    },
}

impl From<Range<u32>> for Vertices {
    fn from(range: Range<u32>) -> Self {
        Self::Range(range)
    }
}

/// A draw of a graphics pipeline.
#[derive(Clone, Debug)]
pub struct Draw {
    /// What draws.
    pub pipeline: GraphicsPipeline,
    /// The buffers and images it draws from.
    pub bindings: Bindings,
    /// Push constants: exactly as many bytes as the shaders declare.
    pub push: Vec<u8>,
    /// Which vertices.
    pub vertices: Vertices,
    /// The buffer that the inputs of the vertex shader come from: for each vertex, all of them in order of their locations, without gaps. `None` if it has no inputs.
    pub attributes: Option<Buffer>,
    /// Which instances, values of `gl_InstanceIndex`; usually `0..1`.
    pub instances: Range<u32>,
    /// Texels of the targets that it may touch; `None` for all of the pass's area. May reach beyond the area.
    pub scissor: Option<Rect>,
}

/// The colour target of a render pass.
#[derive(Clone, Debug)]
pub struct ColorTarget {
    /// What is drawn to.
    pub image: Image,
    /// Linear red, green, blue, alpha to start with; `None` keeps what is there.
    pub clear: Option<[f32; 4]>,
    /// An image of one sample that receives the average of the samples at the end.
    pub resolve: Option<Image>,
}

/// The depth target of a render pass.
#[derive(Clone, Debug)]
pub struct DepthTarget {
    /// What depths are tested against.
    pub image: Image,
    /// Depth to start with; `None` keeps what is there.
    pub clear: Option<f32>,
}

/// Draws into targets. The draws of one pass are not ordered against each other but for what they do to the targets: a draw
/// that reads a buffer which another draw writes belongs in a later pass.
///
/// Clip space covers the viewport, y pointing down, depth from 0 to 1. Texels outside of the area keep what is in them, also
/// where the targets are cleared: passes with other areas draw other parts of the same targets.
#[derive(Clone, Debug)]
pub struct RenderPass {
    /// Name for tools, messages and the report.
    pub name: String,
    /// Colour target.
    pub color: Option<ColorTarget>,
    /// Depth target.
    pub depth: Option<DepthTarget>,
    /// What clip space is mapped to, within every target: `size.into()` for all of a target.
    pub viewport: Rect,
    /// The texels that are cleared and drawn, within every target; `None` for those of the viewport. A part of the viewport
    /// cuts the picture off without moving it.
    pub area: Option<Rect>,
    /// What is drawn, in order.
    pub draws: Vec<Draw>,
}

/// Captures the primitives of draws into a buffer by transform feedback, and draws nothing.
///
/// Primitives lie in the order of the draws, three own vertices per triangle, without gaps, also where the pipeline changes.
/// Needs
/// [`Features::transform_feedback`](crate::Features::transform_feedback) and pipelines with rasterizer discard.
#[derive(Clone, Debug)]
pub struct CapturePass {
    /// Name for tools, messages and the report.
    pub name: String,
    /// Receives the vertices; made with [`BufferUsage::CAPTURE`](crate::BufferUsage::CAPTURE).
    pub buffer: Buffer,
    /// Where the first vertex goes, in bytes, a multiple of 4.
    pub offset: u64,
    /// What is captured, in order.
    pub draws: Vec<Draw>,
}

/// One step of a recording.
#[derive(Clone, Debug)]
pub(crate) enum Pass {
    Compute(ComputePass),
    Render(RenderPass),
    Capture(CapturePass),
    Write { data: Arc<[u8]>, target: Buffer, offset: u64 },
    CopyBuffer { source: Buffer, range: Range<u64>, target: Buffer, offset: u64 },
    CopyFromImage { source: ImageRegion, target: Buffer, offset: u64 },
    CopyToImage { source: Buffer, offset: u64, target: ImageRegion },
    FillLevels { image: Image },
}

impl Pass {
    /// The name for tools, messages and the report.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Compute(pass) => pass.name.clone(),
            Self::Render(pass) => pass.name.clone(),
            Self::Capture(pass) => pass.name.clone(),
            Self::Write { target, .. } => format!("write {}", target.name()),
            Self::CopyBuffer { source, target, .. } => format!("copy {} to {}", source.name(), target.name()),
            Self::CopyFromImage { source, target, .. } => format!("copy {} to {}", source.image.name(), target.name()),
            Self::CopyToImage { source, target, .. } => format!("copy {} to {}", source.name(), target.image.name()),
            Self::FillLevels { image } => format!("levels of {}", image.name()),
        }
    }
}

/// What is measured while a recording runs; each costs a little time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Measure {
    /// GPU time of each pass. On llvmpipe times within one submission do not separate passes: submit each on its own.
    pub timings: bool,
    /// Counts of vertices, primitives and shader invocations of each render or capture pass; left out where the device lacks
    /// [`Features::pipeline_statistics`](crate::Features::pipeline_statistics).
    pub statistics: bool,
}

/// Passes in the order in which they take effect: each sees what those before it wrote.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    pub(crate) passes: Vec<Pass>,
    pub(crate) measure: Measure,
}

impl Recording {
    /// No passes yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Chooses what is measured.
    pub fn measure(&mut self, measure: Measure) {
        self.measure = measure;
    }

    /// Adds a dispatch.
    pub fn compute(&mut self, pass: ComputePass) {
        self.passes.push(Pass::Compute(pass));
    }

    /// Adds a render pass.
    pub fn render(&mut self, pass: RenderPass) {
        self.passes.push(Pass::Render(pass));
    }

    /// Adds a capture pass.
    pub fn capture(&mut self, pass: CapturePass) {
        self.passes.push(Pass::Capture(pass));
    }

    /// Adds a write of host data at `offset` bytes in a buffer of any memory; offset and size are multiples of 4. The data is part of
    /// the recording, so that nothing waits for earlier work on the buffer: the way to change contents from frame to frame where
    /// several frames are under way. A [`Prepared`](crate::Prepared) writes the same data in every run.
    pub fn write<T: NoUninit>(&mut self, target: &Buffer, offset: u64, data: &[T]) {
        let data = Arc::from(bytemuck::cast_slice::<T, u8>(data));
        self.passes.push(Pass::Write { data, target: target.clone(), offset });
    }

    /// Adds a copy of a range of bytes to `offset` bytes in another buffer.
    pub fn copy_buffer(&mut self, source: &Buffer, range: Range<u64>, target: &Buffer, offset: u64) {
        self.passes.push(Pass::CopyBuffer { source: source.clone(), range, target: target.clone(), offset });
    }

    /// Adds a copy of all texels of level 0 to the start of a buffer, rows from the top, tightly packed.
    pub fn copy_image_to_buffer(&mut self, image: &Image, buffer: &Buffer) {
        self.copy_region_to_buffer(image.level(0), buffer, 0);
    }

    /// Adds a copy of texels to a buffer from `offset` bytes on, a multiple of a texel's, rows from the top, tightly packed.
    pub fn copy_region_to_buffer(&mut self, source: ImageRegion, target: &Buffer, offset: u64) {
        self.passes.push(Pass::CopyFromImage { source, target: target.clone(), offset });
    }

    /// Adds a copy to texels from a buffer from `offset` bytes on, a multiple of a texel's, rows from the top, tightly packed.
    pub fn copy_buffer_to_image(&mut self, source: &Buffer, offset: u64, target: ImageRegion) {
        self.passes.push(Pass::CopyToImage { source: source.clone(), offset, target });
    }

    /// Fills every level but 0 of an image by halving the one before. The image was made with
    /// [`ImageUsage::COPY_SRC`](crate::ImageUsage::COPY_SRC) and [`COPY_DST`](crate::ImageUsage::COPY_DST), and in a format
    /// that can be filtered. sRGB is averaged as light.
    pub fn fill_levels(&mut self, image: &Image) {
        self.passes.push(Pass::FillLevels { image: image.clone() });
    }

    /// Adds the passes of another recording; what is measured stays as it is.
    pub fn append(&mut self, other: &Self) {
        self.passes.extend_from_slice(&other.passes);
    }

    /// One recording for each pass, in order: for timing passes one by one where the times within a submission do not separate them.
    pub fn split(self) -> impl Iterator<Item = Self> {
        let measure = self.measure;
        self.passes.into_iter().map(move |pass| Self { passes: vec![pass], measure })
    }

    /// Number of passes.
    pub fn len(&self) -> usize {
        self.passes.len()
    }

    /// Whether there are no passes.
    pub fn is_empty(&self) -> bool {
        self.passes.is_empty()
    }
}
