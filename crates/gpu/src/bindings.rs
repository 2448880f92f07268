//! Which buffer is at which binding number.

use std::{ops::Range, sync::Arc};

use crate::Buffer;

/// Buffers by binding number. May hold more than a pipeline uses: each takes those that its shaders declare. Clones are cheap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bindings {
    /// Ascending by number.
    entries: Arc<Vec<(u32, Bound)>>,
}

/// A buffer, or a part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Bound {
    pub(crate) buffer: Buffer,
    /// Bytes; `None` is the whole buffer.
    pub(crate) range: Option<Range<u64>>,
}

impl Bindings {
    /// No buffers yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a buffer, in place of any earlier one with this number.
    #[must_use]
    pub fn with(self, binding: u32, buffer: &Buffer) -> Self {
        self.set(binding, Bound { buffer: buffer.clone(), range: None })
    }

    /// Adds a range of bytes of a buffer. Its start must be a multiple of the device's alignment, see
    /// [`Limits`](crate::Limits).
    #[must_use]
    pub fn with_range(self, binding: u32, buffer: &Buffer, bytes: Range<u64>) -> Self {
        self.set(binding, Bound { buffer: buffer.clone(), range: Some(bytes) })
    }

    fn set(mut self, binding: u32, bound: Bound) -> Self {
        let entries = Arc::make_mut(&mut self.entries);
        match entries.binary_search_by_key(&binding, |(number, _)| *number) {
            Ok(position) => entries[position].1 = bound,
            Err(position) => entries.insert(position, (binding, bound)),
        }
        self
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
