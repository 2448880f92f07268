//! Sorting the final quads into patch lists.

use std::ops::Range;

use rayon::prelude::*;

use crate::nets::FinalMesh;
use crate::patches::{LIST_VALENCES, PatchKind};
use crate::{Connectivity, NONE};

/// Final quads in the order of their patches: by kind, within a kind by number.
pub(crate) struct PatchOrder {
    /// The patches of each kind, kinds without patches left out.
    pub(crate) runs: Vec<(PatchKind, Range<u32>)>,
    /// Final quad of each patch; of an unrefined face the one at its first corner.
    pub(crate) quads: Vec<u32>,
    /// Patch of each final quad, [`NONE`] if it is not drawn. All children of an unrefined face have the same.
    pub(crate) patch_of_quad: Vec<u32>,
    /// How many patches are unrefined faces, which come first.
    pub(crate) unrefined: u32,
}

/// The bucket of quads that are not drawn, after those of all kinds.
const UNDRAWN: u8 = (*LIST_VALENCES.end() - *LIST_VALENCES.start()) as u8 + 4;

/// Kinds in the order of their lists. A plan has one kind in each: the scheme decides on the formula.
const fn bucket(kind: PatchKind) -> u8 {
    match kind {
        PatchKind::Unrefined => 0,
        PatchKind::Regular => 1,
        PatchKind::Extraordinary { valence, .. } => (valence - *LIST_VALENCES.start()) as u8 + 2,
        PatchKind::Stored { .. } => UNDRAWN - 1,
    }
}

impl PatchOrder {
    /// The order of all quads that are drawn; `unrefined` says which faces of the old mesh stay as they are, and is empty if none does.
    pub(crate) fn new<M: Connectivity>(
        mesh: &FinalMesh<'_, M>,
        is_drawn: impl Fn(u32) -> bool + Sync,
        unrefined: &[bool],
    ) -> Self {
        let quads = mesh.quad_count() as u32;
        let stays = |quad| !unrefined.is_empty() && unrefined[mesh.old.face(quad) as usize];
        let is_patch = |quad| !stays(quad) || mesh.old.face_half_edges(mesh.old.face(quad)).start == quad;
        let kind = |quad| if stays(quad) { PatchKind::Unrefined } else { mesh.tag(quad).kind() };
        let bucket_of = |quad| if is_drawn(quad) && is_patch(quad) { bucket(kind(quad)) } else { UNDRAWN };
        let mut order = Self::sort(&(0..quads).into_par_iter().map(bucket_of).collect::<Vec<u8>>(), kind);
        for patch in 0..order.unrefined {
            let face = mesh.old.face(order.quads[patch as usize]);
            mesh.old.face_half_edges(face).for_each(|quad| order.patch_of_quad[quad as usize] = patch);
        }
        order
    }

    /// A counting sort.
    fn sort(buckets: &[u8], kind: impl Fn(u32) -> PatchKind) -> Self {
        let mut counts = [0; UNDRAWN as usize + 1];
        buckets.iter().for_each(|&bucket| counts[bucket as usize] += 1);
        let (mut runs, mut next, mut end) = (Vec::new(), [0; UNDRAWN as usize], 0);
        for bucket in 0..UNDRAWN {
            let start = end;
            end += counts[bucket as usize];
            next[bucket as usize] = start;
            if start < end {
                runs.push(start..end);
            }
        }
        let mut quads = vec![0; end as usize];
        let place = |(quad, &bucket): (usize, &u8)| match next.get_mut(bucket as usize) {
            Some(next) => {
                let patch = std::mem::replace(next, *next + 1);
                quads[patch as usize] = quad as u32;
                patch
            }
            None => NONE,
        };
        let patch_of_quad = buckets.iter().enumerate().map(place).collect();
        let runs = runs.into_iter().map(|run| (kind(quads[run.start as usize]), run)).collect();
        Self { runs, quads, patch_of_quad, unrefined: next[bucket(PatchKind::Unrefined) as usize] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PatchForm;

    const FIVE: PatchKind = PatchKind::Extraordinary { form: PatchForm::Stam, valence: 5 };
    const STORED: PatchKind = PatchKind::Stored { form: PatchForm::Stam };

    #[test]
    fn buckets_are_in_the_order_of_kinds() {
        let listed = LIST_VALENCES.map(|valence| PatchKind::Extraordinary { form: PatchForm::Stam, valence });
        let kinds: Vec<PatchKind> =
            [PatchKind::Unrefined, PatchKind::Regular].into_iter().chain(listed).chain([STORED]).collect();
        assert!(kinds.is_sorted());
        assert_eq!(kinds.iter().map(|&kind| bucket(kind)).collect::<Vec<u8>>(), (0..UNDRAWN).collect::<Vec<u8>>());
    }

    #[test]
    fn quads_are_sorted_by_kind_and_stay_in_order_within_one() {
        let kinds = [Some(STORED), Some(FIVE), Some(PatchKind::Regular), None, Some(PatchKind::Regular), Some(FIVE)];
        let buckets = kinds.map(|kind| kind.map_or(UNDRAWN, bucket));
        let order = PatchOrder::sort(&buckets, |quad| kinds[quad as usize].unwrap());
        assert_eq!(order.runs, [(PatchKind::Regular, 0..2), (FIVE, 2..4), (STORED, 4..5)]);
        assert_eq!(order.quads, [2, 4, 1, 5, 0]);
        assert_eq!(order.patch_of_quad, [4, 2, 0, NONE, 1, 3]);
    }
}
