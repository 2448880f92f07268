//! Quads by shape: neighbours that make a flat quad with angles near right ones, best first. Quads next to those that are found
//! come before others if their sides go on straight, so that rows of quads grow in one direction.
//!
//! The diagonal of a quad is seldom in doubt: with another neighbour, its halves make a worse one. In a mesh that never had quads
//! any neighbour is as good as another. If the quads that are found do not lead clearly, all triangles stay.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap, HashSet};

use super::{Found, Pair, Points};
use crate::progress::{Cancelled, Watch};

/// Quads below this quality are never made.
const LEAST: f64 = 0.3;
/// Mean of how much better a quad is than the best that its triangles could make with others. Of cages of quads, cut and shuffled,
/// those of organic shapes had 0.32 to 0.41, others more; a cage of triangles had 0.15, a subdivided icosahedron less than 0.1.
const LEAD: f64 = 0.24;
/// Part of the triangles that must be in quads.
const ENOUGH: f64 = 0.6;

/// The pairs of good shape, if the triangles look like halves of quads.
pub(super) fn pairs(triangles: &[[u32; 3]], points: &Points, watch: &Watch) -> Found<Vec<Pair>> {
    let mut matching = Matching::new(triangles, points, watch)?;
    matching.grow(watch)?;
    matching.augment(watch)?;
    let pairs = matching.pairs();
    let covered = 2.0 * pairs.len() as f64 / triangles.len() as f64;
    let lead = pairs.iter().map(|pair| matching.lead(pair)).sum::<f64>() / pairs.len().max(1) as f64;
    Ok((covered >= ENOUGH && lead >= LEAD).then_some(pairs))
}

/// A set of candidates of which no two share a triangle, in the making.
struct Matching<'a> {
    points: &'a Points<'a>,
    candidates: Vec<Pair>,
    /// For each triangle the candidates it is in, at most three.
    of_triangle: Vec<Vec<u32>>,
    /// For each triangle the candidate it was given to.
    chosen: Vec<Option<u32>>,
    /// Triangles by the vertices of an edge, in the direction in which the triangle runs it.
    by_edge: HashMap<[u32; 2], u32>,
    /// Edges that may still be taken from a vertex.
    spare: HashMap<u32, u32>,
}

