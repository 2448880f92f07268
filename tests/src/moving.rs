//! Moving pictures: animated PNG files with one palette, which viewers of PNG files play and others show the first frame of.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use osculate_compare::Picture;

/// Colours of a palette.
const COLOURS: usize = 256;

type Rgb = [u8; 3];

/// Writes frames of one size that play for ever, so many in a second.
///
/// # Panics
/// If the file cannot be written, or there is no frame.
pub fn write(path: &Path, frames: &[Picture], per_second: u16) {
    let file = File::create(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    encode(BufWriter::new(file), frames, per_second).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

fn encode(file: impl Write, frames: &[Picture], per_second: u16) -> Result<(), png::EncodingError> {
    let palette = Palette::of(frames);
    let size = frames[0].size();
    let mut encoder = png::Encoder::new(file, size.width, size.height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.colours.concat());
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.set_animated(frames.len() as u32, 0)?;
    encoder.set_frame_delay(1, per_second)?;
    let mut writer = encoder.write_header()?;
    for frame in frames {
        let indices: Vec<u8> = colours(frame).map(|colour| palette.index_of[&colour]).collect();
        writer.write_image_data(&indices)?;
    }
    writer.finish()
}

fn colours(picture: &Picture) -> impl Iterator<Item = Rgb> + '_ {
    picture.pixels().map(|[r, g, b, _]| [r, g, b])
}

/// Few colours that stand for many.
struct Palette {
    /// From dark to light.
    colours: Vec<Rgb>,
    /// For each colour of the frames the one that stands for it.
    index_of: BTreeMap<Rgb, u8>,
}

impl Palette {
    /// Median cut (Heckbert, "Color image quantization for frame buffer display", SIGGRAPH 1982): the box of colours that is off by
    /// most in all is halved, until there are enough.
    fn of(frames: &[Picture]) -> Self {
        let mut counts: BTreeMap<Rgb, u64> = BTreeMap::new();
        frames.iter().flat_map(colours).for_each(|colour| *counts.entry(colour).or_default() += 1);
        let mut boxes = vec![Box { colours: counts.into_iter().collect() }];
        while boxes.len() < COLOURS {
            let widest = boxes.iter().enumerate().max_by(|(_, a), (_, b)| a.spread().1.total_cmp(&b.spread().1));
            let Some((at, _)) = widest.filter(|(_, found)| found.colours.len() > 1) else { break };
            let half = boxes[at].halve();
            boxes.push(half);
        }
        boxes.sort_by_key(|found| found.mean().map(u32::from).iter().sum::<u32>());
        let members =
            (0..=u8::MAX).zip(&boxes).flat_map(|(index, found)| found.colours.iter().map(move |c| (c.0, index)));
        Self { index_of: members.collect(), colours: boxes.iter().map(Box::mean).collect() }
    }
}

/// Colours with how often they occur.
struct Box {
    colours: Vec<(Rgb, u64)>,
}

impl Box {
    fn means(&self) -> [f64; 3] {
        let total: u64 = self.colours.iter().map(|c| c.1).sum();
        std::array::from_fn(|channel| {
            self.colours.iter().map(|(rgb, n)| f64::from(rgb[channel]) * *n as f64).sum::<f64>() / total as f64
        })
    }

    fn mean(&self) -> Rgb {
        self.means().map(|mean| mean.round() as u8)
    }

    /// The channel in which the colours are off the mean by most, and the sum of the squares.
    fn spread(&self) -> (usize, f64) {
        let means = self.means();
        let sum = |channel: usize| {
            let square = |(rgb, n): &(Rgb, u64)| (f64::from(rgb[channel]) - means[channel]).powi(2) * *n as f64;
            self.colours.iter().map(square).sum::<f64>()
        };
        [0, 1, 2].map(|channel| (channel, sum(channel))).into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("three")
    }

    /// Keeps the colours below the mean in that channel, and returns the others; both are some.
    fn halve(&mut self) -> Self {
        let (channel, _) = self.spread();
        let mean = self.means()[channel];
        self.colours.sort_by_key(|(rgb, _)| rgb[channel]);
        let at =
            self.colours.partition_point(|(rgb, _)| f64::from(rgb[channel]) <= mean).clamp(1, self.colours.len() - 1);
        Self { colours: self.colours.split_off(at) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use osculate_compare::load;

    #[test]
    fn frames_are_kept_and_the_first_is_what_others_show() {
        let shaded = |shift: u32| {
            let pixel = move |i: u32| [(i % 40 * 6) as u8, (i / 40 * 6) as u8, (shift * 90) as u8, 255];
            Picture::new(40, 30, (0..1200).flat_map(pixel).collect()).unwrap()
        };
        let frames = [shaded(0), shaded(1), shaded(2)];
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("moving.png");
        write(&path, &frames, 24);
        let mut reader = png::Decoder::new(std::io::BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
        assert_eq!(
            reader.info().animation_control().map(|control| (control.num_frames, control.num_plays)),
            Some((3, 0))
        );
        let mut indices = vec![0; 1200];
        for _ in 0..3 {
            reader.next_frame(&mut indices).unwrap();
        }
        let first = load(&path).unwrap();
        let furthest = first.rgba().iter().zip(frames[0].rgba()).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(furthest <= 20, "{furthest}");
    }
}
