//! A bar on stderr for what takes more than a second.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::LazyLock;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// The bars in sight, one line each, where several are at the same time. Draws nothing where stderr is not a terminal.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// A bar that appears once the work has taken a second; never where stderr is not a terminal or the user wants quiet.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// The thread that shows the bar, and the end of work that it waits for.
    waiter: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Progress over `length` units of work, called `what`.
    pub(crate) fn new(quiet: bool, length: u64, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden());
        Self::start(quiet, bar, "{msg} {bar:32} {human_pos}/{human_len} ({eta} left)", what)
    }

    /// Work whose length is not known, called `what`.
    pub(crate) fn waiting(quiet: bool, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        Self::start(quiet, bar, "{spinner} {msg} ({elapsed})", what)
    }

    /// Work in stages, of which [`Self::stage`] tells.
    pub(crate) fn in_stages(quiet: bool) -> Self {
        Self::new(quiet, 0, "")
    }

    /// `done` of `total` units of the stage called `what` are done.
    pub(crate) fn stage(&self, what: &'static str, done: u64, total: u64) {
        if self.bar.message() != what {
            self.bar.set_message(what);
            self.bar.reset_eta();
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
    }

    /// Counts `units` more as done.
    pub(crate) fn advance(&self, units: u64) {
        self.bar.inc(units);
    }

    fn start(quiet: bool, bar: ProgressBar, template: &str, what: &'static str) -> Self {
        bar.set_style(ProgressStyle::with_template(template).expect("the template is a constant that parses"));
        bar.set_message(what);
        let waiter = (!quiet).then(|| {
            let (work, end) = channel::<()>();
            let bar = bar.clone();
            let show = move || {
                if end.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    let bar = BARS.add(bar);
                    bar.enable_steady_tick(Duration::from_millis(100));
                }
            };
            (work, std::thread::spawn(show))
        });
        Self { bar, waiter }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((work, waiter)) = self.waiter.take() {
            drop(work);
            // A bar that could not be shown is no reason to fail.
            let _shown_or_not = waiter.join();
        }
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_follow_each_other() {
        let progress = Progress::in_stages(true);
        for (what, done, total) in [("reading", 0, 50), ("reading", 50, 50), ("repairing", 7, 9)] {
            progress.stage(what, done, total);
            let bar = &progress.bar;
            assert_eq!((&bar.message()[..], bar.position(), bar.length()), (what, done, Some(total)));
        }
    }
}