impl<'a> Matching<'a> {
    fn new(triangles: &[[u32; 3]], points: &'a Points<'a>, watch: &Watch) -> Result<Self, Cancelled> {
        let edges = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|point| points.vertex(point));
            [[a, b], [b, c], [c, a]]
        };
        let mut by_edge = HashMap::new();
        let mut spare: HashMap<u32, u32> = HashMap::new();
        for (t, triangle) in (0..).zip(triangles) {
            watch.pulse(u64::from(t))?;
            for edge in edges(triangle) {
                // An edge that two triangles run in the same direction is refused later on.
                by_edge.entry(edge).or_insert(t);
                *spare.entry(edge[0]).or_default() += 1;
            }
        }
        // Inner vertices keep three edges; those at the rim, which have one more than triangles, keep two.
        let inner = |v: u32, rim: &HashSet<u32>| if rim.contains(&v) { 1 } else { 3 };
        let open = by_edge.keys().filter(|&&[a, b]| !by_edge.contains_key(&[b, a]));
        let rim: HashSet<u32> = open.flatten().copied().collect();
        spare.iter_mut().for_each(|(&v, edges)| *edges = edges.saturating_sub(inner(v, &rim)));
        let mut candidates = Vec::new();
        let mut of_triangle = vec![Vec::new(); triangles.len()];
        for (t, triangle) in (0..).zip(triangles) {
            watch.at(t)?;
            let across = edges(triangle).map(|[a, b]| by_edge.get(&[b, a]).copied());
            for u in across.into_iter().flatten().filter(|&u| u > t) {
                let Some(pair) = points.pair(triangles, [t, u]).filter(|pair| pair.quality >= LEAST) else { continue };
                pair.triangles.iter().for_each(|&t| of_triangle[t as usize].push(candidates.len() as u32));
                candidates.push(pair);
            }
        }
        let chosen = vec![None; triangles.len()];
        Ok(Self { points, candidates, of_triangle, chosen, by_edge, spare })
    }

    fn is_free(&self, candidate: u32) -> bool {
        self.candidates[candidate as usize].triangles.iter().all(|&t| self.chosen[t as usize].is_none())
    }

    /// The ends of the diagonal, which lose an edge.
    fn diagonal(&self, candidate: u32) -> [u32; 2] {
        let pair = &self.candidates[candidate as usize];
        // The corner of the first triangle that is not on the diagonal keeps its place up to the new corner's.
        let opposite = usize::from(pair.pattern / 3);
        let at = if opposite == 2 { 3 } else { opposite };
        [pair.quad[(at + 1) % 4], pair.quad[(at + 3) % 4]].map(|point| self.points.vertex(point))
    }

    fn choose(&mut self, candidate: u32) {
        for v in self.diagonal(candidate) {
            *self.spare.entry(v).or_default() -= 1;
        }
        for t in self.candidates[candidate as usize].triangles {
            self.chosen[t as usize] = Some(candidate);
        }
    }

    fn release(&mut self, candidate: u32) {
        for v in self.diagonal(candidate) {
            *self.spare.entry(v).or_default() += 1;
        }
        for t in self.candidates[candidate as usize].triangles {
            self.chosen[t as usize] = None;
        }
    }

    fn can_choose(&self, candidate: u32) -> bool {
        self.is_free(candidate) && self.diagonal(candidate).iter().all(|v| self.spare.get(v).is_some_and(|&n| n > 0))
    }

    /// Chooses candidates, the most urgent first.
    fn grow(&mut self, watch: &Watch) -> Result<(), Cancelled> {
        let urgency = |(c, pair): (u32, &Pair)| Urgent { urgency: pair.quality, candidate: c };
        let mut open: BinaryHeap<Urgent> = (0..).zip(&self.candidates).map(urgency).collect();
        let mut turns = 0;
        while let Some(Urgent { candidate, .. }) = open.pop() {
            turns += 1;
            watch.pulse(turns)?;
            if !self.can_choose(candidate) {
                continue;
            }
            self.choose(candidate);
            let quad = self.candidates[candidate as usize].quad.map(|point| self.points.vertex(point));
            for side in 0..4 {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| quad[(side + k) % 4]);
                let Some(&t) = self.by_edge.get(&[b, a]) else { continue };
                for &next in self.of_triangle[t as usize].iter().filter(|&&next| self.is_free(next)) {
                    let Some(flow) = self.flow(next, [b, a], [c, d]) else { continue };
                    open.push(Urgent { urgency: self.candidates[next as usize].quality + flow, candidate: next });
                }
            }
        }
        Ok(())
    }

    /// How straight the sides of a quad beyond the edge `[b, a]` go on from the sides c-b and d-a: the mean cosine, at least 0.
    fn flow(&self, candidate: u32, [b, a]: [u32; 2], [c, d]: [u32; 2]) -> Option<f64> {
        let quad = self.candidates[candidate as usize].quad.map(|point| self.points.vertex(point));
        let at = (0..4).find(|&k| quad[k] == b && quad[(k + 1) % 4] == a)?;
        let (x, y) = (quad[(at + 2) % 4], quad[(at + 3) % 4]);
        let position = |v: u32| self.points.positions[v as usize];
        let straight = |from: u32, over: u32, to: u32| {
            let [before, after] = [position(over) - position(from), position(to) - position(over)];
            before.normalize_or_zero().dot(after.normalize_or_zero())
        };
        Some((0.5 * (straight(d, a, x) + straight(c, b, y))).max(0.0))
    }

    /// Gives triangles that are left a partner by taking it from one that finds another among those that are left.
    fn augment(&mut self, watch: &Watch) -> Result<(), Cancelled> {
        for t in 0..self.chosen.len() {
            watch.at(t as u32)?;
            for k in 0..self.of_triangle[t].len() {
                let first = self.of_triangle[t][k];
                if self.chosen[t].is_some() || self.try_chain(t as u32, first) {
                    break;
                }
            }
        }
        Ok(())
    }

    fn try_chain(&mut self, t: u32, first: u32) -> bool {
        let other = |triangles: [u32; 2], t: u32| if triangles[0] == t { triangles[1] } else { triangles[0] };
        let middle = other(self.candidates[first as usize].triangles, t);
        let Some(old) = self.chosen[middle as usize] else { return false };
        let widowed = other(self.candidates[old as usize].triangles, middle);
        self.release(old);
        for k in 0..self.of_triangle[widowed as usize].len() {
            let second = self.of_triangle[widowed as usize][k];
            if second == old || !self.can_choose(second) {
                continue;
            }
            self.choose(second);
            if self.can_choose(first) {
                self.choose(first);
                return true;
            }
            self.release(second);
        }
        self.choose(old);
        false
    }

    /// How much better a quad is than the best that its triangles could make with others.
    fn lead(&self, pair: &Pair) -> f64 {
        let candidates = pair.triangles.iter().flat_map(|&t| &self.of_triangle[t as usize]);
        let others =
            candidates.map(|&c| &self.candidates[c as usize]).filter(|other| other.triangles != pair.triangles);
        pair.quality - others.map(|other| other.quality).fold(0.0, f64::max)
    }

    fn pairs(&self) -> Vec<Pair> {
        let own = |(t, chosen): (u32, &Option<u32>)| {
            let pair = self.candidates[(*chosen)? as usize];
            (pair.triangles[0] == t).then_some(pair)
        };
        (0..).zip(&self.chosen).filter_map(own).collect()
    }
}

/// A candidate in the queue: the highest urgency first, then the first candidate.
struct Urgent {
    urgency: f64,
    candidate: u32,
}

impl Ord for Urgent {
    fn cmp(&self, other: &Self) -> Ordering {
        self.urgency.total_cmp(&other.urgency).then(other.candidate.cmp(&self.candidate))
    }
}

impl PartialOrd for Urgent {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Urgent {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Urgent {}
