//! Checks and resolves copies.

use std::ops::Range;

use ash::vk;

use crate::{Buffer, GpuError, Image, ImageRegion, ImageUsage, Memory, barrier::Scope};

use super::{Work, planner::Planner};

/// What a copy does.
const COPY: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::COPY;
const READ: vk::AccessFlags2 = vk::AccessFlags2::TRANSFER_READ;
const WRITE: vk::AccessFlags2 = vk::AccessFlags2::TRANSFER_WRITE;

/// What Vulkan calls an update, by whatever stage: specifications differ on whether it is a copy.
const UPDATE: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::ALL_TRANSFER;
/// Most bytes that a command buffer holds itself.
const MAX_UPDATE: usize = 65_536;

impl Planner<'_> {
    /// Little data goes into the command buffer, more into a staging buffer of its own.
    pub(super) fn write<'a>(&mut self, data: &'a [u8], target: &Buffer, offset: u64) -> Result<Work<'a>, GpuError> {
        let size = data.len() as u64;
        target.check(offset..offset.saturating_add(size), self.name)?;
        if !offset.is_multiple_of(4) || !size.is_multiple_of(4) {
            return Err(self.refuse(&format!("it writes {size} bytes at {offset}, not both multiples of 4")));
        }
        if data.len() > MAX_UPDATE {
            let staging = self.device.staging(target.name(), size, Memory::Upload)?;
            staging.write(0, data)?;
            return self.copy_buffer(&staging, 0..size, target, offset);
        }
        self.touch_buffer(target, Scope::default(), Scope::new(UPDATE, WRITE))?;
        Ok(Work::Write { target: target.raw(), offset, data })
    }

    pub(super) fn copy_buffer(
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
        self.touch_buffer(source, Scope::new(COPY, READ), Scope::default())?;
        self.touch_buffer(target, Scope::default(), Scope::new(COPY, WRITE))?;
        let region = vk::BufferCopy2::default().src_offset(range.start).dst_offset(offset).size(size);
        Ok(Work::CopyBuffer { source: source.raw(), target: target.raw(), region })
    }

    pub(super) fn copy_from_image<'a>(
        &mut self,
        source: &'a ImageRegion,
        buffer: &Buffer,
        offset: u64,
    ) -> Result<Work<'a>, GpuError> {
        self.check_region(source, buffer, offset)?;
        if self.is_blank(&source.image) {
            return Err(self.refuse("nothing was drawn into the image yet"));
        }
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        self.touch_image(&source.image, ImageUsage::COPY_SRC, Scope::new(COPY, READ), Scope::default(), layout)?;
        self.touch_buffer(buffer, Scope::default(), Scope::new(COPY, WRITE))?;
        Ok(Work::CopyFromImage { source, buffer: buffer.raw(), offset })
    }

    pub(super) fn copy_to_image<'a>(
        &mut self,
        buffer: &Buffer,
        offset: u64,
        target: &'a ImageRegion,
    ) -> Result<Work<'a>, GpuError> {
        self.check_region(target, buffer, offset)?;
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        self.touch_image(&target.image, ImageUsage::COPY_DST, Scope::default(), Scope::new(COPY, WRITE), layout)?;
        self.touch_buffer(buffer, Scope::new(COPY, READ), Scope::default())?;
        Ok(Work::CopyToImage { buffer: buffer.raw(), offset, target })
    }

    /// Fails unless image and buffer have room for the texels.
    fn check_region(&self, region: &ImageRegion, buffer: &Buffer, offset: u64) -> Result<(), GpuError> {
        if region.rect.is_empty() || !region.exists() {
            let (rect, level, image) = (region.rect, region.level, region.image.name());
            return Err(self.refuse(&format!("{rect:?} of level {level} is empty or reaches beyond image {image:?}")));
        }
        let texel = region.image.format().bytes_per_texel();
        if !offset.is_multiple_of(texel) {
            return Err(self.refuse(&format!("its offset of {offset} bytes is not a multiple of a texel's {texel}")));
        }
        buffer.check(offset..offset.saturating_add(region.byte_size()), self.name)
    }

    /// Level 0 is read, and every other one written and then read; `execute` orders them among themselves. The image begins and
    /// ends in one layout.
    pub(super) fn fill_levels<'a>(&mut self, image: &'a Image) -> Result<Work<'a>, GpuError> {
        if self.is_blank(image) {
            return Err(self.refuse("nothing was drawn into the image yet"));
        }
        if !image.blits() {
            let format = image.format();
            return Err(self.refuse(&format!("the device cannot average texels of {format:?}: copy to each level")));
        }
        let blit = vk::PipelineStageFlags2::BLIT;
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let usage = ImageUsage::COPY_SRC | ImageUsage::COPY_DST;
        self.touch_image(image, usage, Scope::new(blit, READ), Scope::new(blit, WRITE), layout)?;
        Ok(Work::FillLevels { image })
    }
}
