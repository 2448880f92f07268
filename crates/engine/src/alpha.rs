//! Transparent backgrounds. Samples of a pixel are averaged by the device, which is right only for colours that alpha is multiplied into; pictures have colours
//! that it is not (PNG, section 6.2). So the background is cleared multiplied in, and read-back divides it out.

use osculate_gpu::Format;

/// The colour with alpha multiplied in, linear.
pub(crate) fn alpha_multiplied_in([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    [r * a, g * a, b * a, a]
}

/// Divides alpha out of the pixels of a picture in that format.
pub(crate) fn divide_alpha_out(rgba: &mut [u8], format: Format) {
    let encoded = format == Format::Rgba8Srgb;
    for pixel in rgba.as_chunks_mut::<4>().0 {
        let [.., alpha] = *pixel;
        if alpha > 0 && alpha < u8::MAX {
            let alpha = f32::from(alpha) / 255.0;
            for channel in &mut pixel[..3] {
                *channel = divided(*channel, alpha, encoded);
            }
        }
    }
}

fn divided(channel: u8, alpha: f32, encoded: bool) -> u8 {
    let value = f32::from(channel) / 255.0;
    let value = if encoded { encode((decode(value) / alpha).min(1.0)) } else { (value / alpha).min(1.0) };
    (value * 255.0).round() as u8
}

/// sRGB to linear (IEC 61966-2-1).
fn decode(c: f32) -> f32 {
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Linear to sRGB.
fn encode(c: f32) -> f32 {
    if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pixel of which the surface covers a part, before a background of that alpha, as the device averages it.
    fn averaged(surface: f32, coverage: f32, background: [f32; 4]) -> [u8; 4] {
        let [behind, .., alpha] = alpha_multiplied_in(background);
        let colour = encode(coverage * surface + (1.0 - coverage) * behind);
        let byte = |c: f32| (c * 255.0).round() as u8;
        [byte(colour), byte(colour), byte(colour), byte(coverage + (1.0 - coverage) * alpha)]
    }

    #[test]
    fn a_covered_part_has_the_colour_of_the_surface() {
        for coverage in [0.25, 0.5, 0.75] {
            let mut pixel = averaged(0.6, coverage, [0.0; 4]);
            divide_alpha_out(&mut pixel, Format::Rgba8Srgb);
            let expected = (encode(0.6) * 255.0).round();
            assert!((f32::from(pixel[0]) - expected).abs() <= 2.0, "{pixel:?}, {expected}");
        }
    }

    #[test]
    fn a_background_comes_out_as_it_went_in() {
        let background = [0.4, 0.4, 0.4, 0.5];
        let mut pixel = averaged(1.0, 0.0, background);
        divide_alpha_out(&mut pixel, Format::Rgba8Srgb);
        assert!((f32::from(pixel[0]) - encode(0.4) * 255.0).abs() <= 2.0, "{pixel:?}");
    }

    #[test]
    fn opaque_and_empty_pixels_stay() {
        let mut pixels = [10, 20, 30, 255, 0, 0, 0, 0];
        divide_alpha_out(&mut pixels, Format::Rgba8Srgb);
        assert_eq!(pixels, [10, 20, 30, 255, 0, 0, 0, 0]);
    }
}
