//! Checks and resolves one pass.

use std::{ops::Range, sync::Arc};

use ash::vk;

use crate::{
    Bindings, Buffer, BufferDesc, BufferUsage, CapturePass, ComputePass, Device, Draw, GpuError, Image, ImageUsage,
    Memory, Rect, RenderPass, Vertices,
    barrier::{Scope, Use, Uses},
    graphics::Targets,
    pipeline::Pipeline,
    recording::Pass,
};

use super::{Call, DrawCall, Kept, Work, runs};

/// Resolves one pass.
pub(super) struct Planner<'p> {
    pub(super) device: &'p Device,
    pub(super) name: &'p str,
    pub(super) kept: &'p mut Kept,
    pub(super) uses: Uses,
    /// Whether pipelines get a descriptor set of the caller's.
    pub(super) has_caller_set: bool,
}

impl Planner<'_> {
    pub(super) fn work<'a>(&mut self, pass: &'a Pass) -> Result<Work<'a>, GpuError> {
        match pass {
            Pass::Compute(pass) => self.compute(pass),
            Pass::Render(pass) => self.render(pass),
            Pass::Capture(pass) => self.capture(pass),
            Pass::Write { data, target, offset } => self.write(data, target, *offset),
            Pass::CopyBuffer { source, range, target, offset } => {
                self.copy_buffer(source, range.clone(), target, *offset)
            }
            Pass::CopyFromImage { source, target, offset } => self.copy_from_image(source, target, *offset),
            Pass::CopyToImage { source, offset, target } => self.copy_to_image(source, *offset, target),
            Pass::FillLevels { image } => self.fill_levels(image),
        }
    }

    fn compute<'a>(&mut self, pass: &'a ComputePass) -> Result<Work<'a>, GpuError> {
        let limits = self.device.info().limits.max_work_groups;
        for (groups, limit) in pass.groups.into_iter().zip(limits) {
            if groups > limit {
                let what = format!("work groups of pass {:?}", self.name);
                return Err(GpuError::Limit { what, value: groups.into(), limit: limit.into() });
            }
        }
        let call = self.call(&pass.pipeline.inner, &pass.bindings, &pass.push, None)?;
        Ok(Work::Dispatch { call, groups: pass.groups })
    }

    fn render<'a>(&mut self, pass: &'a RenderPass) -> Result<Work<'a>, GpuError> {
        let targets = self.targets(pass)?;
        let area = self.area(pass)?;
        let draws = self.draws(&pass.draws, |pipeline| Targets { discard: pipeline.discard, ..targets } == pipeline)?;
        let blends = pass.draws.iter().any(|draw| draw.pipeline.blends);
        if let Some(color) = &pass.color {
            let reads = color.clear.is_none() || blends || color.resolve.is_some();
            self.attach(&color.image, color.clear.is_some(), reads)?;
            if let Some(resolve) = &color.resolve {
                self.attach(resolve, true, false)?;
            }
        }
        if let Some(depth) = &pass.depth {
            self.attach(&depth.image, depth.clear.is_some(), true)?;
        }
        Ok(Work::Render { pass, area, draws })
    }

    /// What the targets of a pass ask of its pipelines; fails unless they fit together.
    fn targets(&self, pass: &RenderPass) -> Result<Targets, GpuError> {
        let color = pass.color.as_ref().map(|target| &target.image);
        let depth = pass.depth.as_ref().map(|target| &target.image);
        let resolve = pass.color.as_ref().and_then(|target| target.resolve.as_ref());
        let Some(first) = color.or(depth) else {
            return Err(self.refuse("it has neither a colour nor a depth target"));
        };
        if color.is_some_and(|image| image.format().is_depth()) || depth.is_some_and(|image| !image.format().is_depth())
        {
            return Err(self.refuse("a depth image is its colour target, or the other way round"));
        }
        if color.into_iter().chain(depth).any(|image| image.samples() != first.samples()) {
            return Err(self.refuse("its targets differ in samples"));
        }
        let resolves = |color: &Image, resolve: &Image| {
            color.samples() > 1 && resolve.samples() == 1 && color.format() == resolve.format()
        };
        if color.zip(resolve).is_some_and(|(color, resolve)| !resolves(color, resolve)) {
            return Err(self.refuse("a resolve goes from several samples to one, within one format"));
        }
        Ok(Targets {
            color: color.map(Image::format),
            depth: depth.map(Image::format),
            samples: first.samples(),
            discard: false,
            of_caller: false,
        })
    }

    /// The texels that a pass clears and draws.
    fn area(&self, pass: &RenderPass) -> Result<Rect, GpuError> {
        let area = pass.area.unwrap_or(pass.viewport);
        let color = pass.color.iter().flat_map(|target| std::iter::once(&target.image).chain(&target.resolve));
        let targets = || color.clone().chain(pass.depth.iter().map(|target| &target.image));
        for (what, rect) in [("viewport", pass.viewport), ("area", area)] {
            if rect.is_empty() || targets().any(|image| !rect.fits(image.size())) {
                return Err(self.refuse(&format!("its {what} is empty or reaches beyond a target")));
            }
        }
        Ok(area)
    }

    /// Takes note of a target.
    fn attach(&mut self, image: &Image, cleared: bool, reads: bool) -> Result<(), GpuError> {
        use vk::{AccessFlags2 as Access, PipelineStageFlags2 as Stages};
        if !cleared && self.is_blank(image) {
            return Err(
                self.refuse(&format!("it keeps what is in {:?}, but nothing was drawn there yet", image.name()))
            );
        }
        let (stages, read, write, layout) = if image.format().is_depth() {
            let stages = Stages::EARLY_FRAGMENT_TESTS | Stages::LATE_FRAGMENT_TESTS;
            let (read, write) = (Access::DEPTH_STENCIL_ATTACHMENT_READ, Access::DEPTH_STENCIL_ATTACHMENT_WRITE);
            (stages, read, write, vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL)
        } else {
            let (read, write) = (Access::COLOR_ATTACHMENT_READ, Access::COLOR_ATTACHMENT_WRITE);
            (Stages::COLOR_ATTACHMENT_OUTPUT, read, write, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        };
        let read = if reads { Scope::new(stages, read) } else { Scope::default() };
        self.touch_image(image, ImageUsage::TARGET, read, Scope::new(stages, write), layout)
    }

    fn capture<'a>(&mut self, pass: &'a CapturePass) -> Result<Work<'a>, GpuError> {
        pass.buffer.require(BufferUsage::CAPTURE, self.name)?;
        let none = Targets { color: None, depth: None, samples: 1, discard: true, of_caller: false };
        let draws = self.draws(&pass.draws, |pipeline| pipeline == none)?;
        if let Some(draw) = pass.draws.iter().find(|draw| draw.pipeline.capture_stride().is_none()) {
            return Err(
                self.refuse(&format!("the shaders of pipeline {:?} declare nothing to capture", draw.pipeline.name()))
            );
        }
        if self.uses.contains(pass.buffer.id()) {
            return Err(self.refuse("it captures into a buffer that its draws use"));
        }
        if !pass.offset.is_multiple_of(4) || pass.offset >= pass.buffer.size() {
            return Err(self.refuse("its offset is not a multiple of 4 within the buffer"));
        }
        let write =
            Scope::new(vk::PipelineStageFlags2::TRANSFORM_FEEDBACK_EXT, vk::AccessFlags2::TRANSFORM_FEEDBACK_WRITE_EXT);
        self.touch_buffer(&pass.buffer, Scope::default(), write)?;
        let size = (pass.buffer.size() - pass.offset).min(self.device.info().limits.max_capture_buffer);
        let counter = self.counter(&draws)?;
        Ok(Work::Capture { pass, size, draws, counter })
    }

    /// Where a capture remembers its place while the pipeline changes, if it does.
    fn counter(&mut self, draws: &[DrawCall<'_>]) -> Result<Option<vk::Buffer>, GpuError> {
        if runs(draws).count() < 2 {
            return Ok(None);
        }
        let usage = BufferUsage::CAPTURE;
        let counter =
            self.device.buffer(&BufferDesc { name: "capture counter", size: 4, usage, memory: Memory::Device })?;
        let raw = counter.raw();
        self.kept.buffers.insert(counter.id(), counter);
        Ok(Some(raw))
    }

    /// Resolves draws whose pipelines pass the test of their targets.
    pub(super) fn draws<'a>(
        &mut self,
        draws: &'a [Draw],
        fits: impl Fn(Targets) -> bool,
    ) -> Result<Vec<DrawCall<'a>>, GpuError> {
        let mut previous: Option<&'a Draw> = None;
        let mut calls = Vec::with_capacity(draws.len());
        for draw in draws {
            if !fits(draw.pipeline.targets) {
                let reason = format!(
                    "pipeline {:?} was made for other targets: {:?}",
                    draw.pipeline.name(),
                    draw.pipeline.targets
                );
                return Err(self.refuse(&reason));
            }
            if draw.pipeline.inner.layout.has_caller_set && !self.has_caller_set {
                let name = draw.pipeline.name();
                return Err(self.refuse(&format!("pipeline {name:?} wants a descriptor set 1, see gpu::EncodeDraws")));
            }
            let call = self.call(&draw.pipeline.inner, &draw.bindings, &draw.push, previous)?;
            previous = Some(draw);
            if let Vertices::Indexed { indices, range } = &draw.vertices {
                self.index(indices, range.clone())?;
            }
            let attributes = self.attributes(draw)?;
            let (vertices, instances) = (&draw.vertices, draw.instances.clone());
            calls.push(DrawCall { call, vertices, attributes, instances, scissor: draw.scissor });
        }
        Ok(calls)
    }

    /// Takes note of a read of indices.
    fn index(&mut self, indices: &Buffer, range: Range<u32>) -> Result<(), GpuError> {
        indices.require(BufferUsage::INDEX, self.name)?;
        if !range.is_empty() {
            indices.check(u64::from(range.start) * 4..u64::from(range.end) * 4, self.name)?;
        }
        let read = Scope::new(vk::PipelineStageFlags2::INDEX_INPUT, vk::AccessFlags2::INDEX_READ);
        self.touch_buffer(indices, read, Scope::default())
    }

    /// Takes note of a read of vertex attributes.
    fn attributes<'a>(&mut self, draw: &'a Draw) -> Result<Option<&'a Buffer>, GpuError> {
        let (name, stride) = (draw.pipeline.name(), u64::from(draw.pipeline.vertex_stride));
        let buffer = match &draw.attributes {
            Some(_) if stride == 0 => {
                return Err(
                    self.refuse(&format!("pipeline {name:?} takes no attributes of vertices, but there are some"))
                );
            }
            None if stride > 0 => {
                return Err(self.refuse(&format!(
                    "pipeline {name:?} takes {stride} bytes of attributes a vertex, but there are none"
                )));
            }
            None => return Ok(None),
            Some(buffer) => buffer,
        };
        buffer.require(BufferUsage::VERTEX, self.name)?;
        if let Vertices::Range(range) = &draw.vertices
            && !range.is_empty()
        {
            buffer.check(u64::from(range.start) * stride..u64::from(range.end) * stride, self.name)?;
        }
        let read = Scope::new(vk::PipelineStageFlags2::VERTEX_ATTRIBUTE_INPUT, vk::AccessFlags2::VERTEX_ATTRIBUTE_READ);
        self.touch_buffer(buffer, read, Scope::default())?;
        Ok(Some(buffer))
    }

    /// Resolves a pipeline's bindings and push constants, given those of the draw before.
    fn call<'a>(
        &mut self,
        pipeline: &'a Arc<Pipeline>,
        bindings: &'a Bindings,
        push: &'a [u8],
        previous: Option<&'a Draw>,
    ) -> Result<Call<'a>, GpuError> {
        let wanted = pipeline.interface().push_size;
        if push.len() as u64 != u64::from(wanted) {
            let (pass, pipeline) = (self.name.to_owned(), pipeline.name.clone());
            return Err(GpuError::PushConstants { pass, pipeline, given: push.len(), wanted });
        }
        let previous = previous.filter(|draw| Arc::ptr_eq(&draw.pipeline.inner, pipeline));
        // lavapipe takes push constants that are set again for other ones, and compiles the stages anew in case they can be made into constants.
        let push = if previous.is_some_and(|draw| draw.push == push) { &[] } else { push };
        if previous.is_some_and(|draw| draw.bindings.same(bindings)) {
            return Ok(Call { pipeline, descriptors: None, push });
        }
        if !pipeline.device.is(self.device) {
            return Err(self.foreign(&pipeline.name));
        }
        if !self.kept.pipelines.iter().any(|known| Arc::ptr_eq(known, pipeline)) {
            self.kept.pipelines.push(Arc::clone(pipeline));
        }
        let descriptors = pipeline.interface().bindings.iter().map(|binding| self.descriptor(binding, bindings));
        Ok(Call { pipeline, descriptors: Some(descriptors.collect::<Result<_, _>>()?), push })
    }

    /// Whether nothing has filled the image yet.
    pub(super) fn is_blank(&self, image: &Image) -> bool {
        image.is_blank() && !self.kept.images.contains_key(&image.id())
    }

    pub(super) fn touch_buffer(&mut self, buffer: &Buffer, read: Scope, write: Scope) -> Result<(), GpuError> {
        if !buffer.device().is(self.device) {
            return Err(self.foreign(buffer.name()));
        }
        self.kept.buffers.entry(buffer.id()).or_insert_with(|| buffer.clone());
        self.uses.add(Use { resource: buffer.id(), read, write, layout: None });
        Ok(())
    }

    /// Takes note of what the pass does with an image. Shaders may see one image several times, if in the same way.
    pub(super) fn touch_image(
        &mut self,
        image: &Image,
        usage: ImageUsage,
        read: Scope,
        write: Scope,
        layout: vk::ImageLayout,
    ) -> Result<(), GpuError> {
        if !image.device().is(self.device) {
            return Err(self.foreign(image.name()));
        }
        if !image.usage().contains(usage) {
            let (image, what) = (image.name().to_owned(), self.name.to_owned());
            return Err(GpuError::ImageUsage { image, what, reason: format!("it was not made with usage {usage:?}") });
        }
        let shared = [vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL, vk::ImageLayout::GENERAL];
        if self.uses.layout(image.id()).is_some_and(|known| known != layout || !shared.contains(&layout)) {
            return Err(self.refuse(&format!("it uses image {:?} in two roles", image.name())));
        }
        self.kept.images.entry(image.id()).or_insert_with(|| image.clone());
        self.uses.add(Use { resource: image.id(), read, write, layout: Some(layout) });
        Ok(())
    }

    pub(super) fn foreign(&self, name: &str) -> GpuError {
        self.refuse(&format!("{name:?} belongs to another device"))
    }

    pub(super) fn refuse(&self, reason: &str) -> GpuError {
        GpuError::Pass { pass: self.name.to_owned(), reason: reason.to_owned() }
    }
}
