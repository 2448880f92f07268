//! Vertices: one for each fan of corners that pairs of half-edges hold together.

use std::collections::HashSet;

use rayon::prelude::*;

use super::loops::Loops;
use super::pairs::Pairs;
use crate::NONE;
use crate::progress::{Cancelled, Watch};

/// The vertices of a repaired mesh.
pub(super) struct Fans {
    /// The vertex of each corner.
    pub(super) vertices: Vec<u32>,
    /// For each vertex that of the description which it stands for: the lowest of its corners.
    pub(super) sources: Vec<u32>,
}

/// Rounds of cutting after which faces are cut out, and after which all are. The first resolves all but contrived meshes.
const PATIENCE: [usize; 2] = [4, 16];

/// Makes vertices, taking pairs apart where a face would visit a vertex twice or two edges would have the same ends: such meshes
/// exist, but indices cannot describe them.
///
/// Pairs of this repair go first. So a mesh in order loses none of its own, and what one repair could not join, the next
/// one does not join at the cost of another edge, and so on for ever.
pub(super) fn make(loops: &Loops, pairs: &mut Pairs, watch: &Watch) -> Result<Fans, Cancelled> {
    let (mut round, mut fresh_round) = (0, 0);
    loop {
        let fans = Fans::number(loops, pairs, watch)?;
        let conflicts = fans.conflicts(loops, pairs, watch)?;
        if conflicts.is_empty() {
            return Ok(fans);
        }
        if fans.cut_fresh(&conflicts, fresh_round > PATIENCE[0], loops, pairs) {
            fresh_round += 1;
            continue;
        }
        for conflict in conflicts {
            let cuts = conflict.iter().filter(|h| pairs.cut(**h)).count();
            if cuts == 0 || round > PATIENCE[0] {
                let faces = conflict.iter().map(|&h| loops.faces[h as usize]);
                faces.for_each(|f| pairs.cut_out(loops.row(f)));
            }
        }
        if round > PATIENCE[1] {
            // Faces without common vertices are in no conflict.
            pairs.cut_out(0..loops.corners.len());
        }
        round += 1;
    }
}

impl Fans {
    fn number(loops: &Loops, pairs: &Pairs, watch: &Watch) -> Result<Self, Cancelled> {
        let corners = loops.corners.len() as u32;
        let mut parents: Vec<u32> = (0..corners).collect();
        for h in 0..corners {
            watch.at(h)?;
            let mate = pairs.mate(h);
            if mate != NONE && h < mate {
                // The corners at both ends, whichever way the other runs.
                let (next, other) = (loops.next(h), loops.next(mate));
                let alike = loops.places[h as usize] == loops.places[mate as usize];
                let (at_start, at_end) = if alike { (mate, other) } else { (other, mate) };
                unite(&mut parents, h, at_start);
                unite(&mut parents, next, at_end);
            }
        }
        let roots: Vec<u32> = (0..corners).map(|c| root(&mut parents, c)).collect();
        // The root is the first corner, so fans are numbered by it.
        let mut fan_of = vec![NONE; corners as usize];
        let mut lowest = Vec::new();
        for (c, &root) in roots.iter().enumerate() {
            watch.at(c as u32)?;
            if root as usize == c {
                fan_of[c] = lowest.len() as u32;
                lowest.push(NONE);
            }
            let least = &mut lowest[fan_of[root as usize] as usize];
            *least = loops.vertices[c].min(*least);
        }
        let (numbers, sources) = in_order(&lowest);
        let vertices = roots.iter().map(|&root| numbers[fan_of[root as usize] as usize]).collect();
        Ok(Self { vertices, sources })
    }

