//! Which kernels evaluate patches of a form.

use osculate_subdiv::PatchForm;

use super::Measured;

/// The kernel that evaluates patches of a form, a workgroup each: their insides, and their borders where those are measured by the patch's own formula.
fn kernel(form: PatchForm, mapped: bool) -> &'static str {
    match (form, mapped) {
        (PatchForm::Bicubic, false) => "evaluate/bicubic.comp",
        (PatchForm::Gregory, false) => "evaluate/gregory.comp",
        (PatchForm::Stam, false) => "evaluate/stam.comp",
        (PatchForm::Biseptic, false) => "evaluate/biseptic.comp",
        (PatchForm::Triangle, false) => "evaluate/triangle.comp",
        (PatchForm::Bicubic, true) => "evaluate/bicubic.comp#mapped",
        (PatchForm::Gregory, true) => "evaluate/gregory.comp#mapped",
        (PatchForm::Stam, true) => "evaluate/stam.comp#mapped",
        (PatchForm::Biseptic, true) => "evaluate/biseptic.comp#mapped",
        (PatchForm::Triangle, true) => "evaluate/triangle.comp#mapped",
    }
}

/// The kernel that evaluates insides of patches of a form, a thread each, if there is one.
fn lane_kernel(form: PatchForm, mapped: bool) -> Option<&'static str> {
    match (form, mapped) {
        (PatchForm::Bicubic, false) => Some("evaluate/bicubic_lanes.comp"),
        (PatchForm::Gregory, false) => Some("evaluate/gregory_lanes.comp"),
        (PatchForm::Bicubic, true) => Some("evaluate/bicubic_lanes.comp#mapped"),
        (PatchForm::Gregory, true) => Some("evaluate/gregory_lanes.comp#mapped"),
        (PatchForm::Stam | PatchForm::Biseptic | PatchForm::Triangle, _) => None,
    }
}

/// The kernel that evaluates borders of patches of a form from records alone, a thread for each corner and side.
fn border_kernel(form: PatchForm, mapped: bool) -> &'static str {
    match (form, mapped) {
        (PatchForm::Bicubic | PatchForm::Gregory, false) => "evaluate/border_quad.comp",
        (PatchForm::Stam, false) => "evaluate/border_stam.comp",
        (PatchForm::Biseptic, false) => "evaluate/border_biseptic.comp",
        (PatchForm::Triangle, false) => "evaluate/border_triangle.comp",
        (PatchForm::Bicubic | PatchForm::Gregory, true) => "evaluate/border_quad.comp#mapped",
        (PatchForm::Stam, true) => "evaluate/border_stam.comp#mapped",
        (PatchForm::Biseptic, true) => "evaluate/border_biseptic.comp#mapped",
        (PatchForm::Triangle, true) => "evaluate/border_triangle.comp#mapped",
    }
}

/// What evaluates a patch.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Share {
    Workgroup,
    Thread,
    /// A thread for each corner and the side that leaves it.
    FourThreads,
}

/// One of the kernels that evaluate patches of a form.
#[derive(Clone, Copy)]
pub(super) struct GridKernel {
    pub(super) shader: &'static str,
    pub(super) share: Share,
    /// Whether it makes inner vertices alone.
    pub(super) inside: bool,
}

/// The kernels that evaluate patches of a form. Where places are all that is measured, borders need no control points, and have a kernel of their own.
///
/// `lanes`: threads are lanes of a vector, so that a thread for each patch is better than a workgroup.
pub(super) fn grid_kernels(
    form: PatchForm,
    mapped: bool,
    measure: Measured,
    lanes: bool,
) -> impl Iterator<Item = GridKernel> {
    let apart = !measure.takes_patch();
    let border = GridKernel { shader: border_kernel(form, mapped), share: Share::FourThreads, inside: false };
    let whole = GridKernel { shader: kernel(form, mapped), share: Share::Workgroup, inside: apart };
    let lane = lane_kernel(form, mapped).filter(|_| lanes && apart);
    let inside = lane.map_or(whole, |shader| GridKernel { shader, share: Share::Thread, inside: true });
    apart.then_some(border).into_iter().chain([inside])
}
