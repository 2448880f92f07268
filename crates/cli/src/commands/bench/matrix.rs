//! What is measured: cages x schemes x levels x evaluators, in groups that are measured in turn.

use crate::options::{CullArg, DrawEvaluator, RefineArg};
use osculate::{BoundaryRule, Evaluator, Factors, Scheme, Spacing, SurfaceDesc, Tessellation};

/// One thing to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Configuration {
    /// Number of the cage on the command line.
    pub(super) cage: usize,
    pub(super) scheme: Scheme,
    /// Which faces are refined.
    pub(super) refine: RefineArg,
    /// Segments per patch edge.
    pub(super) level: f32,
    pub(super) evaluator: Evaluator,
    /// Whether the cage moves in every frame.
    pub(super) animated: bool,
    /// What is left out.
    pub(super) culling: CullArg,
    /// Width and height of the picture.
    pub(super) size: [u32; 2],
    pub(super) samples: u32,
}

impl Configuration {
    /// What its surface is like.
    pub(super) fn surface(&self, boundary: BoundaryRule) -> SurfaceDesc {
        SurfaceDesc { scheme: self.scheme, boundary: Some(boundary), refinement: self.refine.into() }
    }

    /// Whether another configuration of the same cage has the same surface.
    pub(super) fn is_of_surface(&self, other: &Self) -> bool {
        (self.scheme, self.refine) == (other.scheme, other.refine)
    }

    pub(super) fn tessellation(&self) -> Tessellation {
        let (factors, evaluator) = (Factors::Uniform(self.level), self.evaluator);
        Tessellation { factors, spacing: Spacing::Equal, evaluator }
    }
}

/// What results call an evaluator.
pub(super) fn evaluator_name(evaluator: Evaluator) -> &'static str {
    match evaluator {
        Evaluator::Compute => "compute",
        // For pictures, auto is the tessellator.
        _ => "tessellator",
    }
}

/// Configurations of one cage at one level: few enough to be on the device at the same time.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) cage: usize,
    pub(super) configurations: Vec<Configuration>,
}

/// Every scheme with every way to refine.
pub(super) fn surfaces(schemes: &[Scheme], refine: &[RefineArg]) -> Vec<(Scheme, RefineArg)> {
    schemes.iter().flat_map(|&scheme| refine.iter().map(move |&refine| (scheme, refine))).collect()
}

/// All groups, cage by cage, level by level; `template` tells what all configurations have in common.
pub(super) fn groups(
    template: &Configuration,
    cages: usize,
    surfaces: &[(Scheme, RefineArg)],
    levels: &[f32],
    evaluators: &[DrawEvaluator],
) -> Vec<Group> {
    let group = |cage, level| {
        let of_surface = |&(scheme, refine)| {
            evaluators.iter().map(move |&evaluator| {
                let evaluator = evaluator.into();
                Configuration { cage, scheme, refine, level, evaluator, ..*template }
            })
        };
        Group { cage, configurations: surfaces.iter().flat_map(of_surface).collect() }
    };
    (0..cages).flat_map(|cage| levels.iter().map(move |&level| (cage, level))).map(|(c, l)| group(c, l)).collect()
}
