//! Which moments of an animation are drawn.

use crate::failure::Failure;
use clap::Args;
use osculate_cage::{Animation, Bounds, Sequence};
use std::path::Path;
use std::str::FromStr;

/// Which animation plays, and at which times the cage is shown.
#[derive(Args, Debug)]
#[command(next_help_heading = "Animation")]
pub(crate) struct AnimationArgs {
    /// Show the cage as it is at this time of its animation or sequence, in seconds; before its first key or frame and
    /// after its last it stands still.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds, conflicts_with = "frames")]
    time: Option<f64>,

    /// Draw frames A to B, both included, one picture each; the name after -o says where the number goes:
    /// frame_%04d.png. Frame k shows the time k / FPS.
    #[arg(long, value_name = "A..B")]
    frames: Option<FrameRange>,

    /// Frames per second; of numbered files that are read too. Default: 24.
    #[arg(long, value_name = "FPS", allow_negative_numbers = true, value_parser = rate, requires = "frames")]
    fps: Option<f64>,

    /// The animation of a glTF file, by its name or its number from 0. Default: the first.
    #[arg(long, value_name = "NAME|N")]
    animation: Option<String>,

    /// Draw part I of N of the frames, each N-th of them: N jobs with I from 1 to N draw all, each once.
    #[arg(long, value_name = "I/N", requires = "frames")]
    shard: Option<Shard>,

    /// Let the camera show where the cage is in all frames. Default: where it is in the first, and in every part the same.
    #[arg(long, requires = "frames", conflicts_with = "camera")]
    fit_frames: bool,
}

/// Frames from a first to a last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FrameRange {
    first: u32,
    last: u32,
}

impl FromStr for FrameRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..").and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
        match ends {
            Some((first, last)) if first <= last => Ok(Self { first, last }),
            _ => Err("expected two whole numbers from 0 on, the smaller first, such as 0..23".into()),
        }
    }
}

/// A part of some frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    /// From 1.
    part: u32,
    parts: u32,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(part, parts)| Some((part.parse().ok()?, parts.parse().ok()?)));
        match numbers {
            Some((part, parts)) if 1 <= part && part <= parts => Ok(Self { part, parts }),
            _ => Err("expected a part and a number of parts, such as 1/4 to 4/4".into()),
        }
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|time: &f64| time.is_finite()).ok_or_else(|| "expected a time in seconds".into())
}

fn rate(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|&fps: &f64| fps.is_finite() && fps > 0.0)
        .ok_or_else(|| "expected a number of frames per second greater than 0".into())
}

/// A moment that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moment {
    /// The number of the frame; none for the only picture.
    pub(crate) number: Option<u32>,
    /// Its time in seconds.
    pub(crate) seconds: f64,
}

/// What moves a cage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    /// An animation of its rig, by index.
    Rig(usize),
    /// The frames of numbered files, or time samples.
    Frames,
}

/// The moments that are drawn, at least one of all jobs together.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Film {
    pub(crate) motion: Motion,
    /// All moments, in whichever part they are.
    all: Vec<Moment>,
    shard: Shard,
    fit_frames: bool,
}

impl AnimationArgs {
    /// Whether several pictures are asked for.
    pub(crate) fn is_sequence(&self) -> bool {
        self.frames.is_some()
    }

    /// Whether any moment is asked for.
    pub(crate) fn is_film(&self) -> bool {
        self.time.is_some() || self.frames.is_some() || self.animation.is_some()
    }

    /// The rate of numbered files, if one is given.
    pub(crate) fn rate(&self) -> Option<f64> {
        self.fps
    }

    /// What is to be drawn of a file.
    pub(crate) fn film(&self, file: &Path, sequence: &Sequence) -> Result<Film, Failure> {
        Ok(Film {
            motion: self.motion(file, sequence)?,
            all: self.moments(),
            shard: self.shard.unwrap_or(Shard { part: 1, parts: 1 }),
            fit_frames: self.fit_frames,
        })
    }

