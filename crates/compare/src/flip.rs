//! The comparison: FLIP over two backgrounds, so that alpha counts.

use crate::picture::{CompareError, MAX_PIXELS, Picture, Size};
use nv_flip::{FlipImageFloat, FlipImageRgb8};

/// How two pictures are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareDesc {
    /// Pixels per degree of the viewer's field of vision. More pixels per degree hide finer differences. The
    /// default is FLIP's own 67: a 0.7 m wide 3840 pixel screen seen from 0.7 m.
    pub pixels_per_degree: f32,
}

impl Default for CompareDesc {
    fn default() -> Self {
        Self { pixels_per_degree: nv_flip::DEFAULT_PIXELS_PER_DEGREE }
    }
}

/// What the comparison of two pictures found. FLIP values run from 0 (equal) to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Size of both pictures.
    pub size: Size,
    /// Mean of the map.
    pub mean: f32,
    /// The value that 99 of 100 pixels do not exceed.
    pub p99: f32,
    /// Largest value of the map.
    pub max: f32,
    /// FLIP value per pixel, rows from the top: the larger of those over a black and over a white background.
    pub map: Vec<f32>,
    /// Largest difference of alpha at a pixel, in steps of 1/255.
    pub alpha: u8,
}

/// Compares picture `b` with the reference `a`.
///
/// FLIP knows opaque colours only. Where a picture is not opaque, both are laid over black and over white, and
/// each pixel gets the larger of the two values: no difference of alpha is invisible over both.
///
/// # Errors
///
/// [`CompareError::SizesDiffer`] naming both sizes, [`CompareError::TooLarge`] above [`MAX_PIXELS`].
pub fn compare(a: &Picture, b: &Picture, desc: &CompareDesc) -> Result<Comparison, CompareError> {
    let size = a.size();
    if size != b.size() {
        return Err(CompareError::SizesDiffer { a: size, b: b.size() });
    }
    if size.pixels() > MAX_PIXELS {
        return Err(CompareError::TooLarge(size));
    }
    let mut map = flip_over(a, b, 0, desc);
    if !(a.is_opaque() && b.is_opaque()) {
        let over_white = flip_over(a, b, u8::MAX, desc);
        map.iter_mut().zip(over_white).for_each(|(value, white)| *value = value.max(white));
    }
    Ok(Comparison {
        size,
        mean: mean(&map),
        p99: percentile(&map, 0.99),
        max: map.iter().copied().fold(0.0, f32::max),
        alpha: a.pixels().zip(b.pixels()).map(|(a, b)| a[3].abs_diff(b[3])).max().unwrap_or(0),
        map,
    })
}

impl Comparison {
    /// The map as a picture: black where the pictures are equal, through purple and orange to light yellow
    /// where they differ most (the palette *magma*).
    #[must_use]
    pub fn picture(&self) -> Picture {
        let Size { width, height } = self.size;
        let map = FlipImageFloat::with_data(width, height, &self.map);
        let rgb = map.apply_color_lut(&nv_flip::magma_lut()).to_vec();
        let rgba = rgb.as_chunks::<3>().0.iter().flat_map(|&[r, g, b]| [r, g, b, u8::MAX]);
        Picture::new(width, height, rgba.collect()).expect("four bytes per pixel of the map")
    }
}

/// The FLIP map of two pictures of one size over the grey `background`.
fn flip_over(a: &Picture, b: &Picture, background: u8, desc: &CompareDesc) -> Vec<f32> {
    let over = |picture: &Picture| {
        let rgb: Vec<u8> = picture.pixels().flat_map(|pixel| composite(pixel, background)).collect();
        FlipImageRgb8::with_data(picture.size().width, picture.size().height, &rgb)
    };
    nv_flip::flip(over(a), over(b), desc.pixels_per_degree).to_vec()
}

/// A pixel over a grey background, `alpha colour + (1 - alpha) background`, rounded to nearest.
fn composite([r, g, b, alpha]: [u8; 4], background: u8) -> [u8; 3] {
    let (alpha, background) = (u32::from(alpha), u32::from(background));
    [r, g, b].map(|c| ((u32::from(c) * alpha + background * (255 - alpha) + 127) / 255) as u8)
}

/// Mean in f64: in f32 the sum over a few million pixels would lose what it is meant to show.
fn mean(map: &[f32]) -> f32 {
    (map.iter().map(|&value| f64::from(value)).sum::<f64>() / map.len() as f64) as f32
}

/// The smallest value that at least the share `part` of all values does not exceed (nearest rank).
fn percentile(map: &[f32], part: f64) -> f32 {
    let rank = (part * map.len() as f64).ceil() as usize;
    let index = rank.clamp(1, map.len()) - 1;
    *map.to_vec().select_nth_unstable_by(index, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentile_is_the_nearest_rank() {
        let ramp: Vec<f32> = (1..=200).rev().map(|i| i as f32).collect();
        assert_eq!(percentile(&ramp, 0.99), 198.0);
        assert_eq!(percentile(&ramp, 1.0), 200.0);
        assert_eq!(percentile(&[3.0], 0.99), 3.0);
    }

    #[test]
    fn composite_meets_both_ends() {
        assert_eq!(composite([10, 20, 30, 255], 255), [10, 20, 30]);
        assert_eq!(composite([10, 20, 30, 0], 255), [255; 3]);
        assert_eq!(composite([255, 0, 100, 128], 0), [128, 0, 50]);
    }

    #[test]
    fn every_step_of_alpha_shows_over_black_or_white() {
        for colour in 0..=255 {
            for alpha in 0..255 {
                let [a, b] = [alpha, alpha + 1].map(|alpha| [colour, colour, colour, alpha]);
                let differs = |background| composite(a, background) != composite(b, background);
                assert!(differs(0) || differs(255), "grey {colour}, alpha {alpha}");
            }
        }
    }

    #[test]
    fn a_single_pixel_is_compared() {
        let [black, white] = [0, 255].map(|c| Picture::new(1, 1, vec![c, c, c, 255]).unwrap());
        let comparison = compare(&black, &white, &CompareDesc::default()).unwrap();
        assert!(comparison.mean > 0.9, "{comparison:?}");
        assert_eq!(comparison.picture().size(), Size { width: 1, height: 1 });
    }
}
