//! From steps to commands. Dull on purpose: all decisions were made in `plan` and `barrier`.

use std::ffi::CString;

use ash::{ext::transform_feedback::DeviceFn, vk};

use crate::{
    CallerSet, CapturePass, ColorTarget, DepthTarget, Device, EncodeDraws, Format, Image, ImageRegion, Rect, Vertices,
    barrier::{Barriers, Scope},
    image::{layers, range},
    layout::descriptor_type,
    pipeline::Pipeline,
    plan::{Call, Content, Descriptor, DrawCall, Kept, Step, Work, runs},
    query::Queries,
};

/// Writes commands into one command buffer.
///
/// The safety of every block below rests on three facts that [`Encoder::new`]'s caller vouches for: the command buffer is in the
/// recording state and no other thread uses it; every handle belongs to `device` and is kept alive by the submission; and
/// `plan` has checked ranges, usages, formats and limits.
pub(crate) struct Encoder<'a> {
    device: &'a Device,
    commands: vk::CommandBuffer,
    kept: &'a Kept,
    queries: &'a Queries,
}

impl<'a> Encoder<'a> {
    /// # Safety
    /// `commands` is in the recording state, of `device`, and used by nobody else while the encoder lives. What `kept` and
    /// `queries` hold lives until the commands have run.
    pub(crate) unsafe fn new(
        device: &'a Device,
        commands: vk::CommandBuffer,
        kept: &'a Kept,
        queries: &'a Queries,
    ) -> Self {
        Self { device, commands, kept, queries }
    }