    /// Takes apart pairs of this repair: those in conflicts, or else those at their vertices; in the end all. False if there are
    /// none.
    fn cut_fresh(&self, conflicts: &[Vec<u32>], all: bool, loops: &Loops, pairs: &mut Pairs) -> bool {
        let half_edges = 0..loops.corners.len() as u32;
        if all {
            return half_edges.filter(|&h| pairs.cut_fresh(h)).count() > 0;
        }
        let mut stuck = HashSet::new();
        let mut cuts = 0;
        for conflict in conflicts {
            let within = conflict.iter().filter(|&&h| pairs.cut_fresh(h)).count();
            cuts += within;
            if within == 0 {
                stuck.extend(conflict.iter().flat_map(|&h| [h, loops.next(h)]).map(|c| self.vertices[c as usize]));
            }
        }
        if !stuck.is_empty() {
            let at_stuck = |h: u32| [h, loops.next(h)].iter().any(|&c| stuck.contains(&self.vertices[c as usize]));
            cuts += half_edges.filter(|&h| at_stuck(h) && pairs.cut_fresh(h)).count();
        }
        cuts > 0
    }

    /// Sets of half-edges that must not all stay joined: those at a vertex that their face visits twice, and those of edges that
    /// are not a pair but have the same ends.
    fn conflicts(&self, loops: &Loops, pairs: &Pairs, watch: &Watch) -> Result<Vec<Vec<u32>>, Cancelled> {
        watch.look()?;
        let mut conflicts: Vec<Vec<u32>> = (0..loops.face_count() as u32)
            .into_par_iter()
            .map(|f| {
                let row = loops.row(f);
                let vertices = &self.vertices[row.clone()];
                if !crate::topology::repeats(vertices) {
                    return Vec::new();
                }
                let mut sorted = vertices.to_vec();
                sorted.sort_unstable();
                let is_repeated = |v: u32| sorted.get(sorted.partition_point(|&w| w < v) + 1) == Some(&v);
                let twice = row.filter(|&c| is_repeated(self.vertices[c])).map(|c| c as u32);
                twice.flat_map(|c| [c, loops.prev(c)]).collect()
            })
            .filter(|conflict: &Vec<u32>| !conflict.is_empty())
            .collect();
        watch.look()?;
        let ends = |h: u32| {
            let (a, b) = (self.vertices[h as usize], self.vertices[loops.next(h) as usize]);
            [a.min(b), a.max(b)]
        };
        let mut edges: Vec<([u32; 2], u32)> =
            (0..loops.corners.len() as u32).into_par_iter().map(|h| (ends(h), h)).collect();
        watch.look()?;
        edges.par_sort_unstable();
        watch.look()?;
        let crowd = |edge: &&[([u32; 2], u32)]| match edge {
            [_] => false,
            [(_, a), (_, b)] => pairs.mate(*a) != *b,
            _ => true,
        };
        let crowds = edges.chunk_by(|a, b| a.0 == b.0).filter(crowd);
        conflicts.extend(crowds.map(|edge| edge.iter().map(|&(_, h)| h).collect()));
        watch.look()?;
        Ok(conflicts)
    }
}

/// The number of each fan, given its lowest vertex, and the vertex that each number stands for. The first fan of a vertex takes its
/// place; the others follow behind all vertices, so that a repair leaves numbers alone where it can.
fn in_order(lowest: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut fans: Vec<(bool, u32, u32)> = (0..).zip(lowest).map(|(fan, &v)| (false, v, fan)).collect();
    fans.sort_unstable();
    let mut before = NONE;
    for (again, v, _) in &mut fans {
        *again = std::mem::replace(&mut before, *v) == *v;
    }
    fans.sort_unstable();
    let mut numbers = vec![0; lowest.len()];
    for (number, &(_, _, fan)) in (0..).zip(&fans) {
        numbers[fan as usize] = number;
    }
    (numbers, fans.iter().map(|&(_, v, _)| v).collect())
}

fn unite(parents: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parents, a), root(parents, b));
    parents[a.max(b) as usize] = a.min(b);
}

fn root(parents: &mut [u32], mut c: u32) -> u32 {
    while parents[c as usize] != c {
        // Every step halves the path for the next search.
        parents[c as usize] = parents[parents[c as usize] as usize];
        c = parents[c as usize];
    }
    c
}
