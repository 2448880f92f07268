//! The rates of all edges of a surface, and the table of their parameters that the kernels read.

use std::ops::Range;

use osculate_shaders::constant;
use osculate_subdiv::PatchRecord;
use rayon::prelude::*;

use crate::Spacing;
use crate::grid::Rate;

/// Number of a rate in [`GridRates`]: there are fewer than 2^16, because [`Rate::new`] rounds levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct RateId(u16);

impl RateId {
    /// [`Rate::HALVES`] of any table.
    pub(crate) const HALVES: Self = Self(0);
}

/// Which rate each edge record has.
#[derive(PartialEq)]
enum OfEdges {
    All(RateId),
    /// Those of unrefined faces, whose records are the first, and the others.
    Two {
        whole: RateId,
        whole_count: u32,
        others: RateId,
    },
    Each(Vec<RateId>),
}

/// The different rates of a surface's edges.
#[derive(PartialEq)]
pub(crate) struct GridRates {
    rates: Vec<Rate>,
    words: Vec<u32>,
    parameters: Vec<f32>,
    of_edges: OfEdges,
}

impl GridRates {
    /// One factor for all edges.
    pub(crate) fn uniform(factor: f32, spacing: Spacing) -> Self {
        let mut table = Self::new();
        table.of_edges = OfEdges::All(table.add(Rate::new(factor, spacing)));
        table
    }

    /// One number of equal segments for all sides of refined patches; of the edge records the first `whole_count` are those of unrefined faces, which have twice as many.
    pub(crate) fn where_needed(level: f32, whole_count: u32) -> Self {
        let mut table = Self::new();
        debug_assert_eq!(table.parameters.len() as u32, constant::GRID_WHOLE_PARAMETERS);
        let whole = table.add(Rate::new(2.0 * level.ceil(), Spacing::Equal));
        let others = table.add(Rate::new(level, Spacing::Equal));
        table.of_edges = OfEdges::Two { whole, whole_count, others };
        table
    }

    /// A factor for each edge record.
    pub(crate) fn per_edge(factors: &[f32], spacing: Spacing) -> Self {
        let edges: Vec<Rate> = factors.par_iter().map(|&factor| Rate::new(factor, spacing)).collect();
        let mut distinct = edges.clone();
        distinct.par_sort_unstable_by_key(|rate| rate.key());
        distinct.dedup();
        let mut table = Self::new();
        let ids: Vec<RateId> = distinct.iter().map(|&rate| table.add(rate)).collect();
        let find = |rate: &Rate| distinct.binary_search_by_key(&rate.key(), |other| other.key());
        let id = |rate| ids[find(rate).expect("the rate of every edge is in the table")];
        table.of_edges = OfEdges::Each(edges.par_iter().map(id).collect());
        table
    }

    fn new() -> Self {
        let mut table =
            Self { rates: vec![], words: vec![], parameters: vec![], of_edges: OfEdges::All(RateId::HALVES) };
        table.add(Rate::HALVES);
        table
    }

    fn add(&mut self, rate: Rate) -> RateId {
        let id = RateId(self.rates.len() as u16);
        self.words.push(((self.parameters.len() as u32) << Self::OFFSET_SHIFT) | rate.segments());
        self.parameters.extend(rate.parameters());
        self.rates.push(rate);
        id
    }

    /// In the word of a rate, the segments lie below this bit, the number of the first parameter from it on.
    pub(crate) const OFFSET_SHIFT: u32 = 7;

    /// Rate of an edge record.
    pub(crate) fn of_edge(&self, edge: u32) -> RateId {
        match &self.of_edges {
            OfEdges::All(id) => *id,
            OfEdges::Two { whole, whole_count, others } => {
                if edge < *whole_count {
                    *whole
                } else {
                    *others
                }
            }
            OfEdges::Each(ids) => ids[edge as usize],
        }
    }

    /// Rate of a side of a patch: half an edge has that of edges between refined patches.
    pub(crate) fn of_side(&self, record: &PatchRecord, side: usize) -> RateId {
        match &self.of_edges {
            OfEdges::Two { others, .. } if record.is_half(side) => *others,
            _ => self.of_edge(record.edge[side] / 2),
        }
    }

