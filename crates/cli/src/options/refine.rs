//! Which faces are refined.

use clap::ValueEnum;
use osculate::Refinement;

/// Names of the ways to refine.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum RefineArg {
    /// All faces that the scheme refines.
    Everywhere,
    /// Only faces beside irregular vertices or boundaries; the others stay one patch, with twice the segments: fewer patches, the same
    /// surface. For uniform levels up to 32, equally spaced, without textures and displacements, of cages drawn as a whole. Without
    /// effect on gregory1.
    Needed,
}

impl From<RefineArg> for Refinement {
    fn from(arg: RefineArg) -> Self {
        match arg {
            RefineArg::Everywhere => Self::Everywhere,
            RefineArg::Needed => Self::WhereNeeded,
        }
    }
}
