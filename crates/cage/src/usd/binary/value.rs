//! Values of the binary form.

use super::coding;
use super::cursor::{Cursor, chunks};
use super::damaged;
use super::document::Tables;
use crate::usd::UsdError;
use crate::usd::values::{Budget, Source};

/// A value, or where it lies.
///
/// | bits | |
/// |---|---|
/// | 63 | it is an array |
/// | 62 | the low 32 bits are the value |
/// | 61 | it is compressed |
/// | 48..55 | its type |
/// | 0..47 | where it lies, from the start of the file |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::usd) struct ValueRep(pub(super) u64);

/// Types of values, by their numbers in the file.
pub(super) mod kind {
    pub(in super::super) const BOOL: u8 = 1;
    pub(in super::super) const U8: u8 = 2;
    pub(in super::super) const I32: u8 = 3;
    pub(in super::super) const U32: u8 = 4;
    pub(in super::super) const I64: u8 = 5;
    pub(in super::super) const U64: u8 = 6;
    pub(in super::super) const HALF: u8 = 7;
    pub(in super::super) const FLOAT: u8 = 8;
    pub(in super::super) const DOUBLE: u8 = 9;
    pub(in super::super) const STRING: u8 = 10;
    pub(in super::super) const TOKEN: u8 = 11;
    pub(in super::super) const MATRIX2: u8 = 13;
    pub(in super::super) const MATRIX4: u8 = 15;
    pub(in super::super) const QUATERNION_DOUBLE: u8 = 16;
    pub(in super::super) const QUATERNION_FLOAT: u8 = 17;
    pub(in super::super) const QUATERNION_HALF: u8 = 18;
    pub(in super::super) const VECTOR2_DOUBLE: u8 = 19;
    pub(in super::super) const VECTOR4_INT: u8 = 30;
    pub(in super::super) const PATH_LIST: u8 = 34;
    pub(in super::super) const TOKEN_VECTOR: u8 = 41;
    pub(in super::super) const SPECIFIER: u8 = 42;
    pub(in super::super) const TIME_SAMPLES: u8 = 46;
    pub(in super::super) const DOUBLE_VECTOR: u8 = 48;
    pub(in super::super) const STRING_VECTOR: u8 = 50;
    pub(in super::super) const BLOCK: u8 = 51;
    pub(in super::super) const TIME_CODE: u8 = 56;
}

/// The kinds of numbers in tuples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    Bool,
    U8,
    I32,
    U32,
    I64,
    U64,
    Half,
    Float,
    Double,
}

impl Number {
    fn bytes(self) -> usize {
        match self {
            Self::Bool | Self::U8 => 1,
            Self::Half => 2,
            Self::I32 | Self::U32 | Self::Float => 4,
            Self::I64 | Self::U64 | Self::Double => 8,
        }
    }

    fn read(self, bytes: &[u8]) -> Vec<f64> {
        match self {
            Self::Bool | Self::U8 => bytes.iter().map(|&byte| f64::from(byte)).collect(),
            Self::Half => chunks(bytes).map(|chunk| half(u16::from_le_bytes(chunk))).collect(),
            Self::I32 => chunks(bytes).map(|chunk| f64::from(i32::from_le_bytes(chunk))).collect(),
            Self::U32 => chunks(bytes).map(|chunk| f64::from(u32::from_le_bytes(chunk))).collect(),
            Self::Float => chunks(bytes).map(|chunk| f64::from(f32::from_le_bytes(chunk))).collect(),
            Self::I64 => chunks(bytes).map(|chunk| i64::from_le_bytes(chunk) as f64).collect(),
            Self::U64 => chunks(bytes).map(|chunk| u64::from_le_bytes(chunk) as f64).collect(),
            Self::Double => chunks(bytes).map(f64::from_le_bytes).collect(),
        }
    }
}

impl ValueRep {
    pub(super) fn is_array(self) -> bool {
        self.0 >> 63 & 1 == 1
    }

    pub(super) fn is_inlined(self) -> bool {
        self.0 >> 62 & 1 == 1
    }

    fn is_compressed(self) -> bool {
        self.0 >> 61 & 1 == 1
    }

    pub(super) fn kind(self) -> u8 {
        (self.0 >> 48) as u8
    }

    /// The place in the file.
    pub(super) fn place(self) -> u64 {
        self.0 & ((1 << 48) - 1)
    }

    /// The value itself, if it is in here.
    pub(super) fn inlined(self) -> u32 {
        self.0 as u32
    }

