//! What the skinning kernel reads of a rig, the same for all poses.

use glam::DVec3;
use osculate_cage::{Bounds, Rig};
use osculate_shaders::layout::{MorphOffset, SkinInfluence, SkinVertex};

use super::groups::Groups;
use crate::CageSpace;

/// Vertices with what moves them, in the order that the kernel adds it up.
pub(super) struct SkinTables {
    pub(super) vertices: Vec<SkinVertex>,
    pub(super) influences: Vec<SkinInfluence>,
    pub(super) offsets: Vec<MorphOffset>,
    /// For each joint the frame that the bind positions of its vertices are given in: relative to the middle of all vertices that
    /// are tied to it, so that a small mesh that was modelled far from the origin loses nothing.
    pub(super) frames: Vec<CageSpace>,
}

impl SkinTables {
    /// The tables of a rig that fits its cage.
    pub(super) fn new(rig: &Rig) -> Self {
        let morphs = Morphs::new(rig);
        let groups = Groups::of(rig);
        let spaces = group_spaces(rig, &groups, &morphs);
        let mut tables = Self {
            vertices: Vec::with_capacity(rig.bind_positions.len()),
            influences: Vec::new(),
            offsets: Vec::new(),
            frames: (0..rig.joints.len()).map(|joint| spaces[groups.of_joint(joint)]).collect(),
        };
        for (v, &bind) in rig.bind_positions.iter().enumerate() {
            let space = spaces[groups.of_vertex(rig, v)];
            let (first_influence, first_offset) = (tables.influences.len() as u32, tables.offsets.len() as u32);
            tables.influences.extend(influences(rig, v));
            tables.offsets.extend(morphs.of_vertex(v).map(|&(_, target, offset)| MorphOffset {
                offset: (offset * space.scale).as_vec3().to_array(),
                morph_target: target,
            }));
            tables.vertices.push(SkinVertex {
                bind: space.enter(bind).to_array(),
                first_influence,
                influence_end: tables.influences.len() as u32,
                first_offset,
                offset_end: tables.offsets.len() as u32,
                padding: 0,
            });
        }
        tables
    }
}

/// The joints that move a vertex, with weights of sum 1 as exactly as 32 bits can have it.
fn influences(rig: &Rig, v: usize) -> impl Iterator<Item = SkinInfluence> + '_ {
    let sum: f64 = rig.influences_of(v).map(|(_, weight)| f64::from(weight)).sum();
    let share = move |weight: f32| (f64::from(weight) / sum) as f32;
    rig.influences_of(v)
        .filter(|(_, weight)| *weight > 0.0)
        .map(move |(joint, weight)| SkinInfluence { joint, weight: share(weight) })
}

/// The offsets of all targets, by vertex.
struct Morphs {
    /// Vertex, target and offset, rising in both numbers.
    offsets: Vec<(u32, u32, DVec3)>,
}

impl Morphs {
    fn new(rig: &Rig) -> Self {
        let mut offsets = Vec::new();
        for (number, target) in (0..).zip(rig.morph_sets.iter().flat_map(|set| &set.targets)) {
            let moved = target.vertices.iter().zip(&target.offsets);
            offsets.extend(moved.map(|(&v, offset)| (v, number, offset.as_dvec3())));
        }
        // Stable: the offsets of a vertex stay in the order of the targets.
        offsets.sort_by_key(|&(v, ..)| v);
        Self { offsets }
    }

    fn of_vertex(&self, v: usize) -> impl Iterator<Item = &(u32, u32, DVec3)> {
        let first = self.offsets.partition_point(|offset| (offset.0 as usize) < v);
        self.offsets[first..].iter().take_while(move |offset| offset.0 as usize == v)
    }
}

/// For each group of vertices the space around them, wherever one target alone may put them.
fn group_spaces(rig: &Rig, groups: &Groups, morphs: &Morphs) -> Vec<CageSpace> {
    let mut boxes: Vec<Option<Bounds>> = vec![None; groups.count()];
    for (v, &bind) in rig.bind_positions.iter().enumerate() {
        let found = &mut boxes[groups.of_vertex(rig, v)];
        for point in std::iter::once(bind).chain(morphs.of_vertex(v).map(|&(.., offset)| bind + offset)) {
            let so_far = found.unwrap_or(Bounds { min: point, max: point });
            *found = Some(Bounds { min: so_far.min.min(point), max: so_far.max.max(point) });
        }
    }
    boxes.into_iter().map(|found| CageSpace::new(found.unwrap_or(Bounds::of(&[])))).collect()
}
