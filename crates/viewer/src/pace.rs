//! How often frames are drawn, and how long they took.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Frames that are remembered.
const REMEMBERED: usize = 120;

/// Holds frames back where the screen does not.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    next: Option<Instant>,
}

impl Pace {
    /// When the next frame may begin; none if at once.
    pub(crate) fn wait(&self, now: Instant) -> Option<Instant> {
        self.next.filter(|&next| next > now)
    }

    /// Takes note of a frame that begins, with at most `limit` frames in a second; 0 for as many as there are.
    pub(crate) fn begin(&mut self, now: Instant, limit: u32) {
        self.next = (limit > 0).then(|| {
            let period = Duration::from_secs(1) / limit;
            // A frame that was late by less than its time does not slow down those after it.
            self.next.filter(|&next| now.saturating_duration_since(next) < period).unwrap_or(now) + period
        });
    }
}

/// Times of the last frames.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames {
    /// Seconds from one frame to the next, or of the work for a frame that nothing followed.
    times: VecDeque<f32>,
    /// When the last frame began, if another one follows at once.
    last: Option<Instant>,
}

impl Frames {
    /// Takes note of a frame that began at `now`, for which host and device worked so many seconds; `goes_on` if another one is
    /// to follow at once.
    pub(crate) fn add(&mut self, now: Instant, work: f32, goes_on: bool) {
        let since = self.last.map(|last| now.saturating_duration_since(last).as_secs_f32());
        if self.times.len() == REMEMBERED {
            self.times.pop_front();
        }
        self.times.push_back(since.unwrap_or(work));
        self.last = goes_on.then_some(now);
    }

    /// Oldest first.
    pub(crate) fn times(&self) -> impl ExactSizeIterator<Item = f32> + '_ {
        self.times.iter().copied()
    }

    /// The time in the middle of the sorted ones; 0 if there are none.
    pub(crate) fn median(&self) -> f32 {
        let mut sorted: Vec<f32> = self.times.iter().copied().collect();
        sorted.sort_unstable_by(f32::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_keep_their_distance() {
        let (mut pace, start) = (Pace::default(), Instant::now());
        let period = Duration::from_millis(20);
        assert_eq!(pace.wait(start), None);
        pace.begin(start, 50);
        assert_eq!(pace.wait(start), Some(start + period));
        // A little late: the one after it is on time again.
        pace.begin(start + period + Duration::from_millis(5), 50);
        assert_eq!(pace.wait(start + period), Some(start + 2 * period));
        // Very late: nothing is made up for.
        let late = start + 100 * period;
        pace.begin(late, 50);
        assert_eq!(pace.wait(late), Some(late + period));
    }

    #[test]
    fn no_limit_holds_nothing_back() {
        let (mut pace, start) = (Pace::default(), Instant::now());
        pace.begin(start, 0);
        assert_eq!(pace.wait(start), None);
    }

    #[test]
    fn times_are_those_between_frames_or_of_work() {
        let (mut frames, start) = (Frames::default(), Instant::now());
        frames.add(start, 0.004, true);
        frames.add(start + Duration::from_millis(10), 0.004, false);
        frames.add(start + Duration::from_secs(60), 0.004, false);
        let times: Vec<f32> = frames.times().collect();
        assert_eq!(times.len(), 3);
        assert!((times[1] - 0.010).abs() < 1e-6 && times[2] == 0.004, "a pause is no slow frame: {times:?}");
        assert_eq!(frames.median(), 0.004);
        (0..500).for_each(|_| frames.add(start, 0.001, false));
        assert_eq!(frames.times().len(), REMEMBERED);
    }
}
