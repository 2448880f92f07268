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

/// Where elements are in a view.
struct Place {
    offset: usize,
    count: usize,
    /// The size of an element.
    size: usize,
    /// The size of a component, which offsets and strides are multiples of.
    alignment: usize,
}

impl<'a> Strided<'a> {
    fn new(view: &View, place: &Place, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let &Place { offset, count, size, alignment } = place;
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
        let start = view.offset() as u64 + offset as u64;
        if !start.is_multiple_of(alignment as u64) || !stride.is_multiple_of(alignment) {
            return Err(AccessorError::Alignment { offset: start, stride, alignment });
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
        let (count, size, alignment) = (accessor.count(), accessor.size(), accessor.data_type().size());
        let place = Place { offset: accessor.offset(), count, size, alignment };
        let base = accessor.view().map(|view| Strided::new(&view, &place, buffers)).transpose()?;
        let sparse = accessor.sparse().map(|sparse| Sparse::new(&sparse, accessor, buffers)).transpose()?;
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
    fn new(sparse: &sparse::Sparse, accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        let (count, indices, values) = (sparse.count(), sparse.indices(), sparse.values());
        let index_size = match indices.index_type() {
            sparse::IndexType::U8 => 1,
            sparse::IndexType::U16 => 2,
            sparse::IndexType::U32 => 4,
        };
        let at = Place { offset: indices.offset(), count, size: index_size, alignment: index_size };
        let alignment = accessor.data_type().size();
        let of = Place { offset: values.offset(), count, size: accessor.size(), alignment };
        let new = Self {
            count,
            indices: Strided::new(&indices.view(), &at, buffers)?,
            values: Strided::new(&values.view(), &of, buffers)?,
        };
        new.check_rising(accessor, buffers)?;
        Ok(new)
    }

    /// Values are found by bisection.
    fn check_rising(&self, accessor: &Accessor, buffers: &Buffers) -> Result<(), AccessorError> {
        if buffers.rising.borrow().contains(&accessor.index()) {
            return Ok(());
        }
        let mut least = 0;
        for position in 0..self.count {
            let index = u64::from(unsigned(self.indices.get(position)));
            if index < least || index >= accessor.count() as u64 {
                return Err(AccessorError::Sparse { count: accessor.count(), position });
            }
            least = index + 1;
        }
        buffers.rising.borrow_mut().insert(accessor.index());
        Ok(())
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

/// A little-endian integer of one or two bytes in two's complement.
fn signed(bytes: &[u8]) -> i32 {
    let unused = 32 - 8 * bytes.len() as u32;
    (unsigned(bytes) << unused).cast_signed() >> unused
}

/// What vectors are for, which decides on the types that they may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Purpose {
    Position,
    MorphOffset,
    Uv,
    JointWeights,
    Time,
    /// Translations and scales.
    Vector,
    Rotation,
    MorphWeight,
    Matrix,
}

impl Purpose {
    fn dimensions(self) -> Dimensions {
        match self {
            Self::Position | Self::MorphOffset | Self::Vector => Dimensions::Vec3,
            Self::Uv => Dimensions::Vec2,
            Self::JointWeights | Self::Rotation => Dimensions::Vec4,
            Self::Time | Self::MorphWeight => Dimensions::Scalar,
            Self::Matrix => Dimensions::Mat4,
        }
    }

    /// True for integers that need no extension.
    fn takes(self, data: DataType, normalized: bool) -> bool {
        use DataType::{I8, I16, U8, U16};
        match self {
            Self::Uv | Self::JointWeights => normalized && matches!(data, U8 | U16),
            Self::Rotation | Self::MorphWeight => normalized && matches!(data, I8 | U8 | I16 | U16),
            _ => false,
        }
    }

    /// True for integers that `KHR_mesh_quantization` allows.
    fn takes_quantized(self, data: DataType) -> bool {
        match self {
            Self::Position | Self::Uv => !matches!(data, DataType::U32 | DataType::F32),
            Self::MorphOffset => matches!(data, DataType::I8 | DataType::I16),
            _ => false,
        }
    }

    fn due(self) -> &'static str {
        match self {
            Self::Position | Self::MorphOffset | Self::Vector => "VEC3 of F32",
            Self::Uv => "VEC2 of F32 or of normalized U8 or U16",
            Self::JointWeights => "VEC4 of F32 or of normalized U8 or U16",
            Self::Rotation => "VEC4 of F32 or of normalized integers of 8 or 16 bits",
            Self::MorphWeight => "SCALAR of F32 or of normalized integers of 8 or 16 bits",
            Self::Time => "SCALAR of F32",
            Self::Matrix => "MAT4 of F32",
        }
    }

    fn check(self, accessor: &Accessor, buffers: &Buffers) -> Result<(), AccessorError> {
        let (data, normalized) = (accessor.data_type(), accessor.normalized());
        let plain = (data == DataType::F32 && !normalized) || self.takes(data, normalized);
        if accessor.dimensions() != self.dimensions() {
            Err(wrong_type(accessor, self.due()))
        } else if plain || (self.takes_quantized(data) && buffers.quantized) {
            Ok(())
        } else if self.takes_quantized(data) && self != Self::Uv {
            Err(AccessorError::NotQuantized { found: type_name(accessor) })
        } else {
            Err(wrong_type(accessor, self.due()))
        }
    }
}

/// How a component becomes a number.
#[derive(Clone, Copy)]
enum Component {
    Float,
    Unsigned(f64),
    Signed(f64),
}

impl Component {
    /// Normalised integers by the formulas of the glTF 2.0 specification, section 3.11.
    fn of(accessor: &Accessor) -> Self {
        let one = |largest: f64| if accessor.normalized() { largest } else { 1.0 };
        match accessor.data_type() {
            DataType::F32 => Self::Float,
            DataType::I8 => Self::Signed(one(f64::from(i8::MAX))),
            DataType::I16 => Self::Signed(one(f64::from(i16::MAX))),
            DataType::U8 => Self::Unsigned(one(f64::from(u8::MAX))),
            DataType::U16 | DataType::U32 => Self::Unsigned(one(f64::from(u16::MAX))),
        }
    }

    fn read(self, bytes: &[u8]) -> f64 {
        match self {
            Self::Float => f64::from(f32::from_bits(unsigned(bytes))),
            Self::Unsigned(one) => f64::from(unsigned(bytes)) / one,
            Self::Signed(one) if one > 1.0 => (f64::from(signed(bytes)) / one).max(-1.0),
            Self::Signed(_) => f64::from(signed(bytes)),
        }
    }
}

/// Vectors of `N` finite numbers.
pub(super) struct Vectors<'a, const N: usize> {
    elements: Elements<'a>,
    component: Component,
}

impl<'a, const N: usize> Vectors<'a, N> {
    /// # Panics
    /// If vectors for `purpose` do not have `N` numbers.
    pub(super) fn new(accessor: &Accessor, buffers: &'a Buffers, purpose: Purpose) -> Result<Self, AccessorError> {
        assert_eq!(purpose.dimensions().multiplicity(), N, "{purpose:?}");
        purpose.check(accessor, buffers)?;
        Ok(Self { elements: Elements::new(accessor, buffers)?, component: Component::of(accessor) })
    }

