//! Elements of accessors, checked against view and buffer once and then read one by one: what a primitive does not use costs
//! nothing, however large the accessor claims to be.

use ::gltf::Accessor;
use ::gltf::accessor::{DataType, Dimensions, sparse};
use ::gltf::buffer::View;

use super::AccessorError;
use super::buffers::Buffers;

/// Elements of `size` bytes at a fixed distance.
#[derive(Clone, Copy)]
struct Strided<'a> {
    data: &'a [u8],
    size: usize,
    stride: usize,
}

impl<'a> Strided<'a> {
    fn new(view: &View, offset: usize, count: usize, size: usize, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let buffer = buffers.get(view.buffer().index());
        let end = view.offset().checked_add(view.length());
        let bytes =
            end.and_then(|end| buffer.get(view.offset()..end)).ok_or(AccessorError::View { view: view.index() })?;
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(AccessorError::Stride { size, stride });
        }
        let span =
            if count == 0 { 0 } else { (count as u64 - 1).saturating_mul(stride as u64).saturating_add(size as u64) };
        let needed = span.saturating_add(offset as u64);
        if needed > bytes.len() as u64 {
            return Err(AccessorError::OutOfRange { needed, available: bytes.len() as u64 });
        }
        Ok(Self { data: &bytes[offset..], size, stride })
    }

    /// The bytes of element `i`, which must be below the count given to `new`.
    fn get(&self, i: usize) -> &'a [u8] {
        &self.data[i * self.stride..][..self.size]
    }
}

/// The elements of an accessor as bytes; zero where neither a view nor sparse values say otherwise.
struct Elements<'a> {
    count: usize,
    base: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Replaced elements: rising indices and a value for each.
struct Sparse<'a> {
    count: usize,
    indices: Strided<'a>,
    values: Strided<'a>,
}

impl<'a> Elements<'a> {
    fn new(accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let (count, size) = (accessor.count(), accessor.size());
        let base =
            accessor.view().map(|view| Strided::new(&view, accessor.offset(), count, size, buffers)).transpose()?;
        let sparse = accessor.sparse().map(|sparse| Sparse::new(&sparse, size, buffers)).transpose()?;
        Ok(Self { count, base, sparse })
    }

    /// The bytes of element `index`, `None` for an element that is zero by default.
    fn get(&self, index: u32) -> Result<Option<&'a [u8]>, AccessorError> {
        let i = index as usize;
        if i >= self.count {
            return Err(AccessorError::Index { count: self.count, index });
        }
        let replaced = self.sparse.as_ref().and_then(|sparse| sparse.get(index));
        Ok(replaced.or_else(|| self.base.map(|base| base.get(i))))
    }
}

impl<'a> Sparse<'a> {
    fn new(sparse: &sparse::Sparse, size: usize, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let (count, indices, values) = (sparse.count(), sparse.indices(), sparse.values());
        let index_size = match indices.index_type() {
            sparse::IndexType::U8 => 1,
            sparse::IndexType::U16 => 2,
            sparse::IndexType::U32 => 4,
        };
        Ok(Self {
            count,
            indices: Strided::new(&indices.view(), indices.offset(), count, index_size, buffers)?,
            values: Strided::new(&values.view(), values.offset(), count, size, buffers)?,
        })
    }

    fn get(&self, index: u32) -> Option<&'a [u8]> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            match unsigned(self.indices.get(middle)).cmp(&index) {
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Greater => high = middle,
                std::cmp::Ordering::Equal => return Some(self.values.get(middle)),
            }
        }
        None
    }
}

/// A little-endian integer of up to four bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// A little-endian float.
fn float(bytes: &[u8]) -> f64 {
    f64::from(f32::from_bits(unsigned(bytes)))
}

/// Vectors of `N` numbers.
pub(super) struct Vectors<'a, const N: usize> {
    elements: Elements<'a>,
    scale: Scale,
}

/// How components become numbers.
#[derive(Clone, Copy)]
enum Scale {
    Float,
    /// Unsigned integers that mean fractions of this.
    Normalized(f64),
}

impl<'a, const N: usize> Vectors<'a, N> {
    /// Positions: three floats.
    pub(super) fn positions(accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        match (accessor.dimensions(), accessor.data_type()) {
            (Dimensions::Vec3, DataType::F32) if N == 3 => Self::new(accessor, buffers, Scale::Float),
            _ => Err(wrong_type(accessor, "VEC3 of F32")),
        }
    }

    /// Texture coordinates: two floats or normalized integers.
    pub(super) fn uv(accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let scale = match (accessor.dimensions(), accessor.data_type(), accessor.normalized()) {
            (Dimensions::Vec2, DataType::F32, _) if N == 2 => Scale::Float,
            (Dimensions::Vec2, DataType::U8, true) if N == 2 => Scale::Normalized(f64::from(u8::MAX)),
            (Dimensions::Vec2, DataType::U16, true) if N == 2 => Scale::Normalized(f64::from(u16::MAX)),
            _ => return Err(wrong_type(accessor, "VEC2 of F32 or of normalized U8 or U16")),
        };
        Self::new(accessor, buffers, scale)
    }

    fn new(accessor: &Accessor, buffers: &'a Buffers, scale: Scale) -> Result<Self, AccessorError> {
        Ok(Self { elements: Elements::new(accessor, buffers)?, scale })
    }

    pub(super) fn count(&self) -> usize {
        self.elements.count
    }

    pub(super) fn get(&self, index: u32) -> Result<[f64; N], AccessorError> {
        let mut vector = [0.0; N];
        let Some(bytes) = self.elements.get(index)? else { return Ok(vector) };
        for (component, bytes) in vector.iter_mut().zip(bytes.chunks_exact(bytes.len() / N)) {
            *component = match self.scale {
                Scale::Float => float(bytes),
                Scale::Normalized(one) => f64::from(unsigned(bytes)) / one,
            };
        }
        Ok(vector)
    }
}

/// Indices of vertices.
pub(super) struct Indices<'a> {
    elements: Elements<'a>,
}

impl<'a> Indices<'a> {
    pub(super) fn new(accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        match (accessor.dimensions(), accessor.data_type(), accessor.normalized()) {
            (Dimensions::Scalar, DataType::U8 | DataType::U16 | DataType::U32, false) => {
                Ok(Self { elements: Elements::new(accessor, buffers)? })
            }
            _ => Err(wrong_type(accessor, "SCALAR of U8, U16 or U32")),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.elements.count
    }

    pub(super) fn get(&self, index: u32) -> Result<u32, AccessorError> {
        Ok(self.elements.get(index)?.map_or(0, unsigned))
    }
}

fn wrong_type(accessor: &Accessor, expected: &'static str) -> AccessorError {
    let normalized = if accessor.normalized() { "normalized " } else { "" };
    let dimensions = format!("{:?}", accessor.dimensions()).to_uppercase();
    AccessorError::Type { found: format!("{dimensions} of {normalized}{:?}", accessor.data_type()), expected }
}
