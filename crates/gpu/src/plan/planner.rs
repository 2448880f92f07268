//! Checks and resolves one pass.

use std::{ops::Range, sync::Arc};

use ash::vk;

use crate::{
    Bindings, Buffer, BufferDesc, BufferKind, BufferUsage, CapturePass, ComputePass, Device, Draw, GpuError, Image,
    ImageUsage, Memory, RenderPass, Vertices,
    barrier::{Scope, Use, Uses},
    bindings::Bound,
    graphics::Targets,
    layout::LayoutBinding,
    pipeline::Pipeline,
    recording::Pass,
};

use super::{Call, Descriptor, DrawCall, Kept, Work, runs};

/// Resolves one pass.
pub(super) struct Planner<'p> {
    pub(super) device: &'p Device,
    pub(super) name: &'p str,
    pub(super) kept: &'p mut Kept,
    pub(super) uses: Uses,
}

impl Planner<'_> {
    pub(super) fn work<'a>(&mut self, pass: &'a Pass) -> Result<Work<'a>, GpuError> {
        match pass {
            Pass::Compute(pass) => self.compute(pass),
            Pass::Render(pass) => self.render(pass),
            Pass::Capture(pass) => self.capture(pass),
            Pass::CopyBuffer { source, range, target, offset } => {
                self.copy_buffer(source, range.clone(), target, *offset)
            }
            Pass::CopyImage { image, buffer } => self.copy_image(image, buffer),
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
        Ok(Work::Render { pass, draws })
    }

    /// What the targets of a pass ask of its pipelines; fails unless they fit together.
    fn targets(&self, pass: &RenderPass) -> Result<Targets, GpuError> {
        let color = pass.color.as_ref().map(|target| &target.image);
        let depth = pass.depth.as_ref().map(|target| &target.image);
        let resolve = pass.color.as_ref().and_then(|target| target.resolve.as_ref());
        let Some(first) = color.or(depth) else {
            return Err(self.refuse("it has neither a colour nor a depth target"));
        };
        let all = || color.into_iter().chain(depth).chain(resolve);
        if color.is_some_and(|image| image.format().is_depth()) || depth.is_some_and(|image| !image.format().is_depth())
        {
            return Err(self.refuse("a depth image is its colour target, or the other way round"));
        }
        if color.into_iter().chain(depth).any(|image| image.samples() != first.samples()) {
            return Err(self.refuse("its targets differ in samples"));
        }
        if pass.size.contains(&0) || all().any(|image| image.size()[0] < pass.size[0] || image.size()[1] < pass.size[1])
        {
            return Err(self.refuse("its size is zero or larger than a target"));
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
        })
    }

    /// Takes note of a target.
    fn attach(&mut self, image: &Image, cleared: bool, reads: bool) -> Result<(), GpuError> {
        use vk::{AccessFlags2 as Access, PipelineStageFlags2 as Stages};
        if !cleared && image.layout() == vk::ImageLayout::UNDEFINED && !self.kept.images.contains_key(&image.id()) {
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
        let none = Targets { color: None, depth: None, samples: 1, discard: true };
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
    fn draws<'a>(&mut self, draws: &'a [Draw], fits: impl Fn(Targets) -> bool) -> Result<Vec<DrawCall<'a>>, GpuError> {
        let mut previous: Option<(&'a Pipeline, &'a Bindings)> = None;
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
            let call = self.call(&draw.pipeline.inner, &draw.bindings, &draw.push, previous)?;
            previous = Some((call.pipeline, &draw.bindings));
            if let Vertices::Indexed { indices, range } = &draw.vertices {
                self.index(indices, range.clone())?;
            }
            calls.push(DrawCall { call, vertices: &draw.vertices, instances: draw.instances.clone() });
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

    /// Resolves a pipeline's bindings and push constants, given those of the draw before.
    fn call<'a>(
        &mut self,
        pipeline: &'a Arc<Pipeline>,
        bindings: &'a Bindings,
        push: &'a [u8],
        previous: Option<(&'a Pipeline, &'a Bindings)>,
    ) -> Result<Call<'a>, GpuError> {
        let wanted = pipeline.interface().push_size;
        if push.len() as u64 != u64::from(wanted) {
            let (pass, pipeline) = (self.name.to_owned(), pipeline.name.clone());
            return Err(GpuError::PushConstants { pass, pipeline, given: push.len(), wanted });
        }
        let same =
            |(known, bound): (&Pipeline, &Bindings)| std::ptr::eq(known, &raw const **pipeline) && bound.same(bindings);
        if previous.is_some_and(same) {
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

    /// Resolves one binding of a pipeline and takes note of what the pipeline does with it.
    fn descriptor(&mut self, binding: &LayoutBinding, bindings: &Bindings) -> Result<Descriptor, GpuError> {
        let Some(bound) = bindings.get(binding.binding) else {
            return Err(GpuError::MissingBinding {
                pass: self.name.to_owned(),
                shader: binding.shader.clone(),
                binding: binding.binding,
                name: binding.name.clone(),
            });
        };
        let (usage, access) = match binding.kind {
            BufferKind::Storage => (BufferUsage::STORAGE, vk::AccessFlags2::SHADER_STORAGE_READ),
            BufferKind::Uniform => (BufferUsage::UNIFORM, vk::AccessFlags2::UNIFORM_READ),
        };
        bound.buffer.require(usage, &format!("binding {} of pass {:?}", binding.binding, self.name))?;
        let (offset, range) = self.extent(binding, bound)?;
        let read = Scope::new(binding.reads, access);
        let write = Scope::new(binding.writes, vk::AccessFlags2::SHADER_STORAGE_WRITE);
        self.touch_buffer(&bound.buffer, read, write)?;
        Ok(Descriptor { binding: binding.binding, kind: binding.kind, buffer: bound.buffer.raw(), offset, range })
    }

    /// Offset and length of what is bound, checked against the buffer and the device.
    fn extent(&self, binding: &LayoutBinding, bound: &Bound) -> Result<(u64, u64), GpuError> {
        let limits = &self.device.info().limits;
        let (limit, alignment) = match binding.kind {
            BufferKind::Storage => (limits.max_storage_buffer_range, limits.storage_buffer_alignment),
            BufferKind::Uniform => (limits.max_uniform_buffer_range, limits.uniform_buffer_alignment),
        };
        let (offset, range) = match bound.range.clone() {
            None => (0, bound.buffer.real_size()),
            Some(range) => {
                bound.buffer.check(range.clone(), self.name)?;
                (range.start, range.end - range.start)
            }
        };
        if range == 0 || offset.checked_rem(alignment).unwrap_or(0) != 0 {
            let number = binding.binding;
            let reason =
                format!("binding {number} is empty or starts at byte {offset}, not at a multiple of {alignment}");
            return Err(self.refuse(&reason));
        }
        if range > limit {
            let what = format!(
                "bytes of buffer {:?} at binding {} of pass {:?}",
                bound.buffer.name(),
                binding.binding,
                self.name
            );
            return Err(GpuError::Limit { what, value: range, limit });
        }
        Ok((offset, range))
    }

    fn copy_buffer(
        &mut self,
        source: &Buffer,
        range: Range<u64>,
        target: &Buffer,
        offset: u64,
    ) -> Result<Work<'static>, GpuError> {
        source.check(range.clone(), self.name)?;
        let size = range.end - range.start;
        let end = offset.saturating_add(size);
        target.check(offset..end, self.name)?;
        if source == target && range.start < end && offset < range.end {
            return Err(self.refuse("the copied range overlaps its target"));
        }
        let copy = vk::PipelineStageFlags2::COPY;
        self.touch_buffer(source, Scope::new(copy, vk::AccessFlags2::TRANSFER_READ), Scope::default())?;
        self.touch_buffer(target, Scope::default(), Scope::new(copy, vk::AccessFlags2::TRANSFER_WRITE))?;
        let region = vk::BufferCopy2::default().src_offset(range.start).dst_offset(offset).size(size);
        Ok(Work::CopyBuffer { source: source.raw(), target: target.raw(), region })
    }

    fn copy_image<'a>(&mut self, image: &'a Image, buffer: &Buffer) -> Result<Work<'a>, GpuError> {
        buffer.check(0..image.byte_size(), self.name)?;
        if image.layout() == vk::ImageLayout::UNDEFINED && !self.kept.images.contains_key(&image.id()) {
            return Err(self.refuse("nothing was drawn into the image yet"));
        }
        let copy = vk::PipelineStageFlags2::COPY;
        let (read, write) =
            (Scope::new(copy, vk::AccessFlags2::TRANSFER_READ), Scope::new(copy, vk::AccessFlags2::TRANSFER_WRITE));
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        self.touch_image(image, ImageUsage::COPY_SRC, read, Scope::default(), layout)?;
        self.touch_buffer(buffer, Scope::default(), write)?;
        Ok(Work::CopyImage { image, buffer: buffer.raw() })
    }

    fn touch_buffer(&mut self, buffer: &Buffer, read: Scope, write: Scope) -> Result<(), GpuError> {
        if !buffer.device().is(self.device) {
            return Err(self.foreign(buffer.name()));
        }
        self.kept.buffers.entry(buffer.id()).or_insert_with(|| buffer.clone());
        self.uses.add(Use { resource: buffer.id(), read, write, layout: None });
        Ok(())
    }

    fn touch_image(
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
        if self.uses.contains(image.id()) {
            return Err(self.refuse(&format!("it uses image {:?} in two roles", image.name())));
        }
        self.kept.images.entry(image.id()).or_insert_with(|| image.clone());
        self.uses.add(Use { resource: image.id(), read, write, layout: Some(layout) });
        Ok(())
    }

    fn foreign(&self, name: &str) -> GpuError {
        self.refuse(&format!("{name:?} belongs to another device"))
    }

    fn refuse(&self, reason: &str) -> GpuError {
        GpuError::Pass { pass: self.name.to_owned(), reason: reason.to_owned() }
    }
}
