//! Which buffer or image is at which binding number.

use std::{ops::Range, sync::Arc};

use crate::{Buffer, Image, Sampler, TexelFormat};

/// Buffers and images by binding number. May hold more than a pipeline uses: each takes those that its shaders declare. Clones are cheap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bindings {
    /// Ascending by number.
    entries: Arc<Vec<(u32, Bound)>>,
}

/// What is at a binding number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Bound {
    Buffer {
        buffer: Buffer,
        /// Bytes; `None` is the whole buffer.
        range: Option<Range<u64>>,
    },
    Texels {
        buffer: Buffer,
        format: TexelFormat,
    },
    Texture {
        image: Image,
        sampler: Sampler,
    },
    StorageImage {
        image: Image,
    },
}

impl Bound {
    /// What it is, for messages.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Buffer { buffer, .. } => format!("buffer {:?}", buffer.name()),
            Self::Texels { buffer, format } => format!("buffer {:?} as {format:?}", buffer.name()),
            Self::Texture { image, .. } => format!("image {:?} with a sampler", image.name()),
            Self::StorageImage { image } => format!("image {:?} without a sampler", image.name()),
        }
    }
}

impl Bindings {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a buffer, in place of anything that had this number.
    #[must_use]
    pub fn with(self, binding: u32, buffer: &Buffer) -> Self {
        self.set(binding, Bound::Buffer { buffer: buffer.clone(), range: None })
    }

    /// Adds a range of bytes of a buffer. Its start must be a multiple of the device's alignment, see
    /// [`Limits`](crate::Limits).
    #[must_use]
    pub fn with_range(self, binding: u32, buffer: &Buffer, bytes: Range<u64>) -> Self {
        self.set(binding, Bound::Buffer { buffer: buffer.clone(), range: Some(bytes) })
    }

    /// Adds a buffer to read as an array of vectors, `samplerBuffer` in GLSL. Made with
    /// [`BufferUsage::TEXELS`](crate::BufferUsage::TEXELS).
    #[must_use]
    pub fn with_texels(self, binding: u32, buffer: &Buffer, format: TexelFormat) -> Self {
        self.set(binding, Bound::Texels { buffer: buffer.clone(), format })
    }

    /// Adds an image to look up with a sampler, `sampler2D` in GLSL. Made with
    /// [`ImageUsage::SAMPLED`](crate::ImageUsage::SAMPLED).
    #[must_use]
    pub fn with_texture(self, binding: u32, image: &Image, sampler: &Sampler) -> Self {
        self.set(binding, Bound::Texture { image: image.clone(), sampler: sampler.clone() })
    }

    /// Adds an image to read and write texel by texel, `image2D` in GLSL: its level 0. Made with
    /// [`ImageUsage::STORAGE`](crate::ImageUsage::STORAGE).
    #[must_use]
    pub fn with_storage_image(self, binding: u32, image: &Image) -> Self {
        self.set(binding, Bound::StorageImage { image: image.clone() })
    }

    /// Adds all that others hold, in place of anything that had one of their numbers.
    #[must_use]
    pub fn with_all(self, others: &Self) -> Self {
        others.entries.iter().fold(self, |all, (binding, bound)| all.set(*binding, bound.clone()))
    }

    fn set(mut self, binding: u32, bound: Bound) -> Self {
        let entries = Arc::make_mut(&mut self.entries);
        match entries.binary_search_by_key(&binding, |(number, _)| *number) {
            Ok(position) => entries[position].1 = bound,
            Err(position) => entries.insert(position, (binding, bound)),
        }
        self
    }

    /// The numbers at which there is something, ascending.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        self.entries.iter().map(|(number, _)| *number)
    }

    pub(crate) fn get(&self, binding: u32) -> Option<&Bound> {
        let position = self.entries.binary_search_by_key(&binding, |(number, _)| *number).ok()?;
        Some(&self.entries[position].1)
    }

    /// Whether both bind the same; quick for clones of one.
    pub(crate) fn same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.entries, &other.entries) || self == other
    }
}
