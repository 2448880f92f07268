//! Names of schemes, and which of them this build can draw.

use crate::failure::Failure;
use osculate::Scheme;
use std::fmt;
use std::str::FromStr;

/// A scheme by name, whether or not this build draws it.
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

    /// What the help of `--scheme` says.
    pub(crate) fn help() -> String {
        format!("How the surface is put together; this build has {}", in_this_build())
    }

    /// The name on the command line.
    fn name(self) -> &'static str {
        match self {
            Self::Gregory1 => "gregory1",
            Self::Gregory2 => "gregory2",
            Self::Stam => "stam",
            Self::Biseptic => "biseptic",
            Self::Table => "table",
        }
    }

    /// The scheme, if this build draws it.
    pub(crate) fn in_this_build(self) -> Result<Scheme, Failure> {
        let hint = "leave --scheme away for the default, gregory2";
        self.name().parse().map_err(|unknown| Failure::usage(unknown).with_hint(hint))
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

/// The names of the schemes of this build.
fn in_this_build() -> String {
    Scheme::ALL.iter().map(|scheme| scheme.name()).collect::<Vec<_>>().join(", ")
}

/// A scheme, or every one that this build draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SchemeChoice {
    /// Every scheme of this build.
    All,
    /// One scheme.
    One(SchemeName),
}

impl SchemeChoice {
    /// What the help of `--schemes` says.
    pub(crate) fn help() -> String {
        format!("Schemes to prove, with commas between; this build has {}; all: every one", in_this_build())
    }

    /// The schemes that a list of choices stands for, each once, in the order of the list.
    pub(crate) fn schemes(choices: &[Self]) -> Result<Vec<Scheme>, Failure> {
        let mut schemes = Vec::new();
        for choice in choices {
            let meant = match choice {
                Self::All => Scheme::ALL.to_vec(),
                Self::One(name) => vec![name.in_this_build()?],
            };
            for scheme in meant {
                if !schemes.contains(&scheme) {
                    schemes.push(scheme);
                }
            }
        }
        Ok(schemes)
    }
}

impl FromStr for SchemeChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self::All);
        }
        text.parse().map(Self::One).map_err(|error: String| format!("{error}; or all"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_name_each_scheme_once() {
        let schemes = |texts: &[&str]| {
            let choices: Vec<_> = texts.iter().map(|text| text.parse().unwrap()).collect();
            SchemeChoice::schemes(&choices).unwrap()
        };
        assert_eq!(schemes(&["all", "stam"]), Scheme::ALL);
        let stam_first = schemes(&["stam", "all", "stam"]);
        assert_eq!(stam_first[0], Scheme::Stam);
        assert_eq!(stam_first.len(), Scheme::ALL.len());
    }

    #[test]
    fn every_scheme_of_the_build_has_a_name_here() {
        for scheme in Scheme::ALL {
            assert_eq!(scheme.name().parse::<SchemeName>().unwrap().in_this_build().unwrap(), *scheme);
        }
        assert!("nurbs".parse::<SchemeChoice>().is_err());
    }
}
