//! Walking around a vertex.

use std::iter::FusedIterator;

use super::Topology;
use crate::NONE;

/// The outgoing half-edges of a vertex, counter-clockwise; see [`Topology::ring`].
#[derive(Clone, Debug)]
pub struct Ring<'a> {
    topology: &'a Topology,
    start: u32,
    /// The half-edge to return next, [`NONE`] at the end.
    current: u32,
}

impl<'a> Ring<'a> {
    pub(super) fn new(topology: &'a Topology, start: u32) -> Self {
        Self { topology, start, current: start }
    }
}

impl Iterator for Ring<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.current == NONE {
            return None;
        }
        let h = self.current;
        // The previous half-edge of the face comes in to the vertex; its twin goes out, one face further counter-clockwise.
        let rotated = self.topology.twin(self.topology.prev(h));
        self.current = if rotated == self.start { NONE } else { rotated };
        Some(h)
    }
}

impl FusedIterator for Ring<'_> {}
