//! What is left out of pictures.

use clap::ValueEnum;
use osculate::Culling;

/// Names of what is left out.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum CullArg {
    /// Nothing.
    None,
    /// Patches beyond the picture, and those that fall between its samples.
    Unseen,
    /// What shows its back too: for closed surfaces, seen from outside.
    Backs,
}

impl CullArg {
    /// The name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Unseen => "unseen",
            Self::Backs => "backs",
        }
    }
}

impl From<CullArg> for Culling {
    fn from(arg: CullArg) -> Self {
        match arg {
            CullArg::None => Self::NONE,
            CullArg::Unseen => Self::UNSEEN,
            CullArg::Backs => Self::ALL,
        }
    }
}
