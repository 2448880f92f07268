//! Images that the host fills.

use bytemuck::NoUninit;

use crate::{BufferDesc, BufferUsage, Device, GpuError, Image, ImageDesc, ImageRegion, ImageUsage, Memory, Recording};

impl Device {
    /// Makes an image that holds `texels`, rows from the top, tightly packed, in the bytes of its format; further levels are
    /// made by halving. Usages that this takes are added. Goes through a staging buffer and waits for it.
    pub fn upload_image<T: NoUninit>(&self, desc: &ImageDesc<'_>, texels: &[T]) -> Result<Image, GpuError> {
        let levels = if desc.levels > 1 { ImageUsage::COPY_SRC } else { ImageUsage::empty() };
        let image = self.image(&ImageDesc { usage: desc.usage | ImageUsage::COPY_DST | levels, ..*desc })?;
        let mut recording = Recording::new();
        self.record_write(&mut recording, image.level(0), texels)?;
        if desc.levels > 1 {
            recording.fill_levels(&image);
        }
        self.run(&recording)?;
        Ok(image)
    }

    /// Replaces texels of an image made with [`ImageUsage::COPY_DST`], in place of those that are there. Goes through a
    /// staging buffer and waits for it.
    pub fn write_image<T: NoUninit>(&self, region: ImageRegion, texels: &[T]) -> Result<(), GpuError> {
        let mut recording = Recording::new();
        self.record_write(&mut recording, region, texels)?;
        self.run(&recording).map(drop)
    }

    /// Records a copy of texels from a staging buffer of their own.
    fn record_write<T: NoUninit>(
        &self,
        recording: &mut Recording,
        region: ImageRegion,
        texels: &[T],
    ) -> Result<(), GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(texels);
        let (given, wanted) = (bytes.len() as u64, region.byte_size());
        if given != wanted {
            let what = "an upload".to_owned();
            let reason = format!("{given} bytes of texels are given, {wanted} are needed");
            return Err(GpuError::ImageUsage { image: region.image.name().to_owned(), what, reason });
        }
        let name = format!("staging of {}", region.image.name());
        let desc = BufferDesc { name: &name, size: given, usage: BufferUsage::empty(), memory: Memory::Upload };
        let staging = self.buffer(&desc)?;
        staging.write(0, bytes)?;
        recording.copy_buffer_to_image(&staging, 0, region);
        Ok(())
    }
}
