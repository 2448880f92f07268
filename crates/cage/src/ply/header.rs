//! The header: the format and the elements with their properties.

use super::PlyError;
use crate::text::{integer, quoted, words};

/// How values are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Size in bytes where the format is binary.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, value: Scalar },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The name for messages.
    pub(super) fn name(&self) -> String {
        quoted(&self.name)
    }

    /// The index of a property with one of these names.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.iter().any(|name| name.as_bytes() == property.name))
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Where the values start, in bytes and as the number of a line.
    pub(super) end: usize,
    pub(super) end_line: u32,
}

/// Splits off lines that end the way the first one does: the byte after the last may belong to binary values.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: u32,
    end: &'static [u8],
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let first = bytes.iter().position(|&b| matches!(b, b'\n' | b'\r')).unwrap_or(bytes.len());
        let end: &[u8] = match &bytes[first..] {
            [b'\r', b'\n', ..] => b"\r\n",
            [b'\r', ..] => b"\r",
            _ => b"\n",
        };
        Self { bytes, at: 0, number: 0, end }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let length = rest.windows(self.end.len()).position(|window| window == self.end)?;
        self.at += length + self.end.len();
        self.number += 1;
        Some(&rest[..length])
    }
}

/// True if the bytes start as a PLY file does.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    bytes.strip_prefix(b"ply").is_some_and(|rest| rest.first().is_none_or(u8::is_ascii_whitespace))
}

/// Reads the header.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, PlyError> {
    if !is_ply(bytes) {
        return Err(PlyError::NotPly);
    }
    let mut lines = Lines::new(bytes);
    let (mut format, mut elements) = (None, Vec::new());
    while let Some(line) = lines.next() {
        let fault = |reason: String| PlyError::Header { line: lines.number, reason };
        let words: Vec<&[u8]> = words(line).collect();
        match words[..] {
            [] | [b"ply" | b"comment" | b"obj_info", ..] => {}
            [b"format", name, ..] => format = Some(parse_format(name).map_err(fault)?),
            [b"element", ..] if words.len() != 3 => {
                return Err(fault("an element looks like `element vertex 8`".into()));
            }
            [b"element", name, count] => elements.push(element(name, count, &elements).map_err(fault)?),
            [b"property", ..] => {
                let last = elements.last_mut().ok_or_else(|| {
                    fault("a property before the first element; properties follow the element they belong to".into())
                })?;
                add_property(last, &words[1..]).map_err(fault)?;
            }
            [b"end_header", ..] => {
                let format = format.ok_or_else(|| fault("the header has no line `format`".into()))?;
                return Ok(Header { format, elements, end: lines.at, end_line: lines.number + 1 });
            }
            [b"format"] => return Err(fault("a format looks like `format ascii 1.0`".into())),
            [word, ..] => return Err(fault(format!("{:?} is no statement of a PLY header", quoted(word)))),
        }
    }
    Err(PlyError::EndlessHeader)
}

fn parse_format(word: &[u8]) -> Result<Format, String> {
    match word {
        b"ascii" => Ok(Format::Ascii),
        b"binary_little_endian" => Ok(Format::LittleEndian),
        b"binary_big_endian" => Ok(Format::BigEndian),
        _ => {
            Err(format!("{:?} is no format; there are ascii, binary_little_endian and binary_big_endian", quoted(word)))
        }
    }
}

fn element(name: &[u8], count: &[u8], others: &[Element]) -> Result<Element, String> {
    let number = integer(count).and_then(|n| u64::try_from(n).ok());
    let number = number.ok_or_else(|| {
        format!("{:?} is not a number of elements; an element looks like `element vertex 8`", quoted(count))
    })?;
    if others.iter().any(|other| other.name == name) {
        return Err(format!("a second element {:?}; each has a name of its own", quoted(name)));
    }
    Ok(Element { name: name.into(), count: number, properties: Vec::new() })
}

fn add_property(element: &mut Element, words: &[&[u8]]) -> Result<(), String> {
    let scalar = |word: &[u8]| {
        Scalar::of(word).ok_or_else(|| {
            format!(
                "{:?} is no type; there are char, uchar, short, ushort, int, uint, float, double and int8 to float64",
                quoted(word)
            )
        })
    };
    let (kind, name) = match words {
        [b"list", count, value, name] => (Kind::List { count: scalar(count)?, value: scalar(value)? }, name),
        [kind, name] if kind != b"list" => (Kind::Scalar(scalar(kind)?), name),
        _ => return Err("a property looks like `property float x` or `property list uchar int vertex_indices`".into()),
    };
    if matches!(kind, Kind::List { count, .. } if !count.is_integer()) {
        return Err("the length of a list must be an integer".into());
    }
    if element.properties.iter().any(|other| other.name == *name) {
        return Err(format!("a second property {:?}; each has a name of its own", quoted(name)));
    }
    element.properties.push(Property { name: name.to_vec(), kind });
    Ok(())
}
