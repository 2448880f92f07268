//! Interruptions that wait until a command has put its results in a safe place.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// Whether the command wants to be told before it is interrupted.
static POSTPONED: AtomicBool = AtomicBool::new(false);
/// The signal that came meanwhile, or 0.
static SIGNAL: AtomicI32 = AtomicI32::new(0);

/// A command's view of what is to interrupt it.
pub(crate) struct Interruption {
    is_requested: fn() -> bool,
}

impl Interruption {
    /// From now on the first signal is only noted: the command looks for it, and ends soon after. A second one ends the process.
    pub(crate) fn postpone() -> Self {
        POSTPONED.store(true, Ordering::Relaxed);
        Self { is_requested: || noted().is_some() }
    }

    /// Whether the command should come to its end.
    pub(crate) fn is_requested(&self) -> bool {
        (self.is_requested)()
    }

    /// One that never comes.
    #[cfg(test)]
    pub(crate) fn never() -> Self {
        Self { is_requested: || false }
    }

    /// One that has come.
    #[cfg(test)]
    pub(crate) fn requested() -> Self {
        Self { is_requested: || true }
    }
}

/// Takes note of a signal; false if it is to end the process at once.
#[cfg_attr(not(unix), allow(dead_code, reason = "signals are those of unix"))]
pub(crate) fn note(signal: i32) -> bool {
    POSTPONED.load(Ordering::Relaxed)
        && SIGNAL.compare_exchange(0, signal, Ordering::Relaxed, Ordering::Relaxed).is_ok()
}

/// The signal that was noted.
pub(crate) fn noted() -> Option<i32> {
    Some(SIGNAL.load(Ordering::Relaxed)).filter(|&signal| signal != 0)
}
