//! Images: colour and depth targets.

use std::sync::{
    Arc,
    atomic::{AtomicI32, Ordering},
};

use ash::vk;
use gpu_allocator::MemoryLocation;

use crate::{Device, Format, GpuError, format::sample_flag, memory::Block, owned::Owned, resource::ResourceId};

bitflags::bitflags! {
    /// What an image is for.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct ImageUsage: u32 {
        /// Colour or depth target of a render pass, by its format; every image needs this.
        const TARGET = 1;
        /// Copied to buffers; one sample only.
        const COPY_SRC = 2;
    }
}

/// How to make an image.
#[derive(Clone, Copy, Debug)]
pub struct ImageDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Format of the texels.
    pub format: Format,
    /// Samples per texel: 1, 2, 4, ..; see [`Limits::sample_counts`](crate::Limits::sample_counts).
    pub samples: u32,
    /// What it is for.
    pub usage: ImageUsage,
}

/// A two-dimensional image with one level. Clones share it.
#[derive(Clone)]
pub struct Image {
    inner: Arc<Inner>,
}

/// Field order is destruction order: the view before its image, the image before its memory.
struct Inner {
    view: Owned<vk::ImageView>,
    raw: Owned<vk::Image>,
    _block: Block,
    id: ResourceId,
    name: String,
    size: [u32; 2],
    format: Format,
    samples: u32,
    usage: ImageUsage,
    /// Layout after the latest submission. Changes only while the queue is locked.
    layout: AtomicI32,
    device: Device,
}

