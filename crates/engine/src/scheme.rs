//! The surface schemes of this build.

use std::{fmt, str::FromStr};

/// How patches next to extraordinary vertices are shaped. Regular patches are bicubic in every scheme.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Scheme {
    /// Gregory patches after the isolating refinement steps: tangent plane continuous (report, section 4.4).
    #[default]
    Gregory2,
}

impl Scheme {
    /// All schemes of this build.
    pub const ALL: &'static [Self] = &[Self::Gregory2];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gregory2 => "gregory2",
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
