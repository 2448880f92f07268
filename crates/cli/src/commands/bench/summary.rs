//! Many times in a few numbers.

use serde::{Deserialize, Serialize};

/// Times in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Summary {
    pub(super) median: f64,
    pub(super) mean: f64,
    pub(super) min: f64,
    pub(super) max: f64,
    /// Nineteen of twenty are no longer.
    pub(super) p95: f64,
}

impl Summary {
    /// The summary of times in seconds; none of no times.
    pub(super) fn of(seconds: &[f64]) -> Option<Self> {
        let mut ms: Vec<f64> = seconds.iter().map(|time| 1e3 * time).collect();
        ms.sort_by(f64::total_cmp);
        let (&min, &max) = ms.first().zip(ms.last())?;
        let mean = ms.iter().sum::<f64>() / ms.len() as f64;
        let rank = (0.95 * ms.len() as f64).ceil() as usize;
        let rounded = |time: f64| (1e6 * time).round() / 1e6;
        Some(Self {
            median: rounded(median_of_sorted(&ms)),
            mean: rounded(mean),
            min: rounded(min),
            max: rounded(max),
            p95: rounded(ms[rank.max(1) - 1]),
        })
    }
}

fn median_of_sorted(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[half] } else { (sorted[half - 1] + sorted[half]) / 2.0 }
}

/// The median of numbers; none of no numbers.
pub(super) fn median(numbers: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = numbers.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    (!sorted.is_empty()).then(|| median_of_sorted(&sorted))
}

/// How many times as long one thing takes as another that was measured in the same rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Ratio {
    /// Median over the rounds.
    pub(super) median: f64,
    /// The round with the least.
    pub(super) low: f64,
    /// The round with the greatest.
    pub(super) high: f64,
}

impl Ratio {
    /// From the medians of rounds.
    pub(super) fn of(rounds: &[f64], reference: &[f64]) -> Option<Self> {
        let rounded = |ratio: f64| (1e4 * ratio).round() / 1e4;
        let mut ratios: Vec<f64> = rounds.iter().zip(reference).map(|(a, b)| rounded(a / b)).collect();
        ratios.sort_by(f64::total_cmp);
        let (&low, &high) = ratios.first().zip(ratios.last())?;
        Some(Self { median: median_of_sorted(&ratios), low, high })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summaries_are_in_milliseconds() {
        let times: Vec<f64> = (1..=20).rev().map(|i| f64::from(i) * 1e-3).collect();
        let found = Summary::of(&times).unwrap();
        assert_eq!(found, Summary { median: 10.5, mean: 10.5, min: 1.0, max: 20.0, p95: 19.0 });
        assert_eq!(Summary::of(&[0.004]).unwrap().p95, 4.0);
        assert_eq!(Summary::of(&[]), None);
    }

    #[test]
    fn ratios_pair_the_rounds() {
        // The machine was twice as slow in the second round: the ratio does not care.
        let found = Ratio::of(&[2.0, 4.2, 1.8], &[1.0, 2.0, 1.0]).unwrap();
        assert_eq!(found, Ratio { median: 2.0, low: 1.8, high: 2.1 });
        assert_eq!(Ratio::of(&[], &[]), None);
        assert_eq!(median([3.0, 1.0, 2.0, 10.0]), Some(2.5));
    }
}