    fn motion(&self, file: &Path, sequence: &Sequence) -> Result<Motion, Failure> {
        let animations = sequence.cage().rig().map_or(&[][..], |rig| &rig.animations);
        match &self.animation {
            None if sequence.frame_count() > 1 => Ok(Motion::Frames),
            None if !animations.is_empty() => Ok(Motion::Rig(0)),
            Some(wanted) if !animations.is_empty() => find(animations, wanted).map(Motion::Rig),
            Some(_) if sequence.frame_count() > 1 => {
                Err(Failure::usage(format_args!("{}: frames have no animations to choose from", file.display()))
                    .with_hint("leave --animation away"))
            }
            _ => Err(Failure::usage(format_args!("{}: nothing is animated in this file", file.display())).with_hint(
                "leave --time, --frames and --animation away, or name a glTF or USD file that moves, or numbered files",
            )),
        }
    }

    fn moments(&self) -> Vec<Moment> {
        let Some(FrameRange { first, last }) = self.frames else {
            return vec![Moment { number: None, seconds: self.time.unwrap_or(0.0) }];
        };
        let fps = self.fps.unwrap_or(24.0);
        (first..=last).map(|k| Moment { number: Some(k), seconds: f64::from(k) / fps }).collect()
    }
}

/// The animation of that name, else of that number.
fn find(animations: &[Animation], wanted: &str) -> Result<usize, Failure> {
    let named = animations.iter().position(|animation| animation.name == wanted);
    let numbered = || wanted.parse().ok().filter(|&number| number < animations.len());
    named.or_else(numbered).ok_or_else(|| {
        let names: Vec<String> = animations.iter().zip(0..).map(|(a, n)| format!("{n} {:?}", a.name)).collect();
        Failure::usage(format_args!("there is no animation {wanted:?}"))
            .with_hint(format_args!("the file has {}", names.join(", ")))
    })
}

impl Film {
    /// The moments of this part.
    pub(crate) fn moments(&self) -> impl ExactSizeIterator<Item = Moment> + '_ {
        let Shard { part, parts } = self.shard;
        self.all.iter().skip(part as usize - 1).step_by(parts as usize).copied()
    }

    /// The box that a camera is fitted to: that of the first frame, or of all, in whichever part they are.
    pub(crate) fn bounds<E>(&self, at: impl Fn(f64) -> Result<Bounds, E>) -> Result<Bounds, E> {
        let shown = if self.fit_frames { &self.all[..] } else { &self.all[..1] };
        let boxes: Vec<Bounds> = shown.iter().map(|moment| at(moment.seconds)).collect::<Result<_, _>>()?;
        Ok(Bounds::of(&boxes.iter().flat_map(|found| [found.min, found.max]).collect::<Vec<_>>()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_include_both_ends() {
        let args = |frames: &str, shard: Option<&str>| AnimationArgs {
            time: None,
            frames: Some(frames.parse().unwrap()),
            fps: Some(10.0),
            animation: None,
            shard: shard.map(|shard| shard.parse().unwrap()),
            fit_frames: false,
        };
        let moments = args("3..5", None).moments();
        let expected = [(3, 0.3), (4, 0.4), (5, 0.5)];
        assert_eq!(moments, expected.map(|(k, seconds)| Moment { number: Some(k), seconds }));
        assert_eq!(args("7..7", None).moments().len(), 1);
        for wrong in ["", "1", "5..3", "-1..3", "1...3", "1..=3", "a..b"] {
            assert!(wrong.parse::<FrameRange>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn parts_share_the_frames_out() {
        let all: Vec<Moment> = (0..11).map(|k| Moment { number: Some(k), seconds: 0.0 }).collect();
        for parts in [1, 3, 11, 20] {
            let of_part = |part| Film {
                motion: Motion::Frames,
                all: all.clone(),
                shard: format!("{part}/{parts}").parse().unwrap(),
                fit_frames: false,
            };
            let mut drawn: Vec<u32> = (1..=parts)
                .flat_map(|part| of_part(part).moments().filter_map(|moment| moment.number).collect::<Vec<_>>())
                .collect();
            drawn.sort_unstable();
            assert_eq!(drawn, (0..11).collect::<Vec<_>>(), "{parts}");
        }
        for wrong in ["", "1", "0/3", "4/3", "1/0", "-1/2", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn animations_are_found_by_name_and_by_number() {
        let animations = ["walk", "1", "run"].map(|name| Animation { name: name.into(), ..Animation::default() });
        let found = |wanted| find(&animations, wanted).ok();
        assert_eq!(["walk", "run", "1", "2", "0"].map(found), [Some(0), Some(2), Some(1), Some(2), Some(0)]);
        assert_eq!(["3", "swim", ""].map(found), [None; 3]);
    }
}