    /// Writes all steps, each behind its barriers, and the full barrier at the end.
    pub(crate) fn encode(&self, steps: &[Step<'_>], barriers: &[Barriers]) {
        if self.device.shared.raw.is_borrowed {
            // Commands of the caller's do not end with a full barrier.
            self.enter(vk::PipelineStageFlags2::ALL_COMMANDS);
        }
        self.reset_queries();
        self.timestamp(0);
        self.steps(steps, barriers);
        self.finish();
    }

    /// Writes all steps, each behind its barriers.
    pub(crate) fn steps(&self, steps: &[Step<'_>], barriers: &[Barriers]) {
        for ((index, step), barriers) in (0..).zip(steps).zip(barriers) {
            self.begin_label(&step.name);
            self.barriers(barriers);
            let statistics = self.queries.statistics(index);
            if let Some((pool, query)) = statistics {
                self.begin_query(pool, query);
            }
            self.work(index, &step.work);
            if let Some((pool, query)) = statistics {
                self.end_query(pool, query);
            }
            self.end_label();
            self.timestamp(index + 1);
        }
    }

    /// Orders what reads buffers and images of this device in a caller's commands so far before `stages` of what comes: nothing
    /// that was written there needs to be made visible any more.
    pub(crate) fn enter(&self, stages: vk::PipelineStageFlags2) {
        if !stages.is_empty() {
            let none = vk::AccessFlags2::NONE;
            let barrier = memory_barrier(Scope::new(CONSUMERS, none), Scope::new(stages, none));
            self.barrier(&vk::DependencyInfo::default().memory_barriers(&[barrier]));
        }
    }

    /// Makes what was written visible to all that can read it in a caller's commands from here on, and to the host.
    pub(crate) fn leave(&self, written: Scope) {
        if !written.stages.is_empty() {
            let access = vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE;
            let readers = Scope::new(CONSUMERS | vk::PipelineStageFlags2::HOST, access);
            self.barrier(&vk::DependencyInfo::default().memory_barriers(&[memory_barrier(written, readers)]));
        }
    }

    /// Writes draws into a rendering that somebody else has begun.
    pub(crate) fn draws_for_caller(&self, draws: &[DrawCall<'_>], desc: &EncodeDraws<'_>) {
        // SAFETY: see `Encoder`; whoever has begun the rendering vouches for the viewport.
        unsafe { self.device.raw().cmd_set_viewport(self.commands, 0, &[desc.viewport]) }
        self.set_scissor(desc.area);
        self.draws(draws, desc.area, desc.caller_set);
    }

    fn work(&self, index: u32, work: &Work<'_>) {
        match work {
            Work::Dispatch { call, groups } => self.dispatch(call, *groups),
            Work::Render { pass, area, draws } => {
                self.begin_rendering(pass.viewport, *area, pass.color.as_ref(), pass.depth.as_ref());
                self.draws(draws, *area, None);
                self.end_rendering();
            }
            Work::Capture { pass, size, draws, counter } => self.capture(index, pass, *size, draws, *counter),
            Work::Write { target, offset, data } => self.write(*target, *offset, data),
            Work::CopyBuffer { source, target, region } => self.copy_buffer(*source, *target, *region),
            Work::CopyFromImage { source, buffer, offset } => self.copy_from_image(source, *buffer, *offset),
            Work::CopyToImage { buffer, offset, target } => self.copy_to_image(*buffer, *offset, target),
            Work::FillLevels { image } => self.fill_levels(image),
        }
    }

    fn dispatch(&self, call: &Call<'_>, [x, y, z]: [u32; 3]) {
        self.bind_pipeline(call);
        self.bind_resources(call);
        // SAFETY: see `Encoder`; pipeline, descriptors and push constants were just set, and the counts are within limits.
        unsafe { self.device.raw().cmd_dispatch(self.commands, x, y, z) }
    }

    /// Draws within an area, to which the scissor is set.
    fn draws(&self, draws: &[DrawCall<'_>], area: Rect, caller_set: Option<CallerSet<'_>>) {
        let mut scissor = area;
        for run in runs(draws) {
            self.begin_label(&run[0].call.pipeline.name);
            self.bind_pipeline(&run[0].call);
            self.bind_caller_set(run[0].call.pipeline, caller_set);
            for draw in run {
                let wanted = draw.scissor.map_or(area, |scissor| scissor.intersection(area));
                if wanted != scissor {
                    scissor = wanted;
                    self.set_scissor(scissor);
                }
                self.draw(draw);
            }
            self.end_label();
        }
    }

    fn set_scissor(&self, scissor: Rect) {
        // SAFETY: see `Encoder`; the rectangle lies in the pass's area.
        unsafe { self.device.raw().cmd_set_scissor(self.commands, 0, &[scissor.raw()]) }
    }

    /// Draws with the pipeline that is bound.
    fn draw(&self, draw: &DrawCall<'_>) {
        self.bind_resources(&draw.call);
        if let Some(attributes) = draw.attributes {
            // SAFETY: see `Encoder`; the buffer was made for this.
            unsafe { self.device.raw().cmd_bind_vertex_buffers(self.commands, 0, &[attributes.raw()], &[0]) }
        }
        let (first_instance, instances) = (draw.instances.start, draw.instances.len() as u32);
        match draw.vertices {
            // SAFETY: see `Encoder`; pipeline, descriptors and push constants were just set.
            Vertices::Range(range) => unsafe {
                self.device.raw().cmd_draw(self.commands, range.len() as u32, instances, range.start, first_instance);
            },
            // SAFETY: as above; the range lies within the index buffer, and vertices come from buffers with robust access, so that any
            // index is harmless.
            Vertices::Indexed { indices, range } => unsafe {
                let raw = self.device.raw();
                raw.cmd_bind_index_buffer(self.commands, indices.raw(), 0, vk::IndexType::UINT32);
                raw.cmd_draw_indexed(self.commands, range.len() as u32, instances, range.start, 0, first_instance);
            },
        }
    }

    fn bind_pipeline(&self, call: &Call<'_>) {
        // SAFETY: see `Encoder`; no capture is in progress.
        unsafe {
            self.device.raw().cmd_bind_pipeline(self.commands, call.pipeline.bind_point, call.pipeline.raw.raw);
        }
    }

    /// Sets the caller's descriptor set, if the pipeline has one.
    fn bind_caller_set(&self, pipeline: &Pipeline, set: Option<CallerSet<'_>>) {
        let Some(CallerSet { set, dynamic_offsets }) = set.filter(|_| pipeline.layout.has_caller_set) else { return };
        let layout = pipeline.layout.raw.raw;
        // SAFETY: see `Encoder`; the caller vouches for the set, which fits the layout that it has given for the pipeline.
        unsafe {
            let raw = self.device.raw();
            raw.cmd_bind_descriptor_sets(self.commands, pipeline.bind_point, layout, 1, &[set], dynamic_offsets);
        }
    }

    /// Sets buffers and images, where they differ from those of the call before, and push constants.
    fn bind_resources(&self, call: &Call<'_>) {
        let layout = call.pipeline.layout.raw.raw;
        if let Some(descriptors) = call.descriptors.as_deref().filter(|descriptors| !descriptors.is_empty()) {
            let infos: Vec<DescriptorInfo> = descriptors.iter().map(|one| DescriptorInfo::new(one.content)).collect();
            let writes: Vec<_> =
                descriptors.iter().zip(&infos).map(|(one, info)| descriptor_write(one, info)).collect();
            let functions = &self.device.shared.push_descriptor;
            // SAFETY: see `Encoder`; the descriptors are those of the pipeline's own layout.
            unsafe {
                functions.cmd_push_descriptor_set(self.commands, call.pipeline.bind_point, layout, 0, &writes);
            }
        }
        if !call.push.is_empty() {
            let stages = call.pipeline.interface().push_stages;
            // SAFETY: see `Encoder`; the bytes are exactly those of the layout's range.
            unsafe { self.device.raw().cmd_push_constants(self.commands, layout, stages, 0, call.push) }
        }
    }

    fn begin_rendering(&self, viewport: Rect, area: Rect, color: Option<&ColorTarget>, depth: Option<&DepthTarget>) {
        let colors: Vec<_> = color.map(color_attachment).into_iter().collect();
        let depth = depth.map(depth_attachment);
        let mut info = vk::RenderingInfo::default().render_area(area.raw()).layer_count(1).color_attachments(&colors);
        if let Some(depth) = &depth {
            info = info.depth_attachment(depth);
        }
        let ([x, y], [width, height]) = (viewport.origin, viewport.size);
        let [x, y, width, height] = [x, y, width, height].map(|one| one as f32);
        let viewport = vk::Viewport { x, y, width, height, min_depth: 0.0, max_depth: 1.0 };
        let raw = self.device.raw();
        // SAFETY: see `Encoder`; the attachments live across the call and their images are in the named layouts.
        unsafe {
            raw.cmd_begin_rendering(self.commands, &info);
            raw.cmd_set_viewport(self.commands, 0, &[viewport]);
            raw.cmd_set_scissor(self.commands, 0, &[area.raw()]);
        }
    }

    fn end_rendering(&self) {
        // SAFETY: see `Encoder`; rendering has begun.
        unsafe { self.device.raw().cmd_end_rendering(self.commands) }
    }

    /// Captures draws one behind the other. No pipeline may be bound while a capture is in progress, so that it pauses where
    /// the pipeline changes and goes on from a counter.
    fn capture(&self, index: u32, pass: &CapturePass, size: u64, draws: &[DrawCall<'_>], counter: Option<vk::Buffer>) {
        // Without the extension there is no buffer to capture into, so that `plan` has refused the pass.
        let Some(feedback) = &self.device.shared.transform_feedback else { return };
        let query = self.queries.capture(index);
        if let Some((pool, query)) = query {
            self.begin_query(pool, query);
        }
        for (part, run) in runs(draws).enumerate() {
            if part > 0 {
                self.barrier(&vk::DependencyInfo::default().memory_barriers(&[capture_pause()]));
            }
            self.begin_rendering([1, 1].into(), [1, 1].into(), None, None);
            self.bind_pipeline(&run[0].call);
            self.begin_capture(feedback.fp(), pass, size, counter.filter(|_| part > 0));
            run.iter().for_each(|draw| self.draw(draw));
            self.end_capture(feedback.fp(), counter);
            self.end_rendering();
        }
        if let Some((pool, query)) = query {
            self.end_query(pool, query);
        }
    }

    /// Begins or, from a counter, resumes a capture.
    fn begin_capture(&self, functions: &DeviceFn, pass: &CapturePass, size: u64, counter: Option<vk::Buffer>) {
        let (buffer, offset) = (pass.buffer.raw(), pass.offset);
        let (count, counters) = counter_array(counter.as_ref());
        // SAFETY: see `Encoder`; buffer and counter have the usage; offset and size lie within the buffer; rendering has begun
        // and a pipeline that captures is bound. A counter has been written by the end of an earlier part.
        unsafe {
            (functions.cmd_bind_transform_feedback_buffers_ext)(self.commands, 0, 1, &buffer, &offset, &size);
            (functions.cmd_begin_transform_feedback_ext)(self.commands, 0, count, counters, std::ptr::null());
        }
    }

    /// Ends a capture, or pauses it with a counter.
    fn end_capture(&self, functions: &DeviceFn, counter: Option<vk::Buffer>) {
        let (count, counters) = counter_array(counter.as_ref());
        // SAFETY: see `Encoder`; capture has begun; the counter, if any, has the usage and four bytes.
        unsafe { (functions.cmd_end_transform_feedback_ext)(self.commands, 0, count, counters, std::ptr::null()) }
    }

    fn write(&self, target: vk::Buffer, offset: u64, data: &[u8]) {
        if !data.is_empty() {
            // SAFETY: see `Encoder`; there are at most 65 536 bytes, a multiple of 4, within the buffer; so is the offset.
            unsafe { self.device.raw().cmd_update_buffer(self.commands, target, offset, data) }
        }
    }

    fn copy_buffer(&self, source: vk::Buffer, target: vk::Buffer, region: vk::BufferCopy2<'_>) {
        if region.size == 0 {
            return;
        }
        let regions = [region];
        let info = vk::CopyBufferInfo2::default().src_buffer(source).dst_buffer(target).regions(&regions);
        // SAFETY: see `Encoder`; the ranges lie within the buffers and do not overlap.
        unsafe { self.device.raw().cmd_copy_buffer2(self.commands, &info) }
    }

    fn copy_from_image(&self, source: &ImageRegion, buffer: vk::Buffer, offset: u64) {
        let regions = [source.raw(offset)];
        let info = vk::CopyImageToBufferInfo2::default()
            .src_image(source.image.raw())
            .src_image_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL)
            .dst_buffer(buffer)
            .regions(&regions);
        // SAFETY: see `Encoder`; the buffer takes all texels of the image, which is in the named layout.
        unsafe { self.device.raw().cmd_copy_image_to_buffer2(self.commands, &info) }
    }

    fn copy_to_image(&self, buffer: vk::Buffer, offset: u64, target: &ImageRegion) {
        let regions = [target.raw(offset)];
        let info = vk::CopyBufferToImageInfo2::default()
            .src_buffer(buffer)
            .dst_image(target.image.raw())
            .dst_image_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
            .regions(&regions);
        // SAFETY: see `Encoder`; the buffer has all texels, the image has room for them and is in the named layout.
        unsafe { self.device.raw().cmd_copy_buffer_to_image2(self.commands, &info) }
    }

    /// Halves each level into the next. All levels are in the layout of a source; each changes to that of a target and back.
    fn fill_levels(&self, image: &Image) {
        for level in 1..image.levels() {
            self.barrier(&vk::DependencyInfo::default().image_memory_barriers(&[level_becomes_target(image, level)]));
            self.halve(image, level);
            self.barrier(&vk::DependencyInfo::default().image_memory_barriers(&[level_becomes_source(image, level)]));
        }
    }

    /// Fills a level from the one before.
    fn halve(&self, image: &Image, level: u32) {
        let corners = |level| {
            let [width, height] = image.level_size(level);
            // Sizes of images are far below 2^31.
            [vk::Offset3D::default(), vk::Offset3D { x: width as i32, y: height as i32, z: 1 }]
        };
        let regions = [vk::ImageBlit2::default()
            .src_subresource(layers(image.format(), level - 1))
            .src_offsets(corners(level - 1))
            .dst_subresource(layers(image.format(), level))
            .dst_offsets(corners(level))];
        let info = vk::BlitImageInfo2::default()
            .src_image(image.raw())
            .src_image_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL)
            .dst_image(image.raw())
            .dst_image_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
            .regions(&regions)
            .filter(vk::Filter::LINEAR);
        // SAFETY: see `Encoder`; the two levels exist and are in the named layouts, and the format can be filtered.
        unsafe { self.device.raw().cmd_blit_image2(self.commands, &info) }
    }

    /// Writes barriers alone.
    pub(crate) fn barriers(&self, barriers: &Barriers) {
        let memory: Vec<_> =
            barriers.memory.iter().map(|(source, destination)| memory_barrier(*source, *destination)).collect();
        let images: Vec<_> = barriers
            .images
            .iter()
            .filter_map(|one| {
                let image = self.kept.images.get(&one.image)?;
                let barrier = vk::ImageMemoryBarrier2::default()
                    .src_stage_mask(one.source.stages)
                    .src_access_mask(one.source.access)
                    .dst_stage_mask(one.destination.stages)
                    .dst_access_mask(one.destination.access)
                    .old_layout(one.from)
                    .new_layout(one.to)
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED);
                Some(barrier.image(image.raw()).subresource_range(image.range()))
            })
            .collect();
        if !memory.is_empty() || !images.is_empty() {
            self.barrier(&vk::DependencyInfo::default().memory_barriers(&memory).image_memory_barriers(&images));
        }
    }

    /// Orders everything before against everything after, reads by the host too.
    fn finish(&self) {
        let source = Scope { stages: vk::PipelineStageFlags2::ALL_COMMANDS, access: vk::AccessFlags2::MEMORY_WRITE };
        let destination = Scope {
            stages: vk::PipelineStageFlags2::ALL_COMMANDS | vk::PipelineStageFlags2::HOST,
            access: vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
        };
        self.barrier(&vk::DependencyInfo::default().memory_barriers(&[memory_barrier(source, destination)]));
    }

    fn barrier(&self, info: &vk::DependencyInfo<'_>) {
        // SAFETY: see `Encoder`; no rendering is in progress.
        unsafe { self.device.raw().cmd_pipeline_barrier2(self.commands, info) }
    }

    fn reset_queries(&self) {
        for (pool, count) in self.queries.pools() {
            // SAFETY: see `Encoder`; the pool has so many queries.
            unsafe { self.device.raw().cmd_reset_query_pool(self.commands, pool, 0, count) }
        }
    }

    fn timestamp(&self, index: u32) {
        if let Some(pool) = self.queries.timestamps() {
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            // SAFETY: see `Encoder`; the pool has a query for the start and for the end of each pass, all reset.
            unsafe { self.device.raw().cmd_write_timestamp2(self.commands, stage, pool, index) }
        }
    }

    fn begin_query(&self, pool: vk::QueryPool, query: u32) {
        // SAFETY: see `Encoder`; the query was reset and belongs to one pass alone.
        unsafe { self.device.raw().cmd_begin_query(self.commands, pool, query, vk::QueryControlFlags::empty()) }
    }

    fn end_query(&self, pool: vk::QueryPool, query: u32) {
        // SAFETY: see `Encoder`; the query has begun.
        unsafe { self.device.raw().cmd_end_query(self.commands, pool, query) }
    }

    fn begin_label(&self, name: &str) {
        if let (Some(debug), Ok(name)) = (&self.device.shared.raw.debug, CString::new(name)) {
            let info = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: see `Encoder`; the name lives across the call.
            unsafe { debug.cmd_begin_debug_utils_label(self.commands, &info) }
        }
    }

    fn end_label(&self) {
        if let Some(debug) = &self.device.shared.raw.debug {
            // SAFETY: see `Encoder`; a label has begun.
            unsafe { debug.cmd_end_debug_utils_label(self.commands) }
        }
    }
}

/// Where commands of this crate use buffers and images that earlier ones have written or read: everywhere but in attachments,
/// which are nobody else's business.
const CONSUMERS: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::from_raw(
    vk::PipelineStageFlags2::INDEX_INPUT.as_raw()
        | vk::PipelineStageFlags2::VERTEX_ATTRIBUTE_INPUT.as_raw()
        | vk::PipelineStageFlags2::PRE_RASTERIZATION_SHADERS.as_raw()
        | vk::PipelineStageFlags2::FRAGMENT_SHADER.as_raw()
        | vk::PipelineStageFlags2::COMPUTE_SHADER.as_raw()
        | vk::PipelineStageFlags2::ALL_TRANSFER.as_raw(),
);

/// What stands between two parts of a capture: the second continues where the first ends, by the counter.
fn capture_pause() -> vk::MemoryBarrier2<'static> {
    let stage = vk::PipelineStageFlags2::TRANSFORM_FEEDBACK_EXT;
    let writes =
        vk::AccessFlags2::TRANSFORM_FEEDBACK_WRITE_EXT | vk::AccessFlags2::TRANSFORM_FEEDBACK_COUNTER_WRITE_EXT;
    let source = Scope::new(stage, writes);
    let reads = vk::AccessFlags2::TRANSFORM_FEEDBACK_COUNTER_READ_EXT;
    memory_barrier(source, Scope::new(stage | vk::PipelineStageFlags2::DRAW_INDIRECT, writes | reads))
}

/// A counter as the functions of transform feedback take it: an array of at most one.
fn counter_array(counter: Option<&vk::Buffer>) -> (u32, *const vk::Buffer) {
    counter.map_or((0, std::ptr::null()), |counter| (1, std::ptr::from_ref(counter)))
}

/// What a descriptor write points to: one of them is meant, by the kind of the descriptor.
#[derive(Default)]
struct DescriptorInfo {
    buffer: [vk::DescriptorBufferInfo; 1],
    texels: [vk::BufferView; 1],
    image: [vk::DescriptorImageInfo; 1],
}

impl DescriptorInfo {
    fn new(content: Content) -> Self {
        match content {
            Content::Buffer { buffer, offset, range } => {
                Self { buffer: [vk::DescriptorBufferInfo { buffer, offset, range }], ..Self::default() }
            }
            Content::Texels { view } => Self { texels: [view], ..Self::default() },
            Content::Image { view, sampler, layout } => {
                let image = vk::DescriptorImageInfo { image_view: view, sampler, image_layout: layout };
                Self { image: [image], ..Self::default() }
            }
        }
    }
}

fn descriptor_write<'i>(one: &Descriptor, info: &'i DescriptorInfo) -> vk::WriteDescriptorSet<'i> {
    let write = vk::WriteDescriptorSet::default().dst_binding(one.binding).descriptor_type(descriptor_type(one.kind));
    match one.content {
        Content::Buffer { .. } => write.buffer_info(&info.buffer),
        Content::Texels { .. } => write.texel_buffer_view(&info.texels),
        Content::Image { .. } => write.image_info(&info.image),
    }
}

