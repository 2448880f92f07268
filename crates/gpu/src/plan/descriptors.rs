//! Checks and resolves what is bound to a pipeline.

use ash::vk;

use crate::{
    Bindings, Buffer, BufferUsage, Format, GpuError, Image, ImageUsage, Numbers, ResourceKind, Sampler, TexelFormat,
    barrier::Scope, bindings::Bound, layout::LayoutBinding,
};

use super::{Content, Descriptor, planner::Planner};

impl Planner<'_> {
    /// Resolves one binding of a pipeline and takes note of what the pipeline does with it.
    pub(super) fn descriptor(&mut self, binding: &LayoutBinding, bindings: &Bindings) -> Result<Descriptor, GpuError> {
        let Some(bound) = bindings.get(binding.binding) else {
            return Err(GpuError::MissingBinding {
                pass: self.name.to_owned(),
                shader: binding.shader.clone(),
                binding: binding.binding,
                name: binding.name.clone(),
            });
        };
        let content = match (binding.kind, bound) {
            (ResourceKind::StorageBuffer | ResourceKind::UniformBuffer, Bound::Buffer { buffer, range }) => {
                self.bind_buffer(binding, buffer, range.clone())?
            }
            (ResourceKind::TexelBuffer(numbers), Bound::Texels { buffer, format }) => {
                self.bind_texels(binding, buffer, *format, numbers)?
            }
            (ResourceKind::Texture(numbers), Bound::Texture { image, sampler }) => {
                self.bind_texture(binding, image, sampler, numbers)?
            }
            (ResourceKind::StorageImage(format), Bound::StorageImage { image }) => {
                self.bind_storage_image(binding, image, format)?
            }
            _ => return Err(self.mismatch(binding, &format!("is {}", bound.describe()))),
        };
        Ok(Descriptor { binding: binding.binding, kind: binding.kind, content })
    }

    /// What is bound is not what the shader declares.
    fn mismatch(&self, binding: &LayoutBinding, found: &str) -> GpuError {
        let LayoutBinding { binding: number, kind, shader, name, .. } = binding;
        self.refuse(&format!("binding {number} {found}, but shader {shader:?} declares {name:?} as a {kind}"))
    }

    fn bind_buffer(
        &mut self,
        binding: &LayoutBinding,
        buffer: &Buffer,
        bytes: Option<std::ops::Range<u64>>,
    ) -> Result<Content, GpuError> {
        let (usage, access) = match binding.kind {
            ResourceKind::UniformBuffer => (BufferUsage::UNIFORM, vk::AccessFlags2::UNIFORM_READ),
            _ => (BufferUsage::STORAGE, vk::AccessFlags2::SHADER_STORAGE_READ),
        };
        buffer.require(usage, &format!("binding {} of pass {:?}", binding.binding, self.name))?;
        let (offset, range) = self.extent(binding, buffer, bytes)?;
        let read = Scope::new(binding.reads, access);
        let write = Scope::new(binding.writes, vk::AccessFlags2::SHADER_STORAGE_WRITE);
        self.touch_buffer(buffer, read, write)?;
        Ok(Content::Buffer { buffer: buffer.raw(), offset, range })
    }

    fn bind_texels(
        &mut self,
        binding: &LayoutBinding,
        buffer: &Buffer,
        format: TexelFormat,
        numbers: Numbers,
    ) -> Result<Content, GpuError> {
        if format.numbers() != numbers {
            return Err(self.mismatch(binding, &format!("is buffer {:?} as {format:?}", buffer.name())));
        }
        let what = format!("binding {} of pass {:?}", binding.binding, self.name);
        buffer.require(BufferUsage::TEXELS, &what)?;
        let view = buffer.texels(format, &what)?;
        self.touch_buffer(buffer, Scope::new(binding.reads, vk::AccessFlags2::SHADER_SAMPLED_READ), Scope::default())?;
        Ok(Content::Texels { view })
    }

    /// Offset and length of what is bound, checked against the buffer and the device.
    fn extent(
        &self,
        binding: &LayoutBinding,
        buffer: &Buffer,
        bytes: Option<std::ops::Range<u64>>,
    ) -> Result<(u64, u64), GpuError> {
        let limits = &self.device.info().limits;
        let (limit, alignment) = match binding.kind {
            ResourceKind::UniformBuffer => (limits.max_uniform_buffer_range, limits.uniform_buffer_alignment),
            _ => (limits.max_storage_buffer_range, limits.storage_buffer_alignment),
        };
        let (offset, range) = match bytes {
            None => (0, buffer.real_size()),
            Some(range) => {
                buffer.check(range.clone(), self.name)?;
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
            let what =
                format!("bytes of buffer {:?} at binding {} of pass {:?}", buffer.name(), binding.binding, self.name);
            return Err(GpuError::Limit { what, value: range, limit });
        }
        Ok((offset, range))
    }

    fn bind_texture(
        &mut self,
        binding: &LayoutBinding,
        image: &Image,
        sampler: &Sampler,
        numbers: Numbers,
    ) -> Result<Content, GpuError> {
        let format = image.format();
        if format.numbers() != numbers {
            return Err(self.mismatch(binding, &format!("is image {:?} of {format:?}", image.name())));
        }
        if sampler.is_linear() && !image.filters() {
            let (sampler, image) = (sampler.name(), image.name());
            let reason =
                format!("sampler {sampler:?} filters, which the device cannot do with {format:?} of {image:?}");
            return Err(self.refuse(&reason));
        }
        if self.is_blank(image) {
            return Err(self.refuse(&format!("it samples image {:?}, but nothing filled that yet", image.name())));
        }
        if !sampler.device().is(self.device) {
            return Err(self.foreign(sampler.name()));
        }
        let layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let read = Scope::new(binding.reads, vk::AccessFlags2::SHADER_SAMPLED_READ);
        self.touch_image(image, ImageUsage::SAMPLED, read, Scope::default(), layout)?;
        self.kept.keep_sampler(sampler);
        Ok(Content::Image { view: image.levels_view(), sampler: sampler.raw(), layout })
    }

    fn bind_storage_image(
        &mut self,
        binding: &LayoutBinding,
        image: &Image,
        format: Format,
    ) -> Result<Content, GpuError> {
        if image.format() != format {
            return Err(self.mismatch(binding, &format!("is image {:?} of {:?}", image.name(), image.format())));
        }
        if binding.writes.is_empty() && self.is_blank(image) {
            return Err(self.refuse(&format!("it reads image {:?}, but nothing filled that yet", image.name())));
        }
        let layout = vk::ImageLayout::GENERAL;
        let read = Scope::new(binding.reads, vk::AccessFlags2::SHADER_STORAGE_READ);
        let write = Scope::new(binding.writes, vk::AccessFlags2::SHADER_STORAGE_WRITE);
        self.touch_image(image, ImageUsage::STORAGE, read, write, layout)?;
        Ok(Content::Image { view: image.view(), sampler: vk::Sampler::null(), layout })
    }
}
