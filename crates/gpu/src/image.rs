//! Images: targets, textures, storage images.

use std::sync::{
    Arc,
    atomic::{AtomicI32, AtomicU32, Ordering},
};

use ash::vk;
use gpu_allocator::MemoryLocation;

use crate::{
    Device, Format, GpuError, Rect, format::sample_flag, memory::Block, owned::Owned, present::Swapchain,
    resource::ResourceId,
};

bitflags::bitflags! {
    /// What an image is for. Something must fill it, and more than copies must use it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub struct ImageUsage: u32 {
        /// Colour or depth target of a render pass, by its format.
        const TARGET = 1;
        /// Copied to buffers, and from level to level; one sample only.
        const COPY_SRC = 2;
        /// Copied to from buffers, and from level to level; one sample only.
        const COPY_DST = 4;
        /// Looked up by shaders with a [`Sampler`](crate::Sampler); one sample only.
        const SAMPLED = 8;
        /// Read and written texel by texel by shaders, `image2D` in GLSL; one sample only.
        const STORAGE = 16;
    }
}

/// How to make an image; the default has one sample and one level, and neither size nor usage.
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
    /// Levels, each half as wide and high as the one before, from 1 to [`Image::full_levels`].
    pub levels: u32,
    /// What it is for.
    pub usage: ImageUsage,
}

impl Default for ImageDesc<'_> {
    fn default() -> Self {
        let usage = ImageUsage::empty();
        Self { name: "image", size: [0, 0], format: Format::Rgba8Unorm, samples: 1, levels: 1, usage }
    }
}

/// A two-dimensional image. Targets and storage images are its level 0; sampling sees all levels. Clones share it.
#[derive(Clone)]
pub struct Image {
    inner: Arc<Inner>,
}

/// Field order is destruction order: views before their image.
struct Inner {
    /// Level 0.
    view: Owned<vk::ImageView>,
    /// All levels, if there are several.
    levels_view: Option<Owned<vk::ImageView>>,
    texels: Texels,
    id: ResourceId,
    name: String,
    size: [u32; 2],
    format: Format,
    samples: u32,
    levels: u32,
    usage: ImageUsage,
    /// What the device can do with images of the format.
    features: vk::FormatFeatureFlags,
    /// Layout after the latest submission. Changes only while the queue is locked.
    layout: AtomicI32,
    /// How many pieces of encoded commands hold it in that layout. Rises only while the queue is locked.
    held: AtomicU32,
    device: Device,
}

/// Where the texels are.
enum Texels {
    /// In an image of its own, in memory of its own; in order of destruction.
    Own { raw: Owned<vk::Image>, _block: Block },
    /// In an image of a window, which lives as long as its swapchain.
    Window { raw: vk::Image, _swapchain: Arc<Swapchain> },
}

impl Texels {
    fn raw(&self) -> vk::Image {
        match self {
            Self::Own { raw, .. } => raw.raw,
            Self::Window { raw, .. } => *raw,
        }
    }
}

/// A rectangle of texels of one level of an image, for copies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageRegion {
    /// The image.
    pub image: Image,
    /// The level.
    pub level: u32,
    /// Which texels of the level.
    pub rect: Rect,
}

impl Device {
    /// Makes an image. What is in it is undefined until a pass fills it.
    pub fn image(&self, desc: &ImageDesc<'_>) -> Result<Image, GpuError> {
        let samples = self.check_image(desc)?;
        let texels = self.texels(desc, samples)?;
        self.wrap(desc, texels, vk::ImageLayout::UNDEFINED)
    }

    /// An image of a window's swapchain, which it keeps alive. It belongs to the window until it is acquired.
    pub(crate) fn window_image(
        &self,
        desc: &ImageDesc<'_>,
        raw: vk::Image,
        swapchain: &Arc<Swapchain>,
    ) -> Result<Image, GpuError> {
        self.shared.raw.set_name(raw, desc.name);
        self.wrap(desc, Texels::Window { raw, _swapchain: Arc::clone(swapchain) }, Image::WITH_WINDOW)
    }

    /// The image around texels in a layout.
    fn wrap(&self, desc: &ImageDesc<'_>, texels: Texels, layout: vk::ImageLayout) -> Result<Image, GpuError> {
        let raw = texels.raw();
        let several = desc.levels > 1;
        let inner = Inner {
            view: self.view(raw, desc, 1)?,
            levels_view: if several { Some(self.view(raw, desc, desc.levels)?) } else { None },
            texels,
            id: ResourceId::new(),
            name: desc.name.to_owned(),
            size: desc.size,
            format: desc.format,
            samples: desc.samples,
            levels: desc.levels,
            usage: desc.usage,
            features: self.format_features(desc.format),
            layout: AtomicI32::new(layout.as_raw()),
            held: AtomicU32::new(0),
            device: self.clone(),
        };
        Ok(Image { inner: Arc::new(inner) })
    }

