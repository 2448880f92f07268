//! Dividing faces among parts, so that each part has a short border, whatever the order of the faces in the file.

use std::cmp::Ordering;

use glam::DVec3;

use crate::{Bounds, Cage};

/// Below this number of faces, halves are divided one after the other.
const GRAIN: usize = 1 << 16;

/// Divides faces of a cage into `count` sets of nearly equal size (fewer if there are not as many faces), each rising: the faces are cut in two across the
/// longest side of the box of their first vertices, and so on. The result depends on nothing but its arguments.
///
/// # Panics
/// If a face does not exist.
#[must_use]
pub fn divide(cage: &Cage, mut faces: Vec<u32>, count: usize) -> Vec<Vec<u32>> {
    let count = count.clamp(1, faces.len().max(1));
    halve(cage, &mut faces, count)
}

fn halve(cage: &Cage, faces: &mut [u32], count: usize) -> Vec<Vec<u32>> {
    if count == 1 {
        faces.sort_unstable();
        return vec![faces.to_vec()];
    }
    let (few, middle) = (count / 2, (faces.len() as u64 * (count / 2) as u64 / count as u64) as usize);
    let axis = longest_axis(cage, faces);
    let at = |&f: &u32| place(cage, f)[axis];
    // Equal coordinates stay in the order of the faces, so that the cut is unique.
    let order = |a: &u32, b: &u32| -> Ordering { at(a).total_cmp(&at(b)).then(a.cmp(b)) };
    faces.select_nth_unstable_by(middle, order);
    let (left, right) = faces.split_at_mut(middle);
    let mut halves = if left.len() < GRAIN {
        [halve(cage, left, few), halve(cage, right, count - few)]
    } else {
        let (left, right) = rayon::join(|| halve(cage, left, few), || halve(cage, right, count - few));
        [left, right]
    };
    let [left, right] = &mut halves;
    left.append(right);
    std::mem::take(left)
}

fn place(cage: &Cage, f: u32) -> DVec3 {
    cage.positions()[cage.face(f as usize)[0] as usize]
}

fn longest_axis(cage: &Cage, faces: &[u32]) -> usize {
    let start = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
    let bounds = faces
        .iter()
        .map(|&f| place(cage, f))
        .fold(start, |bounds, p| Bounds { min: bounds.min.min(p), max: bounds.max.max(p) });
    let size = bounds.max - bounds.min;
    (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest })
}
