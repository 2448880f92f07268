//! What happens when the command is interrupted: half-written files disappear, then the process ends as it would have. A command
//! that measures keeps what it has measured, and is interrupted after that.

use crate::postponement;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;

/// Cleans up on SIGINT, SIGTERM and SIGHUP, then dies of the same signal, which a shell shows as 130, 143 or 129. The first signal
/// to a command that has postponed it ([`Interruption`](crate::postponement::Interruption)) is only noted.
///
/// Signals that the process was started to ignore (`nohup`, jobs in the background of a script) stay ignored.
pub(crate) fn clean_up() {
    let ignored = ignored();
    let heeded = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let signals = Signals::new(heeded);
    let wait = |mut signals: Signals| {
        if let Some(signal) = signals.forever().find(|&signal| !postponement::note(signal)) {
            osculate_compare::whole_file::abandon();
            die(signal);
        }
    };
    match signals {
        Ok(signals) => drop(std::thread::spawn(move || wait(signals))),
        Err(error) => tracing::debug!("interruptions may leave temporary files behind: {error}"),
    }
}

/// Ends the process by the signal that was noted, if there was one.
pub(crate) fn conclude() {
    if let Some(signal) = postponement::noted() {
        die(signal);
    }
}

fn die(signal: i32) -> ! {
    let _still_alive = emulate_default_handler(signal);
    std::process::exit(128 + signal)
}

/// The signals that are ignored, signal n as bit n - 1. Where the system does not tell in a file, none.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ignored_in(&status).unwrap_or(0)
}

fn ignored_in(status: &str) -> Option<u64> {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_read() {
        assert_eq!(ignored_in("SigBlk:\t0000000000000000\nSigIgn:\t0000000000001001\n"), Some(0x1001));
        assert_eq!(ignored_in("Name:\tx\n"), None);
    }
}
