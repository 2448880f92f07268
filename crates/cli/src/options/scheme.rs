//! Names of schemes, and which of them this build can draw.

use std::fmt;
use std::str::FromStr;

/// A scheme by name, whether or not this build has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SchemeName {
    /// Gregory patches on the cage itself.
    Gregory1,
    /// Rational bicubic Gregory patches after isolation.
    Gregory2,
    /// The exact limit surface in the eigenbasis.
    Stam,
    /// Bidegree 7 patches with continuous curvature.
    Biseptic,
    /// Precomputed basis functions.
    Table,
}

impl SchemeName {
    const ALL: [Self; 5] = [Self::Gregory1, Self::Gregory2, Self::Stam, Self::Biseptic, Self::Table];

    /// The name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Gregory1 => "gregory1",
            Self::Gregory2 => "gregory2",
            Self::Stam => "stam",
            Self::Biseptic => "biseptic",
            Self::Table => "table",
        }
    }
}

impl fmt::Display for SchemeName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

impl FromStr for SchemeName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|scheme| scheme.name() == text);
        found.ok_or_else(|| format!("the schemes are {}", Self::ALL.map(Self::name).join(", ")))
    }
}
