//! Cutting a surface into chunks of patches whose vertices fit a buffer.

use std::ops::Range;

use osculate_shaders::layout::GridPatch;
use osculate_subdiv::{NONE, PatchRecord, SurfacePlan};
use rayon::prelude::*;

use crate::grid::chunk::{Chunk, Numbering};
use crate::grid::rates::RateId;
use crate::grid::{GridRates, Pattern};

/// Who has the vertices on the border of patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Layout {
    /// Vertex and edge records: one vertex for all patches of a chunk that meet there, so triangles close by index.
    Shared,
    /// The same, numbered as the records are: those of vertices, then those along each edge, in the record's direction. For edges that are all divided alike, and
    /// all patches in one chunk; then whoever makes a record knows where its vertices belong.
    ByRecord,
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
        if desc.layout == Layout::ByRecord {
            let patches = desc.surface.patches.len() as u32;
            return Self { desc, chunks: std::iter::once(0..patches).collect() };
        }
        let counts: Vec<u32> =
            desc.surface.patches.par_iter().map(|record| desc.grid(record).pattern.vertex_count()).collect();
        let mut chunks = Vec::new();
        for run in desc.surface.drawn() {
            let (mut first, mut room) = (run.start, desc.max_vertices);
            for patch in run.clone() {
                let count = counts[patch as usize];
                if count > room && patch > first {
                    chunks.push(first..patch);
                    (first, room) = (patch, desc.max_vertices);
                }
                room = room.saturating_sub(count);
            }
            chunks.push(first..run.end);
        }
        Self { desc, chunks }
    }

    /// The chunks, made one at a time: the indices of a fine tessellation are large.
    pub(crate) fn into_chunks(self) -> impl Iterator<Item = Chunk> {
        let Self { desc, chunks } = self;
        let mut numbering = Numbering::new(desc.surface);
        chunks.into_iter().map(move |patches| Chunk::new(&desc, patches, &mut numbering))
    }
}

impl GridPlanDesc<'_> {
    /// The edges in runs that are divided alike, and where their vertices are if they are numbered by records; `None` if each may be divided in its own way.
    pub(crate) fn edge_runs(&self) -> Option<[EdgeRun; 2]> {
        let runs = self.rates.runs(self.surface.edge_record_count() as u32)?;
        let mut next = self.surface.vertex_records.count() as u64;
        Some(runs.map(|(edges, rate)| {
            let run = EdgeRun { first_vertex: next, between: self.rates.rate(rate).segments() - 1, rate, edges };
            next = run.end();
            run
        }))
    }

    /// How many vertices there are if they are numbered by records; `None` if edges are not divided alike, but for those of unrefined faces.
    pub(crate) fn count_by_record(&self) -> Option<u64> {
        let [_, last] = self.edge_runs()?;
        let inside = |record| u64::from(self.grid(record).pattern.inner_count());
        let inside: u64 = self.surface.patches.par_iter().map(inside).sum();
        Some(last.end() + inside)
    }

    /// How a patch is divided: inside as finely as the finer of two opposite sides, or as the finest of three.
    pub(crate) fn grid(&self, record: &PatchRecord) -> PatchGrid {
        if record.sides() == 3 { self.triangle(record) } else { self.quad(record) }
    }

    fn quad(&self, record: &PatchRecord) -> PatchGrid {
        let rates = self.rates;
        let sides = [0, 1, 2, 3].map(|side| rates.of_side(record, side));
        let inner = [rates.finer(sides[0], sides[2]), rates.finer(sides[1], sides[3])];
        let segments = |id| rates.rate(id).segments();
        let pattern = Pattern::quad(sides.map(segments), inner.map(segments));
        // The pattern may want two segments where the rates have one.
        let plain = pattern.inner_count() == 0;
        let inner = inner.map(|id| if plain || segments(id) > 1 { id } else { RateId::HALVES });
        PatchGrid { pattern, side_rate: sides.map(|id| rates.word(id)), inner_rate: inner.map(|id| rates.word(id)) }
    }

    fn triangle(&self, record: &PatchRecord) -> PatchGrid {
        let rates = self.rates;
        let sides = [0, 1, 2].map(|k| rates.of_edge(record.edge[k] / 2));
        let segments = |id| rates.rate(id).segments();
        let finest = rates.finer(rates.finer(sides[0], sides[1]), sides[2]);
        let pattern = Pattern::triangle(sides.map(segments), segments(finest));
        let [a, b, c] = sides.map(|id| rates.word(id));
        // Equal segments need no parameters.
        PatchGrid { pattern, side_rate: [a, b, c, 0], inner_rate: [pattern.inner_segments()[0]; 2] }
    }
}

/// Consecutive edge records that are divided alike, with vertices that are numbered by records.
#[derive(Clone, Debug)]
pub(crate) struct EdgeRun {
    pub(crate) edges: Range<u32>,
    pub(crate) rate: RateId,
    /// Vertices of each edge, without its ends.
    between: u32,
    /// Vertex number of the first vertex of the first edge.
    first_vertex: u64,
}

impl EdgeRun {
    /// Vertex number after the last one of the last edge.
    pub(crate) fn end(&self) -> u64 {
        self.first_vertex + u64::from(self.between) * self.edges.len() as u64
    }

    /// Vertex number of the first vertex of edge record `edge`, which may be any if only the numbers of those of the run are to come out right.
    pub(crate) fn vertex_of(&self, edge: u32) -> u32 {
        (self.first_vertex as u32).wrapping_add(self.between.wrapping_mul(edge.wrapping_sub(self.edges.start)))
    }
}

/// How one patch is divided.
pub(crate) struct PatchGrid {
    pub(crate) pattern: Pattern,
    side_rate: [u32; 4],
    inner_rate: [u32; 2],
}

impl PatchGrid {
    /// What the kernels know of it, its vertices not numbered yet.
    pub(crate) fn record(&self, patch_id: u32) -> GridPatch {
        GridPatch {
            patch_id,
            owned: 0,
            first_inner: NONE,
            side_rate: self.side_rate,
            inner_rate: self.inner_rate,
            corner_vertex: [NONE; 4],
            side_vertex: [NONE; 4],
        }
    }
}
