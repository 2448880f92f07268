//! Where vertices are.

use std::collections::HashMap;

use crate::progress::{Cancelled, Watch};
use crate::weld::{NearWelder, Welder};
use crate::{CageDesc, NONE, Rig};

/// For each vertex the first vertex at its place, within a tolerance; [`NONE`] for vertices without faces, which are at no place.
/// Vertices that move differently are at different places: welded, they would be torn.
pub(super) fn places(desc: &CageDesc, tolerance: f64, watch: &Watch) -> Result<Vec<u32>, Cancelled> {
    let mut used = vec![false; desc.positions.len()];
    desc.face_vertices.iter().for_each(|&v| used[v as usize] = true);

    let ways = desc.rig.as_ref().map(ways);
    let mut exact = Welder::default();
    let mut near = NearWelder::new(tolerance, &desc.positions);
    let mut firsts = Vec::new();
    let place = |(v, p): (u32, &glam::DVec3)| {
        watch.at(v)?;
        if !used[v as usize] {
            return Ok(NONE);
        }
        let way = ways.as_ref().map_or(0, |ways| ways[v as usize]);
        let (number, new) = match &mut near {
            Some(near) => near.weld(*p, way),
            None => exact.weld(p.to_array(), way),
        };
        if new {
            firsts.push(v);
        }
        Ok(firsts[number as usize])
    };
    (0..).zip(&desc.positions).map(place).collect()
}

/// For each vertex the number of the way in which it moves: joints, weights and offsets, to the last bit.
fn ways(rig: &Rig) -> Vec<u32> {
    let mut moves: Vec<Vec<u32>> = (0..rig.bind_positions.len())
        .map(|v| rig.influences_of(v).flat_map(|(joint, weight)| [joint, weight.to_bits()]).collect())
        .collect();
    for (t, target) in (0..).zip(rig.morph_sets.iter().flat_map(|set| &set.targets)) {
        for (&v, offset) in target.vertices.iter().zip(&target.offsets) {
            moves[v as usize].push(t);
            moves[v as usize].extend(offset.to_array().map(f32::to_bits));
        }
    }
    let mut known = HashMap::new();
    moves
        .into_iter()
        .map(|way| {
            let next = known.len() as u32;
            *known.entry(way).or_insert(next)
        })
        .collect()
}
