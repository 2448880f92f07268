//! How finely the surface is cut: fixed levels, or edges of so many pixels.

use std::fmt;
use std::str::FromStr;

/// A tessellation factor of patch edges, in [1, 64].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Level(f32);

impl Level {
    /// The factor.
    pub(crate) fn get(self) -> f32 {
        self.0
    }
}

impl FromStr for Level {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let level = text.parse().ok().filter(|level| (1.0..=64.0).contains(level));
        level.map(Self).ok_or_else(|| "expected a number from 1 to 64".into())
    }
}

impl fmt::Display for Level {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(out)
    }
}

/// A length on screen in pixels, greater than 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pixels(f32);

impl Pixels {
    /// The length in pixels.
    pub(crate) fn get(self) -> f32 {
        self.0
    }
}

impl FromStr for Pixels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let pixels = text.parse().ok().filter(|pixels: &f32| pixels.is_finite() && *pixels > 0.0);
        pixels.map(Self).ok_or_else(|| "expected a number of pixels greater than 0".into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_in_range() {
        assert_eq!("1".parse(), Ok(Level(1.0)));
        assert_eq!("2.5".parse(), Ok(Level(2.5)));
        assert_eq!("64".parse::<Level>().unwrap().to_string(), "64");
        for wrong in ["", "0", "0.99", "64.1", "-3", "nan", "inf", "x"] {
            assert!(wrong.parse::<Level>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn pixels_are_positive() {
        assert_eq!("0.5".parse(), Ok(Pixels(0.5)));
        for wrong in ["0", "-1", "inf", "nan", "8px"] {
            assert!(wrong.parse::<Pixels>().is_err(), "{wrong}");
        }
    }
}
