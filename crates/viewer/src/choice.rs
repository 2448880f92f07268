//! Things to choose from: their names in files and on the command line, and their words in the window.

use osculate::{Evaluator, Scheme, Shade, Spacing, gpu::PresentMode};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// One of a few.
pub(crate) trait Choice: Copy + PartialEq + 'static {
    /// All of them, in the order of keys and lists.
    const ALL: &'static [Self];

    /// The name in the settings.
    fn name(self) -> &'static str;

    /// The name in the window.
    fn label(self) -> &'static str {
        self.name()
    }

    /// A line about it.
    fn about(self) -> &'static str;

    /// The one `steps` further on, around the end.
    fn step(self, steps: isize) -> Self {
        let at = Self::ALL.iter().position(|&one| one == self).unwrap_or(0) as isize;
        Self::ALL[(at + steps).rem_euclid(Self::ALL.len() as isize) as usize]
    }
}

impl Choice for Scheme {
    const ALL: &'static [Self] = Self::ALL;

    fn name(self) -> &'static str {
        self.name()
    }

    fn about(self) -> &'static str {
        match self {
            Self::Gregory1 => "Gregory patches of the cage's own faces: the fewest",
            Self::Gregory2 => "Gregory patches after isolating extraordinary vertices",
            Self::Stam => "the exact limit surface, by eigenbases",
            Self::Biseptic => "bidegree 7, curvature continuous",
            _ => "",
        }
    }
}

impl Choice for Shade {
    const ALL: &'static [Self] = &[
        Self::Lit,
        Self::Patches,
        Self::Valence,
        Self::Normals,
        Self::Zebra,
        Self::Reflection,
        Self::Curvature,
        Self::Gaussian,
        Self::Factors,
        Self::Textured,
        Self::Uv,
        Self::Difference,
    ];

    fn name(self) -> &'static str {
        self.name()
    }

    fn about(self) -> &'static str {
        match self {
            Self::Lit => "porcelain under three lights",
            Self::Patches => "patches by kind",
            Self::Valence => "patches by the edges at their irregular vertex",
            Self::Normals => "the normal as a colour",
            Self::Zebra => "stripes that break and kink where the surface does",
            Self::Reflection => "light tubes mirrored in lacquer",
            Self::Curvature => "mean: red bulges, blue is hollow",
            Self::Gaussian => "Gaussian: orange domes, violet saddles",
            Self::Factors => "segments across patches, darker is finer",
            Self::Textured => "the colours of the material",
            Self::Uv => "texture coordinates as squares",
            Self::Difference => "distance to the other scheme, darker is further",
            _ => "",
        }
    }
}

impl Choice for Spacing {
    const ALL: &'static [Self] = &[Self::Equal, Self::Odd, Self::Even];

    fn name(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Odd => "odd",
            Self::Even => "even",
        }
    }

    fn about(self) -> &'static str {
        match self {
            Self::Equal => "equal segments, levels rounded up",
            Self::Odd => "an odd number, moves smoothly with the level",
            Self::Even => "an even number, moves smoothly with the level",
        }
    }
}

impl Choice for Evaluator {
    const ALL: &'static [Self] = &[Self::Tessellator, Self::Compute];

    fn name(self) -> &'static str {
        if self == Self::Compute { "compute" } else { "tessellator" }
    }

    fn about(self) -> &'static str {
        if self == Self::Compute {
            "kernels write vertices, shared between patches"
        } else {
            "control and evaluation stages"
        }
    }
}

impl Choice for PresentMode {
    const ALL: &'static [Self] = &[Self::Fifo, Self::Mailbox, Self::Immediate];

    fn name(self) -> &'static str {
        match self {
            Self::Fifo => "fifo",
            Self::Mailbox => "mailbox",
            Self::Immediate => "immediate",
        }
    }

    fn about(self) -> &'static str {
        match self {
            Self::Fifo => "frames wait for the screen",
            Self::Mailbox => "the newest frame is shown with the screen's refresh",
            Self::Immediate => "frames are shown at once, torn or not",
        }
    }
}

/// How two schemes are shown at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Compare {
    /// One scheme only.
    #[default]
    Off,
    /// Two views side by side.
    Split,
    /// One view, one scheme left and the other right of a line.
    Wipe,
}

impl Choice for Compare {
    const ALL: &'static [Self] = &[Self::Off, Self::Split, Self::Wipe];

    fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Split => "split",
            Self::Wipe => "wipe",
        }
    }

    fn about(self) -> &'static str {
        match self {
            Self::Off => "one scheme",
            Self::Split => "two views side by side",
            Self::Wipe => "one view, divided by a line that can be moved",
        }
    }
}

/// The choice of that name.
pub(crate) fn named<T: Choice>(name: &str) -> Option<T> {
    T::ALL.iter().copied().find(|one| one.name() == name)
}

/// Writes the name, for `#[serde(with)]`.
pub(crate) fn serialize<T: Choice, S: Serializer>(one: &T, serializer: S) -> Result<S::Ok, S::Error> {
    one.name().serialize(serializer)
}

/// Reads the name, for `#[serde(with)]`.
pub(crate) fn deserialize<'de, T: Choice, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let name = String::deserialize(deserializer)?;
    named(&name).ok_or_else(|| D::Error::custom(format_args!("there is no {name:?} to choose")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<T: Choice + std::fmt::Debug>() {
        for &one in T::ALL {
            assert_eq!(named::<T>(one.name()), Some(one));
            assert!(!one.about().is_empty(), "{one:?}");
            assert_eq!(one.step(1).step(-1), one);
            assert_eq!(one.step(T::ALL.len() as isize), one);
        }
    }

    #[test]
    fn choices_have_names_of_their_own() {
        check::<Scheme>();
        check::<Shade>();
        check::<Spacing>();
        check::<Evaluator>();
        check::<PresentMode>();
        check::<Compare>();
        assert_eq!(named::<Scheme>("nurbs"), None);
    }
}
