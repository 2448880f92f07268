//! From a recording to steps that can be executed without further questions: everything that could be wrong with it is found
//! here, and what each pass does with each resource is worked out.

mod copies;
mod descriptors;
mod planner;

use std::{collections::HashMap, ops::Range, sync::Arc};

use ash::vk;

use crate::{
    Buffer, CapturePass, Device, Draw, GpuError, Image, ImageRegion, Recording, Rect, RenderPass, ResourceKind,
    Sampler, Vertices, barrier::Uses, pipeline::Pipeline, resource::ResourceId,
};
use planner::Planner;

/// A recording, checked and resolved.
#[derive(Default)]
pub(crate) struct Plan<'a> {
    pub(crate) steps: Vec<Step<'a>>,
    pub(crate) kept: Kept,
}

/// All that a submission must keep alive.
#[derive(Default)]
pub(crate) struct Kept {
    pub(crate) buffers: HashMap<ResourceId, Buffer>,
    pub(crate) images: HashMap<ResourceId, Image>,
    pipelines: Vec<Arc<Pipeline>>,
    samplers: Vec<Sampler>,
}

impl Kept {
    fn keep_sampler(&mut self, sampler: &Sampler) {
        if !self.samplers.contains(sampler) {
            self.samplers.push(sampler.clone());
        }
    }
}

/// A pass, resolved.
pub(crate) struct Step<'a> {
    pub(crate) name: String,
    pub(crate) uses: Uses,
    pub(crate) work: Work<'a>,
}

/// What a step does.
pub(crate) enum Work<'a> {
    Dispatch { call: Call<'a>, groups: [u32; 3] },
    Render { pass: &'a RenderPass, area: Rect, draws: Vec<DrawCall<'a>> },
    Capture { pass: &'a CapturePass, size: u64, draws: Vec<DrawCall<'a>>, counter: Option<vk::Buffer> },
    Write { target: vk::Buffer, offset: u64, data: &'a [u8] },
    CopyBuffer { source: vk::Buffer, target: vk::Buffer, region: vk::BufferCopy2<'static> },
    CopyFromImage { source: &'a ImageRegion, buffer: vk::Buffer, offset: u64 },
    CopyToImage { buffer: vk::Buffer, offset: u64, target: &'a ImageRegion },
    FillLevels { image: &'a Image },
}

/// A pipeline with what is bound to it.
pub(crate) struct Call<'a> {
    pub(crate) pipeline: &'a Pipeline,
    /// What to bind; `None` if pipeline and buffers are those of the call before.
    pub(crate) descriptors: Option<Vec<Descriptor>>,
    /// Push constants; empty if the pipeline takes none, or they are those of the call before.
    pub(crate) push: &'a [u8],
}

/// A draw, resolved.
pub(crate) struct DrawCall<'a> {
    pub(crate) call: Call<'a>,
    pub(crate) vertices: &'a Vertices,
    pub(crate) attributes: Option<&'a Buffer>,
    pub(crate) instances: Range<u32>,
    pub(crate) scissor: Option<Rect>,
}

/// Draws, cut where the pipeline changes.
pub(crate) fn runs<'d, 'a>(draws: &'d [DrawCall<'a>]) -> impl Iterator<Item = &'d [DrawCall<'a>]> {
    draws.chunk_by(|one, next| std::ptr::eq(one.call.pipeline, next.call.pipeline))
}

/// A buffer or image at a binding number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descriptor {
    pub(crate) binding: u32,
    pub(crate) kind: ResourceKind,
    pub(crate) content: Content,
}

/// What a descriptor describes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Content {
    Buffer { buffer: vk::Buffer, offset: u64, range: u64 },
    Texels { view: vk::BufferView },
    Image { view: vk::ImageView, sampler: vk::Sampler, layout: vk::ImageLayout },
}

impl<'a> Plan<'a> {
    /// Checks and resolves a recording.
    pub(crate) fn new(device: &Device, recording: &'a Recording) -> Result<Self, GpuError> {
        let mut plan = Self::default();
        for pass in &recording.passes {
            let name = pass.name();
            let (kept, uses) = (&mut plan.kept, Uses::default());
            let mut planner = Planner { device, name: &name, kept, uses, has_caller_set: false };
            let work = planner.work(pass)?;
            let uses = planner.uses;
            plan.steps.push(Step { name, uses, work });
        }
        Ok(plan)
    }
}

/// Draws alone, checked and resolved.
pub(crate) struct DrawPlan<'a> {
    pub(crate) draws: Vec<DrawCall<'a>>,
    pub(crate) uses: Uses,
    pub(crate) kept: Kept,
}

impl<'a> DrawPlan<'a> {
    /// Checks and resolves draws for a rendering that somebody else begins.
    pub(crate) fn new(device: &Device, draws: &'a [Draw], has_caller_set: bool) -> Result<Self, GpuError> {
        let mut kept = Kept::default();
        let uses = Uses::default();
        let mut planner = Planner { device, name: "draws", kept: &mut kept, uses, has_caller_set };
        let first = draws.first().map(|draw| draw.pipeline.targets);
        let draws = planner.draws(draws, |targets| Some(targets) == first)?;
        let uses = planner.uses;
        Ok(Self { draws, uses, kept })
    }
}
