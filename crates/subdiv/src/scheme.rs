//! The surface schemes.

use std::{fmt, str::FromStr};

use crate::PatchForm;
use crate::patches::LIST_VALENCES;

/// How patches next to extraordinary vertices are shaped. Regular patches are bicubic in every scheme.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Scheme {
    /// Gregory patches of all quads and triangles, with no refinement but of larger faces: tangent plane continuous (report, section 4.4).
    Gregory1,
    /// Gregory patches after the isolating refinement steps: tangent plane continuous (report, section 4.4).
    #[default]
    Gregory2,
    /// The exact limit surface, in the eigenbasis of subdivision (report, section 4.2).
    Stam,
    /// Patches of bidegree 7 with continuous curvature (report, section 4.3); [`Self::Stam`] patches at boundaries and outside valence 3 to 12.
    Biseptic,
}

impl Scheme {
    /// All schemes of this build.
    pub const ALL: &'static [Self] = &[Self::Gregory1, Self::Gregory2, Self::Stam, Self::Biseptic];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gregory1 => "gregory1",
            Self::Gregory2 => "gregory2",
            Self::Stam => "stam",
            Self::Biseptic => "biseptic",
        }
    }

    /// The formula of patches at an inner vertex of that valence.
    pub(crate) fn interior_form(self, valence: u32) -> PatchForm {
        match self {
            Self::Biseptic if LIST_VALENCES.contains(&valence) => PatchForm::Biseptic,
            _ => self.boundary_form(),
        }
    }

    /// The formula of extraordinary patches at the boundary.
    pub(crate) fn boundary_form(self) -> PatchForm {
        match self {
            Self::Gregory1 | Self::Gregory2 => PatchForm::Gregory,
            Self::Stam | Self::Biseptic => PatchForm::Stam,
        }
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// There is no scheme of that name in this build.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("this build has no scheme {name:?}; it has {}", Scheme::ALL.iter().map(|scheme| scheme.name()).collect::<Vec<_>>().join(", "))]
pub struct UnknownScheme {
    /// The name asked for.
    pub name: String,
}

impl FromStr for Scheme {
    type Err = UnknownScheme;

    fn from_str(name: &str) -> Result<Self, UnknownScheme> {
        let unknown = || UnknownScheme { name: name.to_owned() };
        Self::ALL.iter().copied().find(|scheme| scheme.name() == name).ok_or_else(unknown)
    }
}
