//! Buffers that shaders read as arrays of vectors, `samplerBuffer` in GLSL: texel buffers, in Vulkan's terms.
//!
//! Beside storage buffers they have two merits: a vector is read by one instruction, also where a device takes storage buffers word by word and lane by lane, as
//! llvmpipe does; and graphics processors read them through the caches of textures.

use std::sync::{Mutex, PoisonError};

use ash::vk;

use crate::{Buffer, GpuError, Numbers, owned::Owned};

/// What a vector of a texel buffer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// One 32-bit float.
    R32Float,
    /// Three 32-bit floats, 12 bytes.
    Rgb32Float,
    /// One unsigned 32-bit number.
    R32Uint,
    /// Two unsigned 32-bit numbers, 8 bytes.
    Rg32Uint,
    /// Four unsigned 32-bit numbers, 16 bytes.
    Rgba32Uint,
}

impl TexelFormat {
    /// Bytes of the largest vector.
    pub(crate) const MOST_BYTES: u64 = 16;

    /// Bytes of a vector.
    pub fn bytes(self) -> u64 {
        match self {
            Self::R32Float | Self::R32Uint => 4,
            Self::Rg32Uint => 8,
            Self::Rgb32Float => 12,
            Self::Rgba32Uint => 16,
        }
    }

    /// What it is made of.
    pub fn numbers(self) -> Numbers {
        match self {
            Self::R32Float | Self::Rgb32Float => Numbers::Float,
            Self::R32Uint | Self::Rg32Uint | Self::Rgba32Uint => Numbers::Uint,
        }
    }

    pub(crate) fn raw(self) -> vk::Format {
        match self {
            Self::R32Float => vk::Format::R32_SFLOAT,
            Self::Rgb32Float => vk::Format::R32G32B32_SFLOAT,
            Self::R32Uint => vk::Format::R32_UINT,
            Self::Rg32Uint => vk::Format::R32G32_UINT,
            Self::Rgba32Uint => vk::Format::R32G32B32A32_UINT,
        }
    }
}

/// The formats that every use of this crate needs and Vulkan does not promise, as messages name them.
const REQUIRED: [(TexelFormat, &str); 1] =
    [(TexelFormat::Rgb32Float, "uniform texel buffers of VK_FORMAT_R32G32B32_SFLOAT")];

/// The required formats that a device lacks.
pub(crate) fn missing(instance: &ash::Instance, device: vk::PhysicalDevice) -> impl Iterator<Item = String> {
    let has = move |format: TexelFormat| {
        // SAFETY: the device is one of the instance.
        let found = unsafe { instance.get_physical_device_format_properties(device, format.raw()) };
        found.buffer_features.contains(vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER)
    };
    REQUIRED.into_iter().filter(move |(format, _)| !has(*format)).map(|(_, name)| name.to_owned())
}

/// The views of one buffer, made when they are first asked for.
#[derive(Default)]
pub(crate) struct TexelViews {
    views: Mutex<Vec<(TexelFormat, Owned<vk::BufferView>)>>,
}

impl TexelViews {
    /// The view of `buffer`, whose views these are, in a format: of all whole vectors that it has room for.
    pub(crate) fn view(&self, buffer: &Buffer, format: TexelFormat, what: &str) -> Result<vk::BufferView, GpuError> {
        let mut views = self.views.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, view)) = views.iter().find(|(known, _)| *known == format) {
            return Ok(view.raw);
        }
        let view = create(buffer, format, what)?;
        let raw = view.raw;
        views.push((format, view));
        Ok(raw)
    }
}

fn create(buffer: &Buffer, format: TexelFormat, what: &str) -> Result<Owned<vk::BufferView>, GpuError> {
    let device = buffer.device();
    let (texels, limit) = (buffer.real_size() / format.bytes(), device.info().limits.max_texels);
    if texels > limit {
        return Err(GpuError::Limit {
            what: format!("vectors of buffer {:?} at {what}", buffer.name()),
            value: texels,
            limit,
        });
    }
    let info =
        vk::BufferViewCreateInfo::default().buffer(buffer.raw()).format(format.raw()).range(texels * format.bytes());
    // SAFETY: the buffer is of this device and was made for this, which the caller has checked; its size is at least one vector, the range is whole vectors
    // within it and within the limit, and the device has the format: it was examined for those that Vulkan does not promise.
    let raw = unsafe { device.raw().create_buffer_view(&info, None) }
        .map_err(|result| GpuError::from_vulkan(format!("creating a view of buffer {:?}", buffer.name()), result))?;
    Ok(Owned::new(&device.shared.raw, raw, buffer.name()))
}
