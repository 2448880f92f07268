//! What is measured: cages x schemes x levels x evaluators, in groups that are measured in turn.

use crate::options::{CullArg, DrawEvaluator};
use osculate::{Evaluator, Factors, Scheme, Spacing, Tessellation};

/// One thing to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Configuration {
    /// Number of the cage on the command line.
    pub(super) cage: usize,
    pub(super) scheme: Scheme,
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

/// All groups, cage by cage, level by level; `template` tells what all configurations have in common.
pub(super) fn groups(
    template: &Configuration,
    cages: usize,
    schemes: &[Scheme],
    levels: &[f32],
    evaluators: &[DrawEvaluator],
) -> Vec<Group> {
    let group = |cage, level| {
        let of_scheme = |scheme| {
            evaluators.iter().map(move |&evaluator| {
                let evaluator = evaluator.into();
                Configuration { cage, scheme, level, evaluator, ..*template }
            })
        };
        Group { cage, configurations: schemes.iter().flat_map(|&scheme| of_scheme(scheme)).collect() }
    };
    (0..cages).flat_map(|cage| levels.iter().map(move |&level| (cage, level))).map(|(c, l)| group(c, l)).collect()
}
