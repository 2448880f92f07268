//! Comparison with an earlier run.

use super::report::{Row, everywhere};
use crate::failure::{Failure, Verdict};
use std::fs;
use std::path::Path;

/// The rows of an earlier run.
pub(super) fn read(file: &Path) -> Result<Vec<Row>, Failure> {
    let text = fs::read_to_string(file)
        .map_err(|error| Failure::unreadable(format_args!("{}: cannot be read: {error}", file.display())))?;
    let row = |(number, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| {
            Failure::unreadable(format_args!("{}:{}: {error}", file.display(), number + 1))
                .with_hint("give a file that bench --json wrote")
        })
    };
    text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).map(row).collect()
}

/// How a configuration has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Change {
    Faster,
    Slower,
    /// Not more than chance explains.
    None,
}

/// Faster or slower is a configuration only if all its rounds are, compared with all earlier ones, by more than `noise`.
fn change(old: &[f64], new: &[f64], noise: f64) -> Change {
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = |times: &[f64]| times.iter().copied().fold(0.0, f64::max);
    if least(new) > greatest(old) * (1.0 + noise) {
        Change::Slower
    } else if greatest(new) * (1.0 + noise) < least(old) {
        Change::Faster
    } else {
        Change::None
    }
}

/// Prints how each configuration has changed; fails if one is slower.
pub(super) fn compare(old: &[Row], new: &[Row], noise: f64) -> Result<Verdict, Failure> {
    let mut pass = true;
    for row in new {
        let name = name(row);
        let Some(before) = old.iter().find(|other| is_same(other, row)) else {
            tracing::warn!("{name}: the earlier run has no such configuration");
            continue;
        };
        if before.origin.device != row.origin.device {
            tracing::warn!("{name}: the earlier run was on {}", before.origin.device);
        }
        let change = change(&before.rounds_ms, &row.rounds_ms, noise);
        pass &= change != Change::Slower;
        let verdict = match change {
            Change::Faster => "faster",
            Change::Slower => "SLOWER",
            Change::None => "within noise",
        };
        let (was, is) = (before.frame_ms.median, row.frame_ms.median);
        let line = format!("{name}: {was:.3} ms to {is:.3} ms, {:.2} times: {verdict}", is / was);
        // Results on stdout stay JSON lines, or a table.
        match change {
            Change::None => tracing::info!("{line}"),
            _ => tracing::warn!("{line}"),
        }
    }
    Ok(Verdict::of(pass))
}

fn name(row: &Row) -> String {
    let moving = if row.animated { ", moving" } else { "" };
    let needed = if row.refine == everywhere() { "" } else { ", refined where needed" };
    format!("{} {} level {} {}{moving}{needed}", row.cage, row.scheme, row.level, row.evaluator)
}

fn is_same(a: &Row, b: &Row) -> bool {
    let key = |row: &Row| {
        let Row { cage, scheme, refine, level, evaluator, animated, culling, size, samples, .. } = row.clone();
        (cage, scheme, refine, level.to_bits(), evaluator, animated, culling, size, samples)
    };
    key(a) == key(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_one_that_chance_does_not_explain() {
        let old = [10.0, 10.5, 11.0];
        assert_eq!(change(&old, &[12.2, 13.0], 0.1), Change::Slower);
        assert_eq!(change(&old, &[12.0, 13.0], 0.1), Change::None, "one round is near the slowest of the earlier ones");
        assert_eq!(change(&old, &[8.0, 9.0], 0.1), Change::Faster);
        assert_eq!(change(&old, &[8.0, 9.2], 0.1), Change::None);
        assert_eq!(change(&old, &[12.2, 13.0], 0.5), Change::None);
    }
}
