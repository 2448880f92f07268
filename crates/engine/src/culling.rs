//! Patches of which nothing can be seen, left out before they are tessellated.

use osculate_shaders::constant;
use osculate_subdiv::{PatchForm, PatchKind, PatchList};

/// Which patches the tessellator leaves out: of which nothing is seen in a picture. The tests err on the side of drawing, and what they leave out covers
/// no sample, so that a picture has the same bits with them as without; but for [`Self::back`], which is to be chosen for closed surfaces seen from outside. There a
/// few pixels of the outline may differ, in which a back is seen without it, since fronts and backs have the same depth there but for roundings.
///
/// Patches are told by the hull of their control points in the control stage (`shaders/include/culling.glsl`); stored patches of coefficients are always
/// tessellated, and the compute evaluator evaluates everything. Triangles that show their backs are left out whoever made them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Culling {
    /// Patches beyond a plane of the view.
    pub frustum: bool,
    /// Patches that fall between the places where samples can lie.
    pub small: bool,
    /// Triangles that show their back, and before they are made those of regular patches that show it from everywhere on them, by a cone of their normals. Fragment
    /// shaders of [`Material`](crate::Material)s are asked for triangles as their pipelines say.
    pub back: bool,
}

impl Culling {
    /// Every patch is drawn.
    pub const NONE: Self = Self { frustum: false, small: false, back: false };
    /// Patches that cover no sample are left out; the picture stays the same.
    pub const UNSEEN: Self = Self { frustum: true, small: true, back: false };
    /// Backs are left out too.
    pub const ALL: Self = Self { frustum: true, small: true, back: true };

    /// The bits that shaders know.
    pub(crate) fn bits(self) -> u32 {
        [(self.frustum, constant::CULL_FRUSTUM), (self.small, constant::CULL_SMALL), (self.back, constant::CULL_BACK)]
            .into_iter()
            .filter(|(chosen, _)| *chosen)
            .map(|(_, bit)| bit)
            .sum()
    }
}

/// Places per pixel along an axis where a sample can lie: those of several lie on a grid of sixteenths.
pub(crate) fn sample_places(samples: u32) -> f32 {
    if samples > 1 { 16.0 } else { 1.0 }
}

/// How far the control points of a list's patches can lie beyond their nets' points along a direction, as a share of the extent of those: the sum of the
/// negative weights of the worst control point. Regular nets hold their control points, and nets of the limit surface hold the surface.
pub(crate) fn overshoot(list: &PatchList, weights: &[f32]) -> f32 {
    let PatchKind::Extraordinary { form, .. } = list.kind else { return 0.0 };
    let points = match form {
        PatchForm::Gregory => constant::GREGORY_POINTS as usize,
        PatchForm::Biseptic => 64,
        _ => return 0.0,
    };
    let net = list.kind.net_size().unwrap_or(1) as usize;
    let rows = weights[list.weights as usize..].chunks_exact(net).take(points);
    rows.map(negative_weight).fold(0.0, f32::max)
}

/// The sum of what is below zero in a row. Weights of a point sum to one; that of the first net point is implied where a form takes differences from it.
fn negative_weight(row: &[f32]) -> f32 {
    let others = &row[1..];
    let first = 1.0 - others.iter().sum::<f32>();
    others.iter().chain([&first]).map(|weight| (-weight).max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_the_choices() {
        assert_eq!(Culling::NONE.bits(), 0);
        assert_eq!(Culling::UNSEEN.bits(), constant::CULL_FRUSTUM | constant::CULL_SMALL);
        assert_eq!(Culling { back: true, ..Culling::NONE }.bits(), constant::CULL_BACK);
    }

    #[test]
    fn negative_weights_are_summed_with_that_of_the_first_point() {
        assert_eq!(negative_weight(&[0.25, 0.5, 0.25]), 0.0);
        assert_eq!(negative_weight(&[9.0, 1.5, -0.25]), 0.5, "the first weight is what the others leave");
    }

    #[test]
    fn lists_without_overshoot_take_no_weights() {
        let list = |kind| PatchList { kind, first_patch: 0, count: 1, drawn: 1, first_index: 0, weights: 0 };
        let stam = PatchKind::Extraordinary { form: PatchForm::Stam, valence: 5 };
        for kind in [PatchKind::Regular, stam, PatchKind::Stored { form: PatchForm::Gregory }] {
            assert_eq!(overshoot(&list(kind), &[]), 0.0);
        }
        let gregory = PatchKind::Extraordinary { form: PatchForm::Gregory, valence: 3 };
        let mut weights = vec![1.0 / 14.0; 20 * 14];
        weights[14 * 7 + 3] = -0.5;
        let found = overshoot(&list(gregory), &weights);
        assert!((found - 0.5).abs() < 1e-6, "{found}");
    }
}