    pub(super) fn count(&self) -> usize {
        self.elements.count
    }

    pub(super) fn get(&self, index: u32) -> Result<[f64; N], AccessorError> {
        let mut vector = [0.0; N];
        let Some(bytes) = self.elements.get(index)? else { return Ok(vector) };
        for (number, bytes) in vector.iter_mut().zip(bytes.chunks_exact(bytes.len() / N)) {
            *number = self.component.read(bytes);
        }
        if vector.iter().all(|x| x.is_finite()) {
            Ok(vector)
        } else {
            Err(AccessorError::Value { index, fault: "is infinite or not a number".into() })
        }
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

/// Four joints of each vertex, as numbers within a skin.
pub(super) struct Joints<'a> {
    elements: Elements<'a>,
}

impl<'a> Joints<'a> {
    pub(super) fn new(accessor: &Accessor, buffers: &'a Buffers) -> Result<Self, AccessorError> {
        match (accessor.dimensions(), accessor.data_type(), accessor.normalized()) {
            (Dimensions::Vec4, DataType::U8 | DataType::U16, false) => {
                Ok(Self { elements: Elements::new(accessor, buffers)? })
            }
            _ => Err(wrong_type(accessor, "VEC4 of U8 or U16")),
        }
    }

    pub(super) fn get(&self, index: u32) -> Result<[u32; 4], AccessorError> {
        let mut joints = [0; 4];
        if let Some(bytes) = self.elements.get(index)? {
            joints.iter_mut().zip(bytes.chunks_exact(bytes.len() / 4)).for_each(|(joint, b)| *joint = unsigned(b));
        }
        Ok(joints)
    }
}

fn type_name(accessor: &Accessor) -> String {
    let normalized = if accessor.normalized() { "normalized " } else { "" };
    let dimensions = format!("{:?}", accessor.dimensions()).to_uppercase();
    format!("{dimensions} of {normalized}{:?}", accessor.data_type())
}

fn wrong_type(accessor: &Accessor, expected: &'static str) -> AccessorError {
    AccessorError::Type { found: type_name(accessor), expected }
}