    /// The kind of numbers, how many make an element, and whether it is a matrix.
    fn shape(self) -> Option<(Number, usize, bool)> {
        let scalar = |number| Some((number, 1, false));
        match self.kind() {
            kind::BOOL => scalar(Number::Bool),
            kind::U8 => scalar(Number::U8),
            kind::I32 => scalar(Number::I32),
            kind::U32 => scalar(Number::U32),
            kind::I64 => scalar(Number::I64),
            kind::U64 => scalar(Number::U64),
            kind::HALF => scalar(Number::Half),
            kind::FLOAT => scalar(Number::Float),
            kind::DOUBLE | kind::DOUBLE_VECTOR | kind::TIME_CODE => scalar(Number::Double),
            kind @ kind::MATRIX2..=kind::MATRIX4 => {
                let rows = usize::from(kind - kind::MATRIX2) + 2;
                Some((Number::Double, rows * rows, true))
            }
            kind::QUATERNION_DOUBLE => Some((Number::Double, 4, false)),
            kind::QUATERNION_FLOAT => Some((Number::Float, 4, false)),
            kind::QUATERNION_HALF => Some((Number::Half, 4, false)),
            kind @ kind::VECTOR2_DOUBLE..=kind::VECTOR4_INT => {
                let index = usize::from(kind - kind::VECTOR2_DOUBLE);
                let number = [Number::Double, Number::Float, Number::Half, Number::I32][index % 4];
                Some((number, index / 4 + 2, false))
            }
            _ => None,
        }
    }
}

/// The numbers of a value that is a tuple of `size` numbers or an array of such tuples. Quaternions start with the real part.
pub(in crate::usd) fn numbers(
    source: &Source,
    tables: &Tables,
    rep: ValueRep,
    size: usize,
    budget: &Budget,
) -> Result<Vec<f64>, UsdError> {
    let Some((number, per_element, is_matrix)) = rep.shape().filter(|shape| shape.1 == size) else {
        return Err(UsdError::Type(match size {
            1 => "numbers",
            2 => "pairs of numbers",
            3 => "triples of numbers",
            4 => "quadruples of numbers",
            _ => "matrices",
        }));
    };
    let mut found = match rep {
        _ if rep.is_array() || rep.kind() == kind::DOUBLE_VECTOR => {
            array(source, tables, rep, (number, per_element), budget)?
        }
        _ if rep.is_inlined() => inlined(rep, number, per_element, is_matrix),
        _ => {
            budget.take(per_element as u64)?;
            number.read(&Cursor::new(source, rep.place()).elements(per_element as u64, number.bytes())?)
        }
    };
    if (kind::QUATERNION_DOUBLE..=kind::QUATERNION_HALF).contains(&rep.kind()) {
        found.chunks_exact_mut(4).for_each(|quaternion| quaternion.rotate_right(1));
    }
    Ok(found)
}

/// A value of at most 32 bits; larger ones are here if they can be written with fewer: 64-bit numbers with 32, vectors and the diagonals
/// of matrices with 8 bits for each number.
fn inlined(rep: ValueRep, number: Number, size: usize, is_matrix: bool) -> Vec<f64> {
    let bits = rep.inlined();
    let bytes = bits.to_le_bytes();
    let signed = |i: usize| f64::from(bytes.get(i).map_or(0, |&byte| byte.cast_signed()));
    if is_matrix {
        let rows = size.isqrt();
        return (0..size).map(|i| if i % (rows + 1) == 0 { signed(i / (rows + 1)) } else { 0.0 }).collect();
    }
    match (number, size) {
        (Number::Half, 2) => number.read(&bytes),
        (_, 2..) => (0..size).map(signed).collect(),
        (Number::Double, _) => Number::Float.read(&bytes),
        (Number::I64, _) => Number::I32.read(&bytes),
        (Number::U64, _) => Number::U32.read(&bytes),
        (number, _) => number.read(&bytes[..number.bytes()]),
    }
}

fn array(
    source: &Source,
    tables: &Tables,
    rep: ValueRep,
    (number, size): (Number, usize),
    budget: &Budget,
) -> Result<Vec<f64>, UsdError> {
    // Shorter arrays are never compressed.
    const SHORTEST_COMPRESSED: u64 = 16;
    if rep.place() == 0 || rep.is_inlined() {
        return Ok(Vec::new());
    }
    let mut cursor = Cursor::new(source, rep.place());
    // A vector is stored in the same way in all versions, and as it is.
    let is_vector = rep.kind() == kind::DOUBLE_VECTOR;
    let count = if is_vector { cursor.u64()? } else { tables.array_length(&mut cursor)? };
    budget.take(count.saturating_mul(size as u64))?;
    if is_vector || !rep.is_compressed() || count < SHORTEST_COMPRESSED {
        return Ok(number.read(&cursor.elements(count.saturating_mul(size as u64), number.bytes())?));
    }
    let as_numbers = |integers: Vec<i64>| integers.into_iter().map(|integer| integer as f64).collect();
    match number {
        _ if size != 1 => Err(damaged("a compressed array of tuples")),
        Number::I32 => coding::integers::<4>(&mut cursor, count).map(as_numbers),
        Number::U32 => {
            let integers = coding::integers::<4>(&mut cursor, count)?;
            Ok(integers.into_iter().map(|integer| f64::from(integer as u32)).collect())
        }
        Number::I64 | Number::U64 => coding::integers::<8>(&mut cursor, count).map(as_numbers),
        Number::Half | Number::Float | Number::Double => match cursor.u8()? {
            b'i' => coding::integers::<4>(&mut cursor, count).map(as_numbers),
            b't' => looked_up(&mut cursor, count, number),
            code => Err(damaged(format!("unknown compression {:?} of numbers", char::from(code)))),
        },
        Number::Bool | Number::U8 => Err(damaged("a compressed array of bytes")),
    }
}

