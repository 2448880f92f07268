//! Points on a surface, where they come from and how what was found there is printed.

mod csv;
pub(crate) mod exact;
mod grid;
mod list;

pub(crate) use csv::{HEADER, write_row};
pub(crate) use grid::grid;
pub(crate) use list::read;

use osculate::SurfacePoint;

/// Places to be sampled, in order: see the conventions in the help of `sample`.
pub(crate) struct Places {
    /// How many there are.
    pub(crate) len: u64,
    iterator: Box<dyn Iterator<Item = SurfacePoint>>,
}

impl Places {
    /// Places in a batch: enough to keep all threads and a device busy, little to hold in memory.
    const BATCH: usize = 1 << 16;

    /// The places in batches.
    pub(crate) fn batches(mut self) -> impl Iterator<Item = Vec<SurfacePoint>> {
        let next = move || Some(self.iterator.by_ref().take(Self::BATCH).collect::<Vec<_>>());
        std::iter::from_fn(next).take_while(|batch| !batch.is_empty())
    }
}
