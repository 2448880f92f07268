//! The renderer's frames: two under way at any time.

use osculate::gpu::ash::vk;
use osculate::gpu::{CallerSet, Device, Draw, EncodeDraws, Encoded, Recording};

use crate::FOG;
use crate::common::Result;
use crate::vulkan::{COLOR, DEPTH, HostBuffer, Picture, Vulkan, range};

/// What one frame holds while the GPU works on it.
struct Slot {
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    /// What the commands of the library use.
    encoded: Vec<Encoded>,
}

pub(crate) struct Frames {
    size: [u32; 2],
    pool: vk::CommandPool,
    slots: Vec<Slot>,
    next: usize,
    color: Picture,
    depth: Picture,
    texels: HostBuffer,
}

impl Frames {
    pub(crate) fn new(vulkan: &Vulkan, size: [u32; 2]) -> Result<Self> {
        let color = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
        let color = vulkan.picture(COLOR, size, color)?;
        let depth = vulkan.picture(DEPTH, size, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT)?;
        let bytes = 4 * size[0] as usize * size[1] as usize;
        let texels = vulkan.host_buffer(bytes, vk::BufferUsageFlags::TRANSFER_DST)?;
        // SAFETY: plain parameters; `take` destroys everything.
        unsafe {
            let flags = vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER;
            let info = vk::CommandPoolCreateInfo::default().flags(flags).queue_family_index(vulkan.family);
            let pool = vulkan.device.create_command_pool(&info, None)?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(2);
            let mut slots = Vec::new();
            for commands in vulkan.device.allocate_command_buffers(&info)? {
                let info = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
                slots.push(Slot { commands, fence: vulkan.device.create_fence(&info, None)?, encoded: Vec::new() });
            }
            Ok(Self { size, pool, slots, next: 0, color, depth, texels })
        }
    }

    /// Draws a frame. `advance` records what changes, and says what is drawn then.
    pub(crate) fn draw(
        &mut self,
        vulkan: &Vulkan,
        device: &Device,
        set: vk::DescriptorSet,
        advance: impl FnOnce(&mut Recording) -> Result<Vec<Draw>>,
    ) -> Result<()> {
        let slot = self.next % self.slots.len();
        self.next += 1;
        self.begin(vulkan, slot)?;
        let commands = self.slots[slot].commands;
        let mut recording = Recording::new();
        let draws = advance(&mut recording)?;
        // SAFETY: the command buffer is recording, outside of a rendering; it runs once, on this queue, in this order; the slot keeps what it
        // uses until its fence is signalled.
        let update = unsafe { device.encode(commands, &recording)? };
        self.slots[slot].encoded.push(update);
        self.begin_rendering(vulkan, commands);
        let [width, height] = self.size.map(|pixels| pixels as f32);
        let desc = EncodeDraws {
            draws: &draws,
            viewport: vk::Viewport { width, height, max_depth: 1.0, ..vk::Viewport::default() },
            area: self.size.into(),
            caller_set: Some(CallerSet { set, dynamic_offsets: &[] }),
        };
        // SAFETY: as above; the rendering has the attachments that the material was made for, and the set is of its layout.
        let drawn = unsafe { device.encode_draws(commands, &desc)? };
        self.slots[slot].encoded.push(drawn);
        self.submit(vulkan, slot)
    }

    /// Waits until the slot's last frame is done, and lets go of what it used.
    fn begin(&mut self, vulkan: &Vulkan, slot: usize) -> Result<()> {
        let slot = &mut self.slots[slot];
        // SAFETY: the fence and the command buffer are this slot's alone.
        unsafe {
            vulkan.device.wait_for_fences(&[slot.fence], true, u64::MAX)?;
            vulkan.device.reset_fences(&[slot.fence])?;
            slot.encoded.clear();
            let flags = vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT;
            let info = vk::CommandBufferBeginInfo::default().flags(flags);
            vulkan.device.begin_command_buffer(slot.commands, &info)?;
        }
        Ok(())
    }