/// One level goes from source to target; what is in it does not matter.
fn level_becomes_target(image: &Image, level: u32) -> vk::ImageMemoryBarrier2<'static> {
    let (from, to) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
    let blit = vk::PipelineStageFlags2::BLIT;
    vk::ImageMemoryBarrier2::default()
        .src_stage_mask(blit)
        .dst_stage_mask(blit)
        .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
        .old_layout(from)
        .new_layout(to)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .image(image.raw())
        .subresource_range(range(image.format(), level..level + 1))
}

/// One level goes from target, filled, to source.
fn level_becomes_source(image: &Image, level: u32) -> vk::ImageMemoryBarrier2<'static> {
    level_becomes_target(image, level)
        .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
        .dst_access_mask(vk::AccessFlags2::TRANSFER_READ)
        .old_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
        .new_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL)
}

fn memory_barrier(source: Scope, destination: Scope) -> vk::MemoryBarrier2<'static> {
    vk::MemoryBarrier2::default()
        .src_stage_mask(source.stages)
        .src_access_mask(source.access)
        .dst_stage_mask(destination.stages)
        .dst_access_mask(destination.access)
}

fn load_op(cleared: bool) -> vk::AttachmentLoadOp {
    if cleared { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD }
}

fn color_attachment(target: &ColorTarget) -> vk::RenderingAttachmentInfo<'static> {
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let info = vk::RenderingAttachmentInfo::default()
        .image_view(target.image.view())
        .image_layout(layout)
        .load_op(load_op(target.clear.is_some()))
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { color: clear_color(target) });
    match &target.resolve {
        None => info,
        Some(resolve) => {
            // Integers have no average.
            let integer = resolve.format() == Format::R32Uint;
            let mode = if integer { vk::ResolveModeFlags::SAMPLE_ZERO } else { vk::ResolveModeFlags::AVERAGE };
            info.resolve_mode(mode).resolve_image_view(resolve.view()).resolve_image_layout(layout)
        }
    }
}

fn clear_color(target: &ColorTarget) -> vk::ClearColorValue {
    let float32 = target.clear.unwrap_or_default();
    if target.image.format() == Format::R32Uint {
        vk::ClearColorValue { uint32: float32.map(|value| value as u32) }
    } else {
        vk::ClearColorValue { float32 }
    }
}

fn depth_attachment(target: &DepthTarget) -> vk::RenderingAttachmentInfo<'static> {
    let depth = target.clear.unwrap_or_default();
    vk::RenderingAttachmentInfo::default()
        .image_view(target.image.view())
        .image_layout(vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL)
        .load_op(load_op(target.clear.is_some()))
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth, stencil: 0 } })
}
