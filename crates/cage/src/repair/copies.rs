//! Faces with the same corners.

use std::cmp::Ordering;

use super::loops::Loops;
use super::report::RepairReport;
use crate::progress::{Cancelled, Watch};

/// Drops faces with the corners of an earlier one. A face that runs the other way is dropped only where it stands in the way: two
/// faces back to back that nothing else touches are a closed mesh, and so are those between two volumes.
pub(super) fn drop_copies(loops: &mut Loops, watch: &Watch, report: &mut RepairReport) -> Result<(), Cancelled> {
    let mut dropped = vec![false; loops.face_count()];
    let mut opposite = Vec::new();
    for group in groups(loops, watch)? {
        let (first, forward) = group[0];
        let mut back: Option<u32> = None;
        for &(f, way) in &group[1..] {
            match back {
                None if way != forward => back = Some(f),
                _ => dropped[f as usize] = true,
            }
        }
        opposite.extend(back.map(|back| [first, back]));
    }
    if !opposite.is_empty() {
        let in_the_way = standing_in_the_way(loops, &dropped, &opposite);
        in_the_way.into_iter().for_each(|f| dropped[f as usize] = true);
    }
    for f in (0..loops.face_count()).filter(|&f| dropped[f]) {
        report.copied_faces.push(loops.sources[f]);
    }
    if dropped.contains(&true) {
        loops.retain(|f| !dropped[f as usize]);
    }
    watch.look()
}

/// Faces with the same corners, in rising order, each with the direction in which it runs; only groups of several.
fn groups(loops: &Loops, watch: &Watch) -> Result<Vec<Vec<(u32, bool)>>, Cancelled> {
    // Sums do not depend on the order of corners; they find candidates quickly.
    let signature = |f: u32| {
        let spread = |p: u32| (u64::from(p) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        let mixed = |&p: &u32| spread(p).wrapping_mul(spread(p) | 1);
        loops.places[loops.row(f)].iter().map(mixed).fold(0, u64::wrapping_add)
    };
    let entry = |f: u32| watch.at(f).map(|()| (signature(f), f));
    let mut keyed: Vec<(u64, u32)> = (0..loops.face_count() as u32).map(entry).collect::<Result<_, _>>()?;
    keyed.sort_unstable();
    let mut groups = Vec::new();
    for candidates in keyed.chunk_by(|a, b| a.0 == b.0).filter(|candidates| candidates.len() > 1) {
        let mut canonical: Vec<(Vec<u32>, u32, bool)> = candidates
            .iter()
            .map(|&(_, f)| {
                let (row, forward) = canonical(&loops.places[loops.row(f)]);
                (row, f, forward)
            })
            .collect();
        canonical.sort_unstable();
        let same = canonical.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1);
        groups.extend(same.map(|same| same.iter().map(|&(_, f, forward)| (f, forward)).collect()));
    }
    Ok(groups)
}

/// The cycle of places in a form that does not depend on where it starts and which way it runs, and whether it runs that way.
fn canonical(row: &[u32]) -> (Vec<u32>, bool) {
    let forward = least_rotation(row.to_vec());
    let backward = least_rotation(row.iter().rev().copied().collect());
    if forward <= backward { (forward, true) } else { (backward, false) }
}

/// The rotation that comes first in the order of sequences, in linear time (Shiloach, "Fast canonization of circular strings",
/// Journal of Algorithms 2, 1981).
fn least_rotation(mut row: Vec<u32>) -> Vec<u32> {
    let n = row.len();
    let (mut i, mut j, mut k) = (0, 1, 0);
    while i < n && j < n && k < n {
        match row[(i + k) % n].cmp(&row[(j + k) % n]) {
            Ordering::Equal => k += 1,
            order => {
                if order == Ordering::Greater {
                    i += k + 1
                } else {
                    j += k + 1
                }
                if i == j {
                    j += 1;
                }
                k = 0;
            }
        }
    }
    row.rotate_left(i.min(j) % n);
    row
}

/// Those of pairs of opposite faces whose second face has to go: some edge of theirs has further faces, and these are not one on
/// each side.
fn standing_in_the_way(loops: &Loops, dropped: &[bool], opposite: &[[u32; 2]]) -> Vec<u32> {
    let mut is_copy = vec![false; loops.face_count()];
    opposite.iter().flatten().for_each(|&f| is_copy[f as usize] = true);
    let mut edges: Vec<([u32; 2], bool, u32)> = (0..loops.corners.len() as u32)
        .filter(|&h| !dropped[loops.faces[h as usize] as usize])
        .map(|h| {
            let (ends, up) = loops.ends(h);
            (ends, up, loops.faces[h as usize])
        })
        .collect();
    edges.sort_unstable();
    let crowd = |h: u32| {
        let (ends, _) = loops.ends(h);
        let start = edges.partition_point(|edge| edge.0 < ends);
        let len = edges[start..].partition_point(|edge| edge.0 == ends);
        &edges[start..start + len]
    };
    let is_wall = |h: u32| {
        let others = |way: bool| crowd(h).iter().any(|&(_, up, f)| up == way && !is_copy[f as usize]);
        others(true) && others(false)
    };
    let stands = |&&[first, _]: &&[u32; 2]| {
        let mut row = loops.row(first).map(|h| h as u32);
        row.clone().any(|h| crowd(h).len() > 2) && !row.all(is_wall)
    };
    opposite.iter().filter(stands).map(|pair| pair[1]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_are_equal_wherever_they_start() {
        let (a, forward) = canonical(&[3, 1, 2, 5]);
        assert_eq!((a, forward), canonical(&[2, 5, 3, 1]));
        let (b, backward) = canonical(&[5, 2, 1, 3]);
        assert_eq!((canonical(&[3, 1, 2, 5]).0, !forward), (b, backward));
        assert_ne!(canonical(&[3, 2, 1, 5]).0, canonical(&[3, 1, 2, 5]).0);
    }

    #[test]
    fn least_rotations() {
        assert_eq!(least_rotation(vec![2, 1, 2, 1, 1]), [1, 1, 2, 1, 2]);
        assert_eq!(least_rotation(vec![1, 1, 1]), [1, 1, 1]);
        let periodic: Vec<u32> = (0..99_999).map(|i| i % 3).collect();
        assert_eq!(least_rotation(periodic.clone()), periodic);
    }
}