impl Device {
    /// Makes an image. What is in it is undefined until a pass clears or draws it.
    pub fn image(&self, desc: &ImageDesc<'_>) -> Result<Image, GpuError> {
        let flag = self.check_image(desc)?;
        let [width, height] = desc.size;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(desc.format.raw())
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(flag)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(usage_flags(desc));
        // SAFETY: `check_image` asked the device whether it takes such an image.
        let raw = unsafe { self.raw().create_image(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating image {:?}", desc.name), result))?;
        let raw = Owned::new(&self.shared.raw, raw, desc.name);
        // SAFETY: the image was made by this device.
        let requirements = unsafe { self.raw().get_image_memory_requirements(raw.raw) };
        let block = self.shared.memory.allocate(desc.name, requirements, MemoryLocation::GpuOnly, false)?;
        let (memory, offset) = block.place();
        // SAFETY: image and memory are of this device, the memory meets the image's requirements and outlives it, since
        // `Inner` drops it later.
        unsafe { self.raw().bind_image_memory(raw.raw, memory, offset) }
            .map_err(|result| GpuError::from_vulkan(format!("binding memory to image {:?}", desc.name), result))?;
        let view = self.view(raw.raw, desc)?;
        let inner = Inner {
            view,
            raw,
            _block: block,
            id: ResourceId::new(),
            name: desc.name.to_owned(),
            size: desc.size,
            format: desc.format,
            samples: desc.samples,
            usage: desc.usage,
            layout: AtomicI32::new(vk::ImageLayout::UNDEFINED.as_raw()),
            device: self.clone(),
        };
        Ok(Image { inner: Arc::new(inner) })
    }

    /// Whether the device takes such an image; the flag for its samples.
    fn check_image(&self, desc: &ImageDesc<'_>) -> Result<vk::SampleCountFlags, GpuError> {
        let refuse = |reason: String| {
            let what = if desc.format.is_depth() { "depth" } else { "colour" };
            GpuError::ImageUsage { image: desc.name.to_owned(), what: what.to_owned(), reason }
        };
        let flag = sample_flag(desc.samples).ok_or_else(|| refuse(format!("{} samples", desc.samples)))?;
        let [width, height] = desc.size;
        if width == 0 || height == 0 || !desc.usage.contains(ImageUsage::TARGET) {
            return Err(refuse("it has no texels, or is not a target, so that nothing could fill it".to_owned()));
        }
        if desc.samples > 1 && desc.usage.contains(ImageUsage::COPY_SRC) {
            return Err(refuse("an image of several samples must be resolved before it is copied".to_owned()));
        }
        // SAFETY: plain parameters; the physical device is that of this device.
        let found = unsafe {
            self.shared.instance.raw.get_physical_device_image_format_properties(
                self.shared.physical,
                desc.format.raw(),
                vk::ImageType::TYPE_2D,
                vk::ImageTiling::OPTIMAL,
                usage_flags(desc),
                vk::ImageCreateFlags::empty(),
            )
        };
        let found = found.map_err(|_| refuse(format!("the device does not support {:?} for this", desc.format)))?;
        if width > found.max_extent.width || height > found.max_extent.height {
            let limit = found.max_extent.width.min(found.max_extent.height).into();
            return Err(GpuError::Limit {
                what: format!("size of image {:?}", desc.name),
                value: width.max(height).into(),
                limit,
            });
        }
        if !found.sample_counts.contains(flag) {
            return Err(refuse(format!("the device does not support {} samples of {:?}", desc.samples, desc.format)));
        }
        Ok(flag)
    }

    fn view(&self, raw: vk::Image, desc: &ImageDesc<'_>) -> Result<Owned<vk::ImageView>, GpuError> {
        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(desc.format.raw())
            .subresource_range(whole(desc.format));
        // SAFETY: the image is alive, bound to memory, and has this format.
        let view = unsafe { self.raw().create_image_view(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating the view of image {:?}", desc.name), result))?;
        Ok(Owned::new(&self.shared.raw, view, desc.name))
    }
}

impl Image {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.inner.size
    }

    /// Format of the texels.
    pub fn format(&self) -> Format {
        self.inner.format
    }

    /// Samples per texel.
    pub fn samples(&self) -> u32 {
        self.inner.samples
    }

    /// What it is for.
    pub fn usage(&self) -> ImageUsage {
        self.inner.usage
    }

    /// Bytes of all texels, rows packed tightly, as copied to a buffer.
    pub fn byte_size(&self) -> u64 {
        let [width, height] = self.size();
        u64::from(width) * u64::from(height) * self.format().bytes_per_texel()
    }

    pub(crate) fn raw(&self) -> vk::Image {
        self.inner.raw.raw
    }

    pub(crate) fn view(&self) -> vk::ImageView {
        self.inner.view.raw
    }

    pub(crate) fn id(&self) -> ResourceId {
        self.inner.id
    }

    pub(crate) fn device(&self) -> &Device {
        &self.inner.device
    }

    pub(crate) fn layout(&self) -> vk::ImageLayout {
        vk::ImageLayout::from_raw(self.inner.layout.load(Ordering::Acquire))
    }

    /// Remembers the layout after a submission. Called with the queue locked.
    pub(crate) fn set_layout(&self, layout: vk::ImageLayout) {
        self.inner.layout.store(layout.as_raw(), Ordering::Release);
    }
}

impl PartialEq for Image {
    /// Whether both are the same image.
    fn eq(&self, other: &Self) -> bool {
        self.inner.id == other.inner.id
    }
}

impl Eq for Image {}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Image");
        debug.field("name", &self.name()).field("size", &self.size()).field("format", &self.format());
        debug.field("samples", &self.samples()).finish()
    }
}

/// All of an image of this format.
pub(crate) fn whole(format: Format) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default().aspect_mask(format.aspect()).level_count(1).layer_count(1)
}

fn usage_flags(desc: &ImageDesc<'_>) -> vk::ImageUsageFlags {
    let target = if desc.format.is_depth() {
        vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
    } else {
        vk::ImageUsageFlags::COLOR_ATTACHMENT
    };
    let table = [(ImageUsage::TARGET, target), (ImageUsage::COPY_SRC, vk::ImageUsageFlags::TRANSFER_SRC)];
    let chosen = table.into_iter().filter(|(one, _)| desc.usage.contains(*one));
    chosen.fold(vk::ImageUsageFlags::empty(), |flags, (_, flag)| flags | flag)
}
