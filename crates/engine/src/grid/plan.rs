//! Cutting a surface into chunks of patches whose vertices fit a buffer.

use std::ops::Range;

use osculate_subdiv::{PatchRecord, SurfacePlan};
use rayon::prelude::*;

use crate::grid::chunk::{Chunk, Numbering};
use crate::grid::rates::RateId;
use crate::grid::{GridPatch, GridRates, Pattern};

/// Who has the vertices on the border of patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Layout {
    /// Vertex and edge records: one vertex for all patches of a chunk that meet there, so triangles close by index.
    Shared,
    /// Each patch its own, with its own (u,v); the same bits of position and normal, being read from the same records.
    Own,
}

/// What to plan.
#[derive(Clone, Copy)]
pub(crate) struct GridPlanDesc<'a> {
    /// The patches.
    pub(crate) surface: &'a SurfacePlan,
    /// How their edges are divided.
    pub(crate) rates: &'a GridRates,
    /// Who has the vertices of borders.
    pub(crate) layout: Layout,
    /// Most vertices of a chunk; a single patch may have more.
    pub(crate) max_vertices: u32,
}

/// Chunks of consecutive patches.
pub(crate) struct GridPlan<'a> {
    desc: GridPlanDesc<'a>,
    chunks: Vec<Range<u32>>,
}

impl<'a> GridPlan<'a> {
    pub(crate) fn new(desc: GridPlanDesc<'a>) -> Self {
        let counts: Vec<u32> =
            desc.surface.patches.par_iter().map(|record| desc.grid(record).pattern.vertex_count()).collect();
        let (mut chunks, mut first, mut room) = (Vec::new(), 0, desc.max_vertices);
        for (patch, &count) in counts.iter().enumerate() {
            let patch = patch as u32;
            if count > room && patch > first {
                chunks.push(first..patch);
                (first, room) = (patch, desc.max_vertices);
            }
            room = room.saturating_sub(count);
        }
        let patches = counts.len() as u32;
        if patches > first {
            chunks.push(first..patches);
        }
        Self { desc, chunks }
    }

    /// The patches of each chunk.
    pub(crate) fn ranges(&self) -> &[Range<u32>] {
        &self.chunks
    }

    /// The chunks, made one at a time: the indices of a fine tessellation are large.
    pub(crate) fn chunks(&self) -> impl Iterator<Item = Chunk> {
        let mut numbering = Numbering::new(self.desc.surface);
        self.chunks.iter().map(move |patches| Chunk::new(&self.desc, patches.clone(), &mut numbering))
    }
}

/// How one patch is divided.
pub(crate) struct PatchGrid {
    pub(crate) pattern: Pattern,
    sides: [RateId; 4],
    inner: [RateId; 2],
}

impl GridPlanDesc<'_> {
    /// How a patch is divided. Inside it is as fine as the finer of two opposite sides.
    pub(crate) fn grid(&self, record: &PatchRecord) -> PatchGrid {
        let rates = self.rates;
        let sides = record.edge.map(|edge| rates.of_edge(edge / 2));
        let inner = [rates.finer(sides[0], sides[2]), rates.finer(sides[1], sides[3])];
        let segments = |id| rates.rate(id).segments();
        let pattern = Pattern::quad(sides.map(segments), inner.map(segments));
        // The pattern may want two segments where the rates have one.
        let inner = match pattern {
            Pattern::Quad { inner: wanted, .. } => {
                [0, 1].map(|k| if segments(inner[k]) == wanted[k] { inner[k] } else { RateId::HALVES })
            }
            Pattern::Triangle { .. } => inner,
        };
        PatchGrid { pattern, sides, inner }
    }
}

impl PatchGrid {
    /// What the kernels know of it.
    pub(crate) fn record(&self, rates: &GridRates, patch: u32, first_inner: u32) -> GridPatch {
        GridPatch {
            patch,
            first_inner,
            sides: self.sides.map(|id| rates.word(id)),
            inner: self.inner.map(|id| rates.word(id)),
        }
    }
}