    /// The edge records, `count` in all, in at most two runs of edges that have the same rate; `None` if each may have its own.
    pub(crate) fn runs(&self, count: u32) -> Option<[(Range<u32>, RateId); 2]> {
        match self.of_edges {
            OfEdges::All(id) => Some([(0..count, id), (count..count, id)]),
            OfEdges::Two { whole, whole_count, others } => {
                Some([(0..whole_count, whole), (whole_count..count, others)])
            }
            OfEdges::Each(_) => None,
        }
    }

    pub(crate) fn rate(&self, id: RateId) -> Rate {
        self.rates[usize::from(id.0)]
    }

    /// What the kernels know of a rate.
    pub(crate) fn word(&self, id: RateId) -> u32 {
        self.words[usize::from(id.0)]
    }

    /// The greater of two rates.
    pub(crate) fn finer(&self, a: RateId, b: RateId) -> RateId {
        if self.rate(b).key() > self.rate(a).key() { b } else { a }
    }

    /// Parameters of all rates.
    pub(crate) fn parameters(&self) -> &[f32] {
        &self.parameters
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_factors_share_a_rate() {
        let table = GridRates::per_edge(&[3.0, 5.2, 3.0, 2.5, 5.0], Spacing::Equal);
        let segments = |edge| table.rate(table.of_edge(edge)).segments();
        assert_eq!((0..5).map(segments).collect::<Vec<_>>(), [3, 6, 3, 3, 5]);
        assert_eq!(table.of_edge(0), table.of_edge(2));
        assert_eq!(table.of_edge(0), table.of_edge(3));
        assert_eq!(table.rates.len(), 4);
    }

    #[test]
    fn words_find_the_parameters() {
        let factors: Vec<f32> = (0..70_000).map(|i| i as f32 * 0.001).collect();
        for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
            let table = GridRates::per_edge(&factors, spacing);
            for (edge, &factor) in factors.iter().enumerate() {
                let id = table.of_edge(edge as u32);
                assert_eq!(table.rate(id), Rate::new(factor, spacing));
                let word = table.word(id);
                let segments = word & ((1 << GridRates::OFFSET_SHIFT) - 1);
                let first = (word >> GridRates::OFFSET_SHIFT) as usize;
                let found = &table.parameters()[first..=first + segments as usize];
                assert!(table.rate(id).parameters().eq(found.iter().copied()));
            }
        }
    }

    #[test]
    fn the_finer_of_two_rates_has_the_greater_level() {
        let table = GridRates::per_edge(&[3.25, 3.5, 3.25], Spacing::Odd);
        let [a, b, c] = [0, 1, 2].map(|edge| table.of_edge(edge));
        assert_eq!((table.finer(a, b), table.finer(b, a), table.finer(a, c)), (b, b, a));
    }

    #[test]
    fn edges_of_unrefined_faces_have_twice_as_many_segments() {
        let table = GridRates::where_needed(2.3, 5);
        let segments = |id| table.rate(id).segments();
        assert_eq!([4, 5].map(|edge| segments(table.of_edge(edge))), [6, 3]);
        let word = table.word(table.of_edge(0));
        assert_eq!(word >> GridRates::OFFSET_SHIFT, constant::GRID_WHOLE_PARAMETERS);
        let half = PatchRecord { edge: [9, 8, 0, 0], tag: PatchRecord::HALF_0, ..PatchRecord::default() };
        assert_eq!([0, 1].map(|side| segments(table.of_side(&half, side))), [3, 6]);
        let runs = table.runs(7).unwrap();
        assert_eq!(runs.map(|(edges, id)| (edges, segments(id))), [(0..5, 6), (5..7, 3)]);
    }

    #[test]
    fn halves_are_always_there() {
        let table = GridRates::uniform(7.0, Spacing::Equal);
        assert_eq!(table.rate(RateId::HALVES), Rate::HALVES);
        assert_eq!(table.rate(table.of_edge(12)).segments(), 7);
    }
}
