//! Which half-edges belong together.

use std::cmp::Ordering;

use glam::DVec3;
use rayon::prelude::*;

use super::loops::Loops;
use super::report::RepairReport;
use super::winding::Winding;
use crate::progress::{Cancelled, Watch};
use crate::{CageDesc, NONE};

/// Half-edges in pairs, each in one pair at most.
#[derive(Default)]
pub(super) struct Pairs {
    mates: Vec<u32>,
    /// Whether a half-edge has its mate from this repair: their vertices are not the same yet.
    fresh: Vec<bool>,
}

impl Pairs {
    /// The other half-edge of a pair, [`NONE`] without one.
    pub(super) fn mate(&self, h: u32) -> u32 {
        self.mates[h as usize]
    }

    /// Takes a pair apart; false if there is none.
    pub(super) fn cut(&mut self, h: u32) -> bool {
        let mate = std::mem::replace(&mut self.mates[h as usize], NONE);
        if mate == NONE {
            return false;
        }
        self.mates[mate as usize] = NONE;
        true
    }

    /// Takes a pair apart if it was made by this repair; false if there is none.
    pub(super) fn cut_fresh(&mut self, h: u32) -> bool {
        self.fresh[h as usize] && self.cut(h)
    }

    /// Takes apart all pairs of some half-edges.
    pub(super) fn cut_out(&mut self, half_edges: std::ops::Range<usize>) {
        for h in half_edges {
            self.cut(h as u32);
        }
    }

    fn pair(&mut self, a: u32, b: u32) {
        self.mates[a as usize] = b;
        self.mates[b as usize] = a;
    }

    /// Finds the pairs, from certain ones to likely ones: two half-edges alone between two vertices; two that are left over
    /// between two places; neighbours around a crowded place, with the inside of the mesh between them. Returns which faces have
    /// to be turned over.
    pub(super) fn join(
        &mut self,
        desc: &CageDesc,
        loops: &Loops,
        watch: &Watch,
        report: &mut RepairReport,
    ) -> Result<Vec<bool>, Cancelled> {
        self.mates = vec![NONE; loops.corners.len()];
        self.fresh = vec![false; loops.corners.len()];
        let mut winding = Winding::new(loops.face_count());
        self.join_vertices(desc, loops, &mut winding, watch, report)?;
        let groups = self.lonely(loops);
        groups.iter().flatten().for_each(|&h| self.fresh[h as usize] = true);
        watch.look()?;
        for group in &groups {
            if let [a, b] = group[..] {
                self.try_pair(a, b, loops, &mut winding);
            }
        }
        let turned = winding.minority();
        watch.look()?;
        let crowds: Vec<&Vec<u32>> = groups.iter().filter(|group| group.len() > 2).collect();
        if !crowds.is_empty() {
            // Once for all edges: a face may have many.
            let normals: Vec<DVec3> =
                (0..loops.face_count() as u32).into_par_iter().map(|f| normal(f, desc, loops)).collect();
            let axes = |group: &[u32]| angles(group, &normals, desc, loops);
            for (k, group) in (0..).zip(crowds) {
                watch.pulse(k)?;
                self.join_wedges(group, &axes(group), loops, &turned);
            }
        }
        Ok(turned)
    }

    /// Pairs half-edges that are alone between two vertices.
    fn join_vertices(
        &mut self,
        desc: &CageDesc,
        loops: &Loops,
        winding: &mut Winding,
        watch: &Watch,
        report: &mut RepairReport,
    ) -> Result<(), Cancelled> {
        let half_edges = (0..loops.corners.len() as u32).into_par_iter();
        let mut keyed: Vec<([u32; 2], u32)> = half_edges.map(|h| (loops.vertex_ends(h), h)).collect();
        watch.look()?;
        keyed.par_sort_unstable();
        watch.look()?;
        let mut candidates = Vec::new();
        for (k, group) in (0..).zip(keyed.chunk_by(|a, b| a.0 == b.0)) {
            watch.pulse(k)?;
            let ends = group[0].0.map(|v| desc.source_vertex(v));
            match group {
                [_] => {}
                [(_, a), (_, b)] => candidates.push((*a, *b, ends)),
                _ => report.crowded_edges.push(ends),
            }
        }
        // In the order of the faces: where a part is one-sided, it is opened as late as possible.
        candidates.sort_unstable();
        watch.look()?;
        for (k, (a, b, ends)) in (0..).zip(candidates) {
            watch.at(k)?;
            if loops.faces[a as usize] != loops.faces[b as usize] && !self.try_pair(a, b, loops, winding) {
                report.opened_edges.push(ends);
            }
        }
        Ok(())
    }

