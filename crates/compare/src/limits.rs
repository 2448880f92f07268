//! What counts as the same picture.

use crate::flip::Comparison;
use std::fmt;

/// Largest FLIP values at which two pictures pass as the same.
///
/// Both are needed: the mean is blind to a small hole in a large picture, the 99th percentile to a faint change
/// of everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest mean over all pixels.
    pub mean: f32,
    /// Largest value of the 99th percentile.
    pub p99: f32,
}

impl Limits {
    /// For the driver that drew the goldens (llvmpipe). Its pictures repeat bit for bit on one build and differ by
    /// roundings between builds: one pixel in a hundred off by 1/255 has a mean of 0.0012 on a shaded ball, all
    /// pixels 1 % darker have 0.029.
    pub const SAME_DRIVER: Self = Self { mean: 0.002, p99: 0.02 };

    /// For any other device, where half of the pixels may be off by 1/255 (mean 0.014) and silhouettes may be
    /// covered otherwise. One sample per pixel instead of four has a 99th percentile of 0.59, a shift by one pixel
    /// a mean of 0.077: both are refused.
    pub const OTHER_DEVICE: Self = Self { mean: 0.015, p99: 0.25 };

    /// The limits for goldens drawn with llvmpipe when compared with pictures of a device.
    #[must_use]
    pub fn for_device(is_llvmpipe: bool) -> Self {
        if is_llvmpipe { Self::SAME_DRIVER } else { Self::OTHER_DEVICE }
    }

    /// These limits widened for one picture that needs it; say why where this is called.
    #[must_use]
    pub fn widened(self, mean: f32, p99: f32) -> Self {
        Self { mean: self.mean + mean, p99: self.p99 + p99 }
    }

    /// Whether a comparison stays within the limits.
    ///
    /// # Errors
    ///
    /// [`Excess`] with the figures if one of them is above its limit (or is not a number).
    pub fn check(&self, comparison: &Comparison) -> Result<(), Excess> {
        let Comparison { mean, p99, max, alpha, .. } = *comparison;
        if mean <= self.mean && p99 <= self.p99 {
            return Ok(());
        }
        Err(Excess { mean, p99, max, alpha, limits: *self })
    }
}

/// The figures of a comparison that is above its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Mean FLIP value.
    pub mean: f32,
    /// 99th percentile of the FLIP values.
    pub p99: f32,
    /// Largest FLIP value.
    pub max: f32,
    /// Largest difference of alpha, in steps of 1/255.
    pub alpha: u8,
    /// The limits that do not hold.
    pub limits: Limits,
}

impl std::error::Error for Excess {}

impl fmt::Display for Excess {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mean, p99, max, alpha, limits } = self;
        write!(
            out,
            "the pictures differ: FLIP mean {mean:.5} (limit {}), p99 {p99:.4} (limit {}), max {max:.4}, alpha {alpha}/255",
            limits.mean, limits.p99
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Size;

    fn figures(mean: f32, p99: f32) -> Comparison {
        let size = Size { width: 1, height: 1 };
        Comparison { size, mean, p99, max: p99, map: vec![mean], alpha: 0 }
    }

    #[test]
    fn each_figure_has_its_limit() {
        let limits = Limits { mean: 0.1, p99: 0.5 };
        assert!(limits.check(&figures(0.1, 0.5)).is_ok());
        assert!(limits.check(&figures(0.11, 0.5)).is_err());
        assert!(limits.check(&figures(0.1, 0.51)).is_err());
        assert!(limits.check(&figures(f32::NAN, 0.0)).is_err());
        assert!(limits.widened(0.01, 0.01).check(&figures(0.105, 0.505)).is_ok());
    }

    #[test]
    fn the_message_names_figures_and_limits() {
        let text = Limits::SAME_DRIVER.check(&figures(0.25, 0.75)).unwrap_err().to_string();
        for part in ["0.25", "0.75", "0.002", "0.02"] {
            assert!(text.contains(part), "{text}");
        }
    }
}
