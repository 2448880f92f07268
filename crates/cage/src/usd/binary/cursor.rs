//! Reading numbers one after the other.

use std::borrow::Cow;

use super::damaged;
use crate::usd::UsdError;
use crate::usd::values::Source;

/// A place in a file.
pub(super) struct Cursor<'s, 'a> {
    source: &'s Source<'a>,
    pub(super) at: u64,
}

impl<'s, 'a> Cursor<'s, 'a> {
    pub(super) fn new(source: &'s Source<'a>, at: u64) -> Self {
        Self { source, at }
    }

    /// The next bytes, all of which must be there.
    pub(super) fn bytes(&mut self, count: u64) -> Result<Cow<'a, [u8]>, UsdError> {
        let start = self.at;
        self.at = start.saturating_add(count);
        let bytes = self.source.bytes(start..self.at)?;
        bytes.ok_or_else(|| damaged(format!("{count} bytes are due at byte {start} of {}", self.source.length())))
    }

    /// The next `count` elements of `size` bytes.
    pub(super) fn elements(&mut self, count: u64, size: usize) -> Result<Cow<'a, [u8]>, UsdError> {
        self.bytes(count.saturating_mul(size as u64))
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], UsdError> {
        let mut array = [0; N];
        array.copy_from_slice(&self.bytes(N as u64)?);
        Ok(array)
    }

    pub(super) fn u8(&mut self) -> Result<u8, UsdError> {
        self.array().map(u8::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Result<u32, UsdError> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn u64(&mut self) -> Result<u64, UsdError> {
        self.array().map(u64::from_le_bytes)
    }

    /// Goes where the next number says, counted from itself.
    pub(super) fn follow(&mut self) -> Result<(), UsdError> {
        let from = self.at;
        let offset = i64::from_le_bytes(self.array()?);
        self.at =
            from.checked_add_signed(offset).ok_or_else(|| damaged(format!("byte {from} leads out of the file")))?;
        Ok(())
    }
}

/// Little-endian elements of `N` bytes.
pub(super) fn chunks<const N: usize>(bytes: &[u8]) -> impl ExactSizeIterator<Item = [u8; N]> {
    bytes.chunks_exact(N).map(|chunk| {
        let mut array = [0; N];
        array.copy_from_slice(chunk);
        array
    })
}
