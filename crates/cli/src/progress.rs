//! A bar on stderr for what takes more than a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar that appears once the work has taken a second; never where stderr is not a terminal or the user wants quiet.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    hidden: bool,
    quiet: bool,
}

impl Progress {
    /// Progress over `length` units of work, called `what`.
    pub(crate) fn new(quiet: bool, length: u64, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg} {bar:32} {human_pos}/{human_len} ({eta} left)")
            .expect("the template is a constant that parses");
        bar.set_style(style);
        bar.set_message(what);
        Self { bar, start: Instant::now(), hidden: true, quiet }
    }

    /// Counts `units` more as done.
    pub(crate) fn advance(&mut self, units: u64) {
        self.bar.inc(units);
        if self.hidden && !self.quiet && self.start.elapsed() >= PATIENCE {
            // Draws nothing where stderr is not a terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.hidden = false;
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