    fn begin_rendering(&self, vulkan: &Vulkan, commands: vk::CommandBuffer) {
        let (color, depth) = (vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL, vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL);
        self.change(vulkan, commands, COLOR, [vk::ImageLayout::UNDEFINED, color]);
        self.change(vulkan, commands, DEPTH, [vk::ImageLayout::UNDEFINED, depth]);
        let [r, g, b, _] = FOG;
        let colors = [vk::RenderingAttachmentInfo::default()
            .image_view(self.color.view)
            .image_layout(color)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32: [r, g, b, 1.0] } })];
        let depth = vk::RenderingAttachmentInfo::default()
            .image_view(self.depth.view)
            .image_layout(depth)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::DONT_CARE)
            .clear_value(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 1.0, stencil: 0 } });
        let [width, height] = self.size;
        let area = vk::Rect2D { extent: vk::Extent2D { width, height }, ..vk::Rect2D::default() };
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&colors)
            .depth_attachment(&depth);
        // SAFETY: the pictures are in the layouts that were named.
        unsafe { vulkan.device.cmd_begin_rendering(commands, &info) }
    }

    fn submit(&self, vulkan: &Vulkan, slot: usize) -> Result<()> {
        let slot = &self.slots[slot];
        let commands = [slot.commands];
        // SAFETY: a rendering has begun; no other thread uses the queue.
        unsafe {
            vulkan.device.cmd_end_rendering(slot.commands);
            vulkan.device.end_command_buffer(slot.commands)?;
            let info = vk::SubmitInfo::default().command_buffers(&commands);
            Ok(vulkan.device.queue_submit(vulkan.queue, &[info], slot.fence)?)
        }
    }

    /// Waits for all frames and reads the last one: rows from the top, four bytes a pixel.
    pub(crate) fn finish(&mut self, vulkan: &Vulkan) -> Result<Vec<u8>> {
        let fences: Vec<vk::Fence> = self.slots.iter().map(|slot| slot.fence).collect();
        // SAFETY: the fences are alive, each signalled or on its way.
        unsafe { vulkan.device.wait_for_fences(&fences, true, u64::MAX)? };
        self.slots.iter_mut().for_each(|slot| slot.encoded.clear());
        self.begin(vulkan, 0)?;
        let commands = self.slots[0].commands;
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        self.change(vulkan, commands, COLOR, [vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL, layout]);
        let [width, height] = self.size;
        let region = vk::BufferImageCopy::default()
            .image_subresource(
                vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1),
            )
            .image_extent(vk::Extent3D { width, height, depth: 1 });
        let submitted = [commands];
        // SAFETY: the buffer takes all texels; nothing else is under way.
        unsafe {
            let (from, to) = (self.color.image, self.texels.buffer);
            vulkan.device.cmd_copy_image_to_buffer(commands, from, layout, to, &[region]);
            vulkan.device.end_command_buffer(commands)?;
            let info = vk::SubmitInfo::default().command_buffers(&submitted);
            vulkan.device.queue_submit(vulkan.queue, &[info], self.slots[0].fence)?;
            vulkan.device.queue_wait_idle(vulkan.queue)?;
        }
        Ok(self.texels.bytes().to_vec())
    }

    /// Changes a picture's layout, after everything before and before everything after.
    fn change(
        &self,
        vulkan: &Vulkan,
        commands: vk::CommandBuffer,
        format: vk::Format,
        [from, to]: [vk::ImageLayout; 2],
    ) {
        let image = if format == DEPTH { self.depth.image } else { self.color.image };
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        let barrier = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(all)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(all)
            .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
            .old_layout(from)
            .new_layout(to)
            .image(image)
            .subresource_range(range(format))];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barrier);
        // SAFETY: outside of a rendering.
        unsafe { vulkan.device.cmd_pipeline_barrier2(commands, &info) }
    }

    /// Gives pictures and buffers back, to be destroyed; everything was waited for.
    pub(crate) fn take(self, vulkan: &Vulkan) -> (Vec<Picture>, Vec<HostBuffer>) {
        // SAFETY: nothing is in use.
        unsafe {
            self.slots.iter().for_each(|slot| vulkan.device.destroy_fence(slot.fence, None));
            vulkan.device.destroy_command_pool(self.pool, None);
        }
        (vec![self.color, self.depth], vec![self.texels])
    }
}