    /// Creates the image itself, in memory of its own.
    fn texels(&self, desc: &ImageDesc<'_>, samples: vk::SampleCountFlags) -> Result<Texels, GpuError> {
        let [width, height] = desc.size;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(desc.format.raw())
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(desc.levels)
            .array_layers(1)
            .samples(samples)
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
        // `Texels::Own` drops it later.
        unsafe { self.raw().bind_image_memory(raw.raw, memory, offset) }
            .map_err(|result| GpuError::from_vulkan(format!("binding memory to image {:?}", desc.name), result))?;
        Ok(Texels::Own { raw, _block: block })
    }

    /// Whether the device takes such an image; the flag for its samples.
    fn check_image(&self, desc: &ImageDesc<'_>) -> Result<vk::SampleCountFlags, GpuError> {
        let refuse =
            |reason: String| GpuError::ImageUsage { image: desc.name.to_owned(), what: usage_text(desc.usage), reason };
        let flag = sample_flag(desc.samples).ok_or_else(|| refuse(format!("{} samples", desc.samples)))?;
        let filled = ImageUsage::TARGET | ImageUsage::STORAGE | ImageUsage::COPY_DST;
        if desc.size.contains(&0) || !desc.usage.intersects(filled) {
            return Err(refuse("it has no texels, or nothing could fill it: it is no target".to_owned()));
        }
        if desc.usage.difference(ImageUsage::COPY_SRC | ImageUsage::COPY_DST).is_empty() {
            return Err(refuse("it is only copied, which a buffer does as well".to_owned()));
        }
        if desc.samples > 1 && desc.usage != ImageUsage::TARGET {
            return Err(refuse("an image of several samples is a target only: resolve it into another".to_owned()));
        }
        let full = Image::full_levels(desc.size);
        if desc.levels == 0 || desc.levels > full || (desc.samples > 1 && desc.levels > 1) {
            return Err(refuse(format!("{} levels, of at most {full}, and of 1 with several samples", desc.levels)));
        }
        let found = self.image_format_properties(desc);
        let found = found.ok_or_else(|| refuse(format!("the device does not support {:?} for this", desc.format)))?;
        let [width, height] = desc.size;
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

    /// What the device says to such an image; `None` if it has none.
    fn image_format_properties(&self, desc: &ImageDesc<'_>) -> Option<vk::ImageFormatProperties> {
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
        found.ok()
    }

    fn format_features(&self, format: Format) -> vk::FormatFeatureFlags {
        self.raw_format_features(format.raw())
    }

    pub(crate) fn raw_format_features(&self, format: vk::Format) -> vk::FormatFeatureFlags {
        let (instance, physical) = (&self.shared.instance.raw, self.shared.physical);
        // SAFETY: plain parameters; the physical device is that of this device.
        unsafe { instance.get_physical_device_format_properties(physical, format) }.optimal_tiling_features
    }

    /// A view of the first levels of an image.
    fn view(&self, raw: vk::Image, desc: &ImageDesc<'_>, levels: u32) -> Result<Owned<vk::ImageView>, GpuError> {
        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(desc.format.raw())
            .subresource_range(range(desc.format, 0..levels));
        // SAFETY: the image is alive, bound to memory, and has this format and these levels.
        let view = unsafe { self.raw().create_image_view(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating the view of image {:?}", desc.name), result))?;
        Ok(Owned::new(&self.shared.raw, view, desc.name))
    }
}

impl Image {
    /// The layout of an image that belongs to its window: it was presented, or not yet acquired.
    pub(crate) const WITH_WINDOW: vk::ImageLayout = vk::ImageLayout::PRESENT_SRC_KHR;

    /// Most levels of an image of this size: down to a single texel.
    pub fn full_levels(size: [u32; 2]) -> u32 {
        u32::BITS - size[0].max(size[1]).leading_zeros()
    }

    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Width and height of level 0 in texels.
    pub fn size(&self) -> [u32; 2] {
        self.inner.size
    }

    /// Width and height of a level in texels.
    pub fn level_size(&self, level: u32) -> [u32; 2] {
        self.size().map(|one| one.checked_shr(level).unwrap_or(0).max(1))
    }

    /// Format of the texels.
    pub fn format(&self) -> Format {
        self.inner.format
    }

    /// Samples per texel.
    pub fn samples(&self) -> u32 {
        self.inner.samples
    }

    /// Number of levels.
    pub fn levels(&self) -> u32 {
        self.inner.levels
    }

    /// What it is for.
    pub fn usage(&self) -> ImageUsage {
        self.inner.usage
    }

    /// Bytes of all texels of level 0, rows packed tightly, as copied to a buffer.
    pub fn byte_size(&self) -> u64 {
        self.level(0).byte_size()
    }

    /// All texels of a level.
    pub fn level(&self, level: u32) -> ImageRegion {
        self.region(level, self.level_size(level).into())
    }

    /// Some texels of a level.
    pub fn region(&self, level: u32, rect: Rect) -> ImageRegion {
        ImageRegion { image: self.clone(), level, rect }
    }

    pub(crate) fn raw(&self) -> vk::Image {
        self.inner.texels.raw()
    }

    /// Level 0.
    pub(crate) fn view(&self) -> vk::ImageView {
        self.inner.view.raw
    }

    /// All levels.
    pub(crate) fn levels_view(&self) -> vk::ImageView {
        self.inner.levels_view.as_ref().unwrap_or(&self.inner.view).raw
    }

    /// All of the image.
    pub(crate) fn range(&self) -> vk::ImageSubresourceRange {
        range(self.format(), 0..self.levels())
    }

    /// Whether samplers may take means of its texels.
    pub(crate) fn filters(&self) -> bool {
        self.inner.features.contains(vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR)
    }

    /// Whether levels can be made of each other.
    pub(crate) fn blits(&self) -> bool {
        let both = vk::FormatFeatureFlags::BLIT_SRC | vk::FormatFeatureFlags::BLIT_DST;
        self.inner.features.contains(both) && self.filters()
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

    /// Whether what is in it is undefined.
    pub(crate) fn is_blank(&self) -> bool {
        [vk::ImageLayout::UNDEFINED, Self::WITH_WINDOW].contains(&self.layout())
    }

    /// Fails while the image belongs to its window. Called with the queue locked.
    pub(crate) fn check_acquired(&self) -> Result<(), GpuError> {
        if self.layout() == Self::WITH_WINDOW {
            return Err(GpuError::NotAcquired { image: self.name().to_owned() });
        }
        Ok(())
    }

    /// Fails if encoded commands rely on a layout other than this. Called with the queue locked.
    pub(crate) fn check_held(&self, layout: vk::ImageLayout) -> Result<(), GpuError> {
        if self.inner.held.load(Ordering::Acquire) > 0 && layout != self.layout() {
            let instead = "or use another image";
            return Err(GpuError::InUse { name: self.name().to_owned(), instead });
        }
        Ok(())
    }

    /// Keeps the layout until [`Self::release`], which is to be called as often. Called with the queue locked.
    pub(crate) fn hold(&self) {
        self.inner.held.fetch_add(1, Ordering::AcqRel);
    }

    pub(crate) fn release(&self) {
        self.inner.held.fetch_sub(1, Ordering::AcqRel);
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

impl ImageRegion {
    /// Bytes of its texels, rows packed tightly, as copied to and from buffers.
    pub fn byte_size(&self) -> u64 {
        let [width, height] = self.rect.size.map(u64::from);
        width.saturating_mul(height).saturating_mul(self.image.format().bytes_per_texel())
    }

    /// Whether the image has these texels.
    pub(crate) fn exists(&self) -> bool {
        self.level < self.image.levels() && self.rect.fits(self.image.level_size(self.level))
    }

    pub(crate) fn raw(&self, buffer_offset: u64) -> vk::BufferImageCopy2<'static> {
        let (vk::Offset2D { x, y }, [width, height]) = (self.rect.raw().offset, self.rect.size);
        vk::BufferImageCopy2::default()
            .buffer_offset(buffer_offset)
            .image_subresource(layers(self.image.format(), self.level))
            .image_offset(vk::Offset3D { x, y, z: 0 })
            .image_extent(vk::Extent3D { width, height, depth: 1 })
    }
}

/// Some levels of an image of this format.
pub(crate) fn range(format: Format, levels: std::ops::Range<u32>) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default()
        .aspect_mask(format.aspect())
        .base_mip_level(levels.start)
        .level_count(levels.end - levels.start)
        .layer_count(1)
}

/// One level of an image of this format.
pub(crate) fn layers(format: Format, level: u32) -> vk::ImageSubresourceLayers {
    vk::ImageSubresourceLayers::default().aspect_mask(format.aspect()).mip_level(level).layer_count(1)
}

/// What an image is for, in words.
fn usage_text(usage: ImageUsage) -> String {
    let names: Vec<&str> = usage.iter_names().map(|(name, _)| name).collect();
    if names.is_empty() { "nothing".to_owned() } else { names.join(" and ") }
}

fn usage_flags(desc: &ImageDesc<'_>) -> vk::ImageUsageFlags {
    let target = if desc.format.is_depth() {
        vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
    } else {
        vk::ImageUsageFlags::COLOR_ATTACHMENT
    };
    let table = [
        (ImageUsage::TARGET, target),
        (ImageUsage::COPY_SRC, vk::ImageUsageFlags::TRANSFER_SRC),
        (ImageUsage::COPY_DST, vk::ImageUsageFlags::TRANSFER_DST),
        (ImageUsage::SAMPLED, vk::ImageUsageFlags::SAMPLED),
        (ImageUsage::STORAGE, vk::ImageUsageFlags::STORAGE),
    ];
    let chosen = table.into_iter().filter(|(one, _)| desc.usage.contains(*one));
    chosen.fold(vk::ImageUsageFlags::empty(), |flags, (_, flag)| flags | flag)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_go_down_to_one_texel() {
        let levels = [[1, 1], [2, 1], [3, 3], [4, 1], [1023, 5], [1024, 5]].map(Image::full_levels);
        assert_eq!(levels, [1, 2, 2, 3, 10, 11]);
    }
}
