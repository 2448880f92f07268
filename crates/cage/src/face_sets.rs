//! Objects, groups and materials: statements that stay in force until the next of their kind.

use std::collections::HashMap;
use std::ops::Range;

use crate::{FaceSet, FaceSetKind};

/// Collects face sets while faces go by. Costs are linear in the text: a set is a list of ranges, and only statements add to it.
#[derive(Default)]
pub(crate) struct FaceSets {
    sets: Vec<FaceSet>,
    by_name: HashMap<(FaceSetKind, String), usize>,
    active: HashMap<FaceSetKind, Active>,
}

struct Active {
    sets: Vec<usize>,
    since: u32,
}

impl FaceSets {
    /// The faces from `face` on belong to the sets with these names; without a name, to none of this kind.
    pub(crate) fn switch(&mut self, kind: FaceSetKind, names: impl Iterator<Item = String>, face: u32) {
        self.close(kind, face);
        let sets = names.map(|name| self.index(kind, name)).collect();
        self.active.insert(kind, Active { sets, since: face });
    }

    /// All sets with faces, by kind and first face, given the number of faces.
    pub(crate) fn finish(mut self, faces: u32) -> Vec<FaceSet> {
        for kind in FaceSetKind::ALL {
            self.close(kind, faces);
        }
        self.sets.retain(|set| !set.faces.is_empty());
        self.sets.sort_by_key(|set| (set.kind, set.faces[0].start));
        self.sets
    }

    fn index(&mut self, kind: FaceSetKind, name: String) -> usize {
        let Self { sets, by_name, .. } = self;
        *by_name.entry((kind, name)).or_insert_with_key(|(_, name)| {
            sets.push(FaceSet { kind, name: name.clone(), faces: Vec::new() });
            sets.len() - 1
        })
    }

    fn close(&mut self, kind: FaceSetKind, end: u32) {
        let Some(Active { sets, since }) = self.active.remove(&kind) else { return };
        if since == end {
            return;
        }
        for index in sets {
            extend(&mut self.sets[index].faces, since..end);
        }
    }
}

impl FaceSet {
    /// The same set of other faces: face `f` is what `sources[f]` was. Ranges need not be short for that, only rise.
    pub(crate) fn gather(&self, sources: &[u32]) -> Self {
        let mut faces = Vec::new();
        for (f, source) in (0..).zip(sources) {
            let next = self.faces.partition_point(|range| range.end <= *source);
            if self.faces.get(next).is_some_and(|range| range.start <= *source) {
                extend(&mut faces, f..f + 1);
            }
        }
        Self { faces, ..self.clone() }
    }
}

/// Adds a range after the others, or to the last one if they touch. A name given twice in one statement adds its range once.
fn extend(ranges: &mut Vec<Range<u32>>, range: Range<u32>) {
    match ranges.last_mut() {
        Some(last) if last.end >= range.start => last.end = range.end,
        _ => ranges.push(range),
    }
}
