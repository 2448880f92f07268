//! Points on a surface, where they come from and how what was found there is printed.

mod csv;
pub(crate) mod drawn;
pub(crate) mod exact;
mod grid;
mod list;

pub(crate) use csv::{HEADER, write_row};
pub(crate) use grid::grid;
pub(crate) use list::read;

use glam::DVec3;

/// A place on the surface: see the conventions in the help of `sample`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Face of the cage, from 0 in file order.
    pub(crate) face: u32,
    /// -1 for a quad, else the corner of the face.
    pub(crate) sub: i32,
    /// First coordinate on the unit square, in [0, 1].
    pub(crate) s: f64,
    /// Second coordinate on the unit square, in [0, 1].
    pub(crate) t: f64,
}

/// What an evaluator found at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// Position in the units of the cage.
    pub(crate) position: DVec3,
    /// Derivative by s.
    pub(crate) ds: DVec3,
    /// Derivative by t.
    pub(crate) dt: DVec3,
    /// Unit normal, or zero where it is not defined.
    pub(crate) normal: DVec3,
    /// Whether the place is a corner on an irregular vertex, where the derivatives are not those of the limit.
    pub(crate) irregular: bool,
}

/// Places to be sampled, in order.
pub(crate) struct Places {
    /// How many there are.
    pub(crate) len: u64,
    iterator: Box<dyn Iterator<Item = Place>>,
}

impl Places {
    /// Places in a batch: enough to keep all threads and a device busy, little to hold in memory.
    const BATCH: usize = 1 << 16;

    /// The places in batches.
    pub(crate) fn batches(mut self) -> impl Iterator<Item = Vec<Place>> {
        let next = move || Some(self.iterator.by_ref().take(Self::BATCH).collect::<Vec<_>>());
        std::iter::from_fn(next).take_while(|batch| !batch.is_empty())
    }
}