/// Indices into a table of the different numbers.
fn looked_up(cursor: &mut Cursor, count: u64, number: Number) -> Result<Vec<f64>, UsdError> {
    let size = cursor.u32()?;
    let table = number.read(&cursor.elements(u64::from(size), number.bytes())?);
    let indices = coding::integers::<4>(cursor, count)?;
    let entry = |index: i64| usize::try_from(index).ok().and_then(|index| table.get(index)).copied();
    let numbers: Option<Vec<f64>> = indices.into_iter().map(entry).collect();
    numbers.ok_or_else(|| damaged("a compressed array goes beyond its table"))
}

/// The texts of a value that is a token, a text, a list of paths, or an array of tokens or texts.
pub(in crate::usd) fn words(
    source: &Source,
    tables: &Tables,
    rep: ValueRep,
    budget: &Budget,
) -> Result<Vec<String>, UsdError> {
    let mut cursor = Cursor::new(source, rep.place());
    let is_string = matches!(rep.kind(), kind::STRING | kind::STRING_VECTOR);
    let word = |index: u32| {
        let word = tables.word(index, is_string)?;
        budget.take(1 + word.len() as u64 / 8)?;
        Ok(word)
    };
    match rep.kind() {
        kind::TOKEN | kind::STRING if !rep.is_array() => {
            let index = if rep.is_inlined() { rep.inlined() } else { cursor.u32()? };
            Ok(vec![word(index)?])
        }
        kind::TOKEN | kind::STRING if rep.place() == 0 => Ok(Vec::new()),
        kind::TOKEN | kind::STRING => {
            let count = tables.array_length(&mut cursor)?;
            indices(&mut cursor, count, budget)?.into_iter().map(word).collect()
        }
        kind::TOKEN_VECTOR | kind::STRING_VECTOR => {
            let count = cursor.u64()?;
            indices(&mut cursor, count, budget)?.into_iter().map(word).collect()
        }
        kind::PATH_LIST => {
            let mut found = Vec::new();
            // One bit each for: explicit, then lists of explicit, added, deleted, ordered, prepended, appended paths.
            let lists = cursor.u8()? >> 1;
            // In the file: explicit, added, prepended, appended; the rest adds nothing.
            for bit in [0, 1, 4, 5] {
                if lists >> bit & 1 == 1 {
                    let count = cursor.u64()?;
                    for path in indices(&mut cursor, count, budget)? {
                        let path = tables.path(path)?;
                        budget.take(path.len() as u64 / 8)?;
                        found.push(path);
                    }
                }
            }
            Ok(found)
        }
        _ => Err(UsdError::Type("texts")),
    }
}

fn indices(cursor: &mut Cursor, count: u64, budget: &Budget) -> Result<Vec<u32>, UsdError> {
    budget.take(count.saturating_mul(4))?;
    Ok(chunks(&cursor.elements(count, 4)?).map(u32::from_le_bytes).collect())
}

/// A number of 16 bits: sign, 5 bits of exponent, 10 of mantissa.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    sign * match exponent {
        0 => mantissa * 2.0_f64.powi(-24),
        31 if mantissa == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + mantissa) * 2.0_f64.powi(exponent - 25),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves() {
        for (bits, value) in [(0x3c00, 1.0), (0xc000, -2.0), (0x3555, 0.333_251_953_125), (0x0001, 2.0_f64.powi(-24))] {
            assert_eq!(half(bits), value);
        }
        assert_eq!(half(0x7c00), f64::INFINITY);
        assert!(half(0x7e00).is_nan());
    }

    #[test]
    fn small_values_are_in_their_representation() {
        let read = |kind: u8, bits: u32| {
            let rep = ValueRep(1 << 62 | u64::from(kind) << 48 | u64::from(bits));
            let (number, size, is_matrix) = rep.shape().expect("numbers");
            inlined(rep, number, size, is_matrix)
        };
        assert_eq!(read(kind::FLOAT, 1.5_f32.to_bits()), [1.5]);
        assert_eq!(read(kind::DOUBLE, (-2.5_f32).to_bits()), [-2.5]);
        assert_eq!(read(kind::I32, u32::MAX), [-1.0]);
        assert_eq!(read(kind::BOOL, 1), [1.0]);
        assert_eq!(read(24, 0x00_fe_02_01), [1.0, 2.0, -2.0]);
        let scale = read(kind::MATRIX4, 0x01_03_02_ff);
        assert_eq!([scale[0], scale[5], scale[10], scale[15], scale[1]], [-1.0, 2.0, 3.0, 1.0, 0.0]);
    }
}
