//! Where vertices are.

use crate::weld::{NearWelder, Welder};
use crate::{CageDesc, NONE};

/// For each vertex the first vertex at its place, within a tolerance; [`NONE`] for vertices without faces, which are at no place.
pub(super) fn places(desc: &CageDesc, tolerance: f64) -> Vec<u32> {
    let mut used = vec![false; desc.positions.len()];
    desc.face_vertices.iter().for_each(|&v| used[v as usize] = true);

    let mut exact = Welder::default();
    let mut near = NearWelder::new(tolerance, &desc.positions);
    let mut firsts = Vec::new();
    let place = |(v, p): (u32, &glam::DVec3)| {
        if !used[v as usize] {
            return NONE;
        }
        let (number, new) = match &mut near {
            Some(near) => near.weld(*p, 0),
            None => exact.weld(p.to_array(), 0),
        };
        if new {
            firsts.push(v);
        }
        firsts[number as usize]
    };
    (0..).zip(&desc.positions).map(place).collect()
}
