//! Image formats.

use ash::vk;

/// The numbers that shaders read from texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Numbers {
    /// Floats, also where texels hold normalized integers or depths: `sampler2D` in GLSL.
    Float,
    /// Unsigned integers: `usampler2D` in GLSL.
    Uint,
    /// Signed integers: `isampler2D` in GLSL; no format here has them.
    Int,
}

/// The format of an image's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Four bytes, red first, linear.
    Rgba8Unorm,
    /// Four bytes, red first, sRGB: shaders write linear values.
    Rgba8Srgb,
    /// Four bytes, blue first, linear; what many windows want.
    Bgra8Unorm,
    /// Four bytes, blue first, sRGB; what many windows want.
    Bgra8Srgb,
    /// Four half floats.
    Rgba16Float,
    /// Four floats.
    Rgba32Float,
    /// One byte, linear.
    R8Unorm,
    /// One number of 16 bits, linear, from 0 to 1.
    R16Unorm,
    /// One half float.
    R16Float,
    /// One float.
    R32Float,
    /// One unsigned integer.
    R32Uint,
    /// Depth as a float.
    Depth32Float,
}

impl Format {
    /// Bytes per texel, as copied to a buffer.
    pub fn bytes_per_texel(self) -> u64 {
        match self {
            Self::Rgba32Float => 16,
            Self::Rgba16Float => 8,
            Self::R16Unorm | Self::R16Float => 2,
            Self::R8Unorm => 1,
            _ => 4,
        }
    }

    /// Whether texels are depths.
    pub fn is_depth(self) -> bool {
        self == Self::Depth32Float
    }

    /// What shaders see when they read texels.
    pub fn numbers(self) -> Numbers {
        if self == Self::R32Uint { Numbers::Uint } else { Numbers::Float }
    }

    pub(crate) fn raw(self) -> vk::Format {
        match self {
            Self::Rgba8Unorm => vk::Format::R8G8B8A8_UNORM,
            Self::Rgba8Srgb => vk::Format::R8G8B8A8_SRGB,
            Self::Bgra8Unorm => vk::Format::B8G8R8A8_UNORM,
            Self::Bgra8Srgb => vk::Format::B8G8R8A8_SRGB,
            Self::Rgba16Float => vk::Format::R16G16B16A16_SFLOAT,
            Self::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
            Self::R8Unorm => vk::Format::R8_UNORM,
            Self::R16Unorm => vk::Format::R16_UNORM,
            Self::R16Float => vk::Format::R16_SFLOAT,
            Self::R32Float => vk::Format::R32_SFLOAT,
            Self::R32Uint => vk::Format::R32_UINT,
            Self::Depth32Float => vk::Format::D32_SFLOAT,
        }
    }

    const ALL: [Self; 12] = [
        Self::Rgba8Unorm,
        Self::Rgba8Srgb,
        Self::Bgra8Unorm,
        Self::Bgra8Srgb,
        Self::Rgba16Float,
        Self::Rgba32Float,
        Self::R8Unorm,
        Self::R16Unorm,
        Self::R16Float,
        Self::R32Float,
        Self::R32Uint,
        Self::Depth32Float,
    ];

    /// The format that Vulkan calls so.
    pub(crate) fn of(raw: vk::Format) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.raw() == raw)
    }

    /// What Vulkan calls it.
    pub fn vulkan(self) -> vk::Format {
        self.raw()
    }

    /// The colour format that Vulkan calls so, if windows may have it.
    pub(crate) fn of_window(raw: vk::Format) -> Option<Self> {
        let all = [Self::Bgra8Srgb, Self::Rgba8Srgb, Self::Bgra8Unorm, Self::Rgba8Unorm, Self::Rgba16Float];
        all.into_iter().find(|format| format.raw() == raw)
    }

    pub(crate) fn aspect(self) -> vk::ImageAspectFlags {
        if self.is_depth() { vk::ImageAspectFlags::DEPTH } else { vk::ImageAspectFlags::COLOR }
    }
}

/// The Vulkan flag for a number of samples per texel: 1, 2, 4, 8, 16 or 32.
pub(crate) fn sample_flag(samples: u32) -> Option<vk::SampleCountFlags> {
    (samples.is_power_of_two() && samples <= 32).then(|| vk::SampleCountFlags::from_raw(samples))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sample_counts_are_powers_of_two() {
        assert_eq!(sample_flag(1), Some(vk::SampleCountFlags::TYPE_1));
        assert_eq!(sample_flag(4), Some(vk::SampleCountFlags::TYPE_4));
        assert_eq!(sample_flag(0), None);
        assert_eq!(sample_flag(3), None);
        assert_eq!(sample_flag(64), None);
    }
}
