//! Values one after the other, from text or bytes.

use super::PlyError;
use super::header::{Element, Format, Header, Kind, Scalar};
use crate::limits::Gauge;
use crate::text::{float, integer, quoted};

/// The element that is being read, for messages.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) element: &'a Element,
    pub(super) index: u64,
}

impl At<'_> {
    fn truncated(self) -> PlyError {
        PlyError::Truncated { element: self.element.name(), index: self.index, count: self.element.count }
    }
}

/// What is left of the values of a file.
pub(super) struct Source<'a> {
    format: Format,
    rest: &'a [u8],
    /// The line of `rest`, in text.
    line: u32,
}

impl<'a> Source<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        Self { format: header.format, rest: &bytes[header.end..], line: header.end_line }
    }

    pub(super) fn is_text(&self) -> bool {
        self.format == Format::Ascii
    }

    /// The line of the next word, from 1.
    pub(super) fn line(&mut self) -> u32 {
        self.skip_white();
        self.line
    }

    /// How many bytes are left.
    pub(super) fn left_bytes(&self) -> usize {
        self.rest.len()
    }

    /// What is left: words or bytes.
    pub(super) fn left(mut self) -> (&'static str, usize) {
        if !self.is_text() {
            return ("trailing byte", self.rest.len());
        }
        let mut words = 0;
        while !self.word().is_empty() {
            words += 1;
        }
        ("trailing word", words)
    }

    /// How many of an element's rows what is left can hold at most, as far as their sizes are known.
    pub(super) fn room(&self, element: &Element) -> u64 {
        // In text a value is a digit and a blank, though the last blank may be missing.
        let least = |scalar: Scalar| if self.is_text() { 2 } else { scalar.bytes() };
        let row: usize = element
            .properties
            .iter()
            .map(|property| match property.kind {
                Kind::Scalar(scalar) => least(scalar),
                Kind::List { count, .. } => least(count),
            })
            .sum();
        (self.rest.len() as u64 + 1) / row.max(1) as u64
    }

    /// A value as a number.
    pub(super) fn number(&mut self, scalar: Scalar, at: At<'_>) -> Result<f64, PlyError> {
        if self.is_text() {
            return self.parse(at, "a number", float);
        }
        let bytes = self.bytes(scalar.bytes(), at)?;
        Ok(match scalar {
            Scalar::F32 => f64::from(f32::from_bits(self.bits(bytes) as u32)),
            Scalar::F64 => f64::from_bits(self.bits(bytes)),
            _ => self.signed(scalar, bytes) as f64,
        })
    }

    /// A value of an integer type.
    pub(super) fn integer(&mut self, scalar: Scalar, at: At<'_>) -> Result<i64, PlyError> {
        if self.is_text() {
            return self.parse(at, "an integer", integer);
        }
        let bytes = self.bytes(scalar.bytes(), at)?;
        Ok(self.signed(scalar, bytes))
    }

    /// The length of a list whose values are really there.
    pub(super) fn length(&mut self, count: Scalar, value: Scalar, at: At<'_>) -> Result<usize, PlyError> {
        let length = self.integer(count, at)?;
        let wrong = || PlyError::ListLength { element: at.element.name(), index: at.index, length };
        let length = usize::try_from(length).map_err(|_| wrong())?;
        let room = if self.is_text() { self.rest.len() / 2 } else { self.rest.len() / value.bytes() };
        if length > room { Err(at.truncated()) } else { Ok(length) }
    }

    /// Steps over a property.
    pub(super) fn skip(&mut self, kind: Kind, at: At<'_>, gauge: &mut Gauge) -> Result<(), PlyError> {
        let (values, scalar) = match kind {
            Kind::Scalar(scalar) => (1, scalar),
            Kind::List { count, value } => (self.length(count, value, at)?, value),
        };
        if !self.is_text() {
            return self.bytes(values * scalar.bytes(), at).map(drop);
        }
        for _ in 0..values {
            gauge.part()?;
            if self.word().is_empty() {
                return Err(at.truncated());
            }
        }
        Ok(())
    }

    fn parse<T>(
        &mut self,
        at: At<'_>,
        expected: &'static str,
        parse: impl Fn(&[u8]) -> Option<T>,
    ) -> Result<T, PlyError> {
        let word = self.word();
        if word.is_empty() {
            return Err(at.truncated());
        }
        parse(word).ok_or_else(|| {
            let (word, element) = (quoted(word), at.element.name());
            PlyError::Word { line: self.line, word, element, index: at.index, expected }
        })
    }

    fn skip_white(&mut self) {
        let blank = self.rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(self.rest.len());
        let (blank, rest) = self.rest.split_at(blank);
        // CR LF counts once, by its LF; a CR alone is a line end too.
        let ends = |(i, b): (usize, &u8)| *b == b'\n' || (*b == b'\r' && blank.get(i + 1).is_none_or(|&b| b != b'\n'));
        let lines = blank.iter().enumerate().filter(|&pair| ends(pair)).count();
        self.line = self.line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX));
        self.rest = rest;
    }

    /// The next word, empty at the end.
    fn word(&mut self) -> &'a [u8] {
        self.skip_white();
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    fn bytes(&mut self, count: usize, at: At<'_>) -> Result<&'a [u8], PlyError> {
        let (bytes, rest) = self.rest.split_at_checked(count).ok_or_else(|| at.truncated())?;
        self.rest = rest;
        Ok(bytes)
    }

    /// At most eight bytes as a number, the first the lowest.
    fn bits(&self, bytes: &[u8]) -> u64 {
        let add = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        match self.format {
            Format::BigEndian => bytes.iter().fold(0, add),
            _ => bytes.iter().rev().fold(0, add),
        }
    }

    fn signed(&self, scalar: Scalar, bytes: &[u8]) -> i64 {
        let bits = self.bits(bytes);
        match scalar {
            Scalar::I8 => i64::from(bits as u8 as i8),
            Scalar::I16 => i64::from(bits as u16 as i16),
            Scalar::I32 => i64::from(bits as u32 as i32),
            _ => bits as i64,
        }
    }
}