    /// Pairs two half-edges unless they are of one face or the winding forbids it.
    fn try_pair(&mut self, a: u32, b: u32, loops: &Loops, winding: &mut Winding) -> bool {
        let [f, g] = [a, b].map(|h| loops.faces[h as usize]);
        let alike = loops.ends(a).1 == loops.ends(b).1;
        let joined = f != g && winding.relate(f, g, alike);
        if joined {
            self.pair(a, b);
        }
        joined
    }

    /// The half-edges without a mate, by the places they join; only groups of several.
    fn lonely(&self, loops: &Loops) -> Vec<Vec<u32>> {
        let lonely = (0..loops.corners.len() as u32).filter(|&h| self.mate(h) == NONE);
        let mut keyed: Vec<([u32; 2], u32)> = lonely.map(|h| (loops.ends(h).0, h)).collect();
        keyed.par_sort_unstable();
        let groups = keyed.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        groups.map(|group| group.iter().map(|&(_, h)| h).collect()).collect()
    }

    /// Pairs neighbours around an edge with many faces. Seen along the edge, from its lower to its higher place, the normal of a
    /// face whose half-edge runs that way points to rising angles, so the inside is at falling angles; of the others at rising
    /// ones. Pairs with the inside between them thus are nested as brackets are, around a circle.
    fn join_wedges(&mut self, group: &[u32], angles: &[f64], loops: &Loops, turned: &[bool]) {
        let opens = |h: u32| !(loops.ends(h).1 ^ turned[loops.faces[h as usize] as usize]);
        // At equal angles a bracket that closes comes first: two faces back to back belong to different neighbours.
        let mut around: Vec<(f64, bool, u32)> =
            angles.iter().zip(group).map(|(&angle, &h)| (angle, opens(h), h)).collect();
        around.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut open: Vec<u32> = Vec::new();
        for round in 0..2 {
            for &(_, opens, h) in &around {
                if self.mate(h) != NONE {
                    continue;
                }
                if opens {
                    if round == 0 {
                        open.push(h);
                    }
                    continue;
                }
                if let Some(mate) = open.pop_if(|mate| loops.faces[*mate as usize] != loops.faces[h as usize]) {
                    self.pair(mate, h);
                }
            }
        }
    }
}

/// The angles of faces around the edge that their half-edges have in common, anticlockwise seen against its direction, from its
/// lower to its higher place.
fn angles(group: &[u32], normals: &[DVec3], desc: &CageDesc, loops: &Loops) -> Vec<f64> {
    let at = |place: u32| desc.positions[place as usize];
    let [low, high] = loops.ends(group[0]).0.map(at);
    let axis = direction(high - low);
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    let angle = |&h: &u32| {
        // Turning the face over turns both its normal and its half-edge.
        let along = if loops.ends(h).1 { axis } else { -axis };
        let inward = normals[loops.faces[h as usize] as usize].cross(along);
        let angle = inward.dot(y).atan2(inward.dot(x));
        if angle.partial_cmp(&0.0) == Some(Ordering::Equal) { 0.0 } else { angle }
    };
    group.iter().map(angle).collect()
}

/// The unit normal of a face by the method of Newell.
fn normal(f: u32, desc: &CageDesc, loops: &Loops) -> DVec3 {
    let row = &loops.places[loops.row(f)];
    let first = desc.positions[row[0] as usize];
    let corner = |place: u32| desc.positions[place as usize] - first;
    direction(row.windows(2).map(|pair| corner(pair[0]).cross(corner(pair[1]))).sum())
}

/// A vector at unit length; x if it has none.
fn direction(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize_or(DVec3::X)
}
