//! Frames of several scenes, in turn.

use super::summary::median;
use crate::failure::Failure;
use crate::postponement::Interruption;
use std::time::Instant;

/// How long is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timing {
    /// Frames of each scene.
    pub(super) frames: u32,
    /// Rounds that they are spread over.
    pub(super) rounds: u32,
    /// Most seconds for each scene.
    pub(super) max_seconds: f64,
}

/// Frames of a scene that are drawn before those that count, in every round: caches hold what another scene used.
const WARM_UP: u32 = 2;

/// Times of one scene, in seconds.
#[derive(Clone, Debug, Default)]
pub(super) struct Times {
    /// Of all frames that count.
    pub(super) frames: Vec<f64>,
    /// Median of each round.
    pub(super) rounds: Vec<f64>,
}

/// Scenes that can be drawn, known by number.
pub(super) trait Stage {
    /// Draws a frame of a scene: its frames are numbered from 1. The seconds that it took.
    fn draw(&mut self, scene: usize, number: u32) -> Result<f64, Failure>;

    /// What is to be done when a scene has had its turn in a round, beside what is timed.
    fn end_turn(&mut self, scene: usize) -> Result<(), Failure>;
}

/// Draws frames of all scenes, round after round. Ends early when that is asked for; then all scenes have equally many rounds.
pub(super) fn interleave(
    timing: &Timing,
    scenes: usize,
    interruption: &Interruption,
    stage: &mut impl Stage,
) -> Result<Vec<Times>, Failure> {
    let mut times = vec![Times::default(); scenes];
    let mut numbers = vec![0; scenes];
    for round in 0..timing.rounds {
        let mut turns = vec![Vec::new(); scenes];
        for scene in 0..scenes {
            if interruption.is_requested() {
                return Ok(times);
            }
            let mut next = || {
                numbers[scene] += 1;
                stage.draw(scene, numbers[scene])
            };
            let start = Instant::now();
            for _ in 0..WARM_UP {
                next()?;
            }
            let allowance = timing.max_seconds / f64::from(timing.rounds);
            for frame in 0..share(timing.frames, timing.rounds, round) {
                if frame > 0 && (start.elapsed().as_secs_f64() > allowance || interruption.is_requested()) {
                    break;
                }
                turns[scene].push(next()?);
            }
            stage.end_turn(scene)?;
        }
        for (times, turn) in times.iter_mut().zip(turns) {
            times.rounds.extend(median(turn.iter().copied()));
            times.frames.extend(turn);
        }
    }
    Ok(times)
}

/// The frames of a round, when all are spread evenly; at least one.
fn share(frames: u32, rounds: u32, round: u32) -> u32 {
    (frames / rounds + u32::from(round < frames % rounds)).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames that last as long as their number says.
    #[derive(Default)]
    struct Numbers {
        drawn: Vec<(usize, u32)>,
        turns: usize,
    }

    impl Stage for Numbers {
        fn draw(&mut self, scene: usize, number: u32) -> Result<f64, Failure> {
            self.drawn.push((scene, number));
            Ok(f64::from(number))
        }

        fn end_turn(&mut self, _: usize) -> Result<(), Failure> {
            self.turns += 1;
            Ok(())
        }
    }

    #[test]
    fn frames_are_spread_over_the_rounds_in_turn() {
        let timing = Timing { frames: 7, rounds: 3, max_seconds: 1e9 };
        let mut stage = Numbers::default();
        let times = interleave(&timing, 2, &Interruption::never(), &mut stage).unwrap();
        assert_eq!(stage.turns, 6);
        // Two frames of each turn warm up.
        assert_eq!(stage.drawn.len(), 2 * (7 + 3 * 2));
        assert_eq!(stage.drawn[..6], [(0, 1), (0, 2), (0, 3), (0, 4), (0, 5), (1, 1)]);
        assert_eq!(times[0].frames, [3.0, 4.0, 5.0, 8.0, 9.0, 12.0, 13.0]);
        assert_eq!(times[1].rounds, [4.0, 8.5, 12.5]);
    }

    #[test]
    fn every_round_has_a_frame_however_long_it_takes() {
        let timing = Timing { frames: 100, rounds: 4, max_seconds: 1e-12 };
        let times = interleave(&timing, 1, &Interruption::never(), &mut Numbers::default()).unwrap();
        assert_eq!((times[0].rounds.len(), times[0].frames.len()), (4, 4));
    }

    #[test]
    fn an_interruption_ends_it_at_once() {
        let timing = Timing { frames: 100, rounds: 4, max_seconds: 1.0 };
        let mut stage = Numbers::default();
        let times = interleave(&timing, 1, &Interruption::requested(), &mut stage).unwrap();
        assert!(times[0].frames.is_empty() && stage.drawn.is_empty());
    }
}
