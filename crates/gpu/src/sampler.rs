//! Samplers: how shaders look texels up.

use std::sync::Arc;

use ash::vk;

use crate::{Device, GpuError, owned::Owned};

/// How a value between texels, or between levels, is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Filter {
    /// That of the nearest.
    Nearest,
    /// The weighted mean of the neighbours; not for integers, and of 32-bit floats only where the device can.
    #[default]
    Linear,
}

impl Filter {
    pub(crate) fn raw(self) -> vk::Filter {
        match self {
            Self::Nearest => vk::Filter::NEAREST,
            Self::Linear => vk::Filter::LINEAR,
        }
    }
}

/// What lies beyond the image's border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// The texels of the border.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image again, every other time mirrored.
    Mirror,
}

impl Wrap {
    fn raw(self) -> vk::SamplerAddressMode {
        match self {
            Self::Clamp => vk::SamplerAddressMode::CLAMP_TO_EDGE,
            Self::Repeat => vk::SamplerAddressMode::REPEAT,
            Self::Mirror => vk::SamplerAddressMode::MIRRORED_REPEAT,
        }
    }
}

/// How to make a sampler. The default filters between texels and levels, and clamps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SamplerDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// Between texels where the image is enlarged.
    pub magnify: Filter,
    /// Between texels where the image is reduced.
    pub minify: Filter,
    /// Between levels; `None` stays in level 0.
    pub levels: Option<Filter>,
    /// Beyond the border, in u and in v.
    pub wrap: [Wrap; 2],
}

impl Default for SamplerDesc<'_> {
    fn default() -> Self {
        let (filter, wrap) = (Filter::Linear, Wrap::Clamp);
        Self { name: "sampler", magnify: filter, minify: filter, levels: Some(filter), wrap: [wrap; 2] }
    }
}

impl SamplerDesc<'_> {
    /// Whether it ever takes means of texels.
    fn is_linear(&self) -> bool {
        [Some(self.magnify), Some(self.minify), self.levels].contains(&Some(Filter::Linear))
    }
}

/// A way to look texels up. Clones share it.
#[derive(Clone)]
pub struct Sampler {
    inner: Arc<Inner>,
}

struct Inner {
    raw: Owned<vk::Sampler>,
    name: String,
    linear: bool,
    device: Device,
}

impl Device {
    /// Makes a sampler. Devices have room for a few thousand: share them.
    pub fn sampler(&self, desc: &SamplerDesc<'_>) -> Result<Sampler, GpuError> {
        let mode = match desc.levels {
            Some(Filter::Linear) => vk::SamplerMipmapMode::LINEAR,
            _ => vk::SamplerMipmapMode::NEAREST,
        };
        // A quarter, not zero: at zero every look-up would count as an enlargement.
        let max_lod = if desc.levels.is_some() { vk::LOD_CLAMP_NONE } else { 0.25 };
        let info = vk::SamplerCreateInfo::default()
            .mag_filter(desc.magnify.raw())
            .min_filter(desc.minify.raw())
            .mipmap_mode(mode)
            .address_mode_u(desc.wrap[0].raw())
            .address_mode_v(desc.wrap[1].raw())
            .address_mode_w(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .max_lod(max_lod);
        // SAFETY: the description uses nothing that must be switched on.
        let raw = unsafe { self.raw().create_sampler(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating sampler {:?}", desc.name), result))?;
        let raw = Owned::new(&self.shared.raw, raw, desc.name);
        let inner = Inner { raw, name: desc.name.to_owned(), linear: desc.is_linear(), device: self.clone() };
        Ok(Sampler { inner: Arc::new(inner) })
    }
}

impl Sampler {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    pub(crate) fn raw(&self) -> vk::Sampler {
        self.inner.raw.raw
    }

    /// Whether it takes means of texels, which not every format allows.
    pub(crate) fn is_linear(&self) -> bool {
        self.inner.linear
    }

    pub(crate) fn device(&self) -> &Device {
        &self.inner.device
    }
}

impl PartialEq for Sampler {
    /// Whether both are the same sampler.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }
}

impl Eq for Sampler {}

impl std::fmt::Debug for Sampler {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Sampler").field(&self.name()).finish()
    }
}
