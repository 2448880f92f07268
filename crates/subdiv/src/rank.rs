//! A set of numbers that tells how many of its members lie below another.

use rayon::prelude::*;

/// A set as bits, with the count of members before each word of 64.
pub(crate) struct RankedSet {
    words: Vec<u64>,
    before: Vec<u32>,
    count: u32,
}

impl RankedSet {
    /// The members are the bits set, number `n` bit `n % 64` of word `n / 64`.
    pub(crate) fn new(words: Vec<u64>) -> Self {
        let mut count = 0;
        let before = words
            .iter()
            .map(|word| {
                let before = count;
                count += word.count_ones();
                before
            })
            .collect();
        Self { words, before, count }
    }

    /// The numbers below `count` that are members by `is_member`.
    pub(crate) fn of(count: usize, is_member: impl Fn(u32) -> bool + Sync) -> Self {
        let bits = |word: usize| 64 * word..count.min(64 * word + 64);
        let word = |word| bits(word).fold(0, |bits, n| bits | u64::from(is_member(n as u32)) << (n % 64));
        Self::new((0..count.div_ceil(64)).into_par_iter().with_min_len(64).map(word).collect())
    }

    /// Number of members.
    pub(crate) fn len(&self) -> usize {
        self.count as usize
    }

    pub(crate) fn contains(&self, n: u32) -> bool {
        self.words[(n / 64) as usize] >> (n % 64) & 1 == 1
    }

    /// How many members are less than `n`, which must be within the words.
    pub(crate) fn rank(&self, n: u32) -> u32 {
        let below = self.words[(n / 64) as usize] & ((1 << (n % 64)) - 1);
        self.before[(n / 64) as usize] + below.count_ones()
    }

    /// The members, ascending.
    pub(crate) fn members(&self) -> Vec<u32> {
        let mut members = Vec::with_capacity(self.len());
        for (i, &word) in self.words.iter().enumerate() {
            let mut rest = word;
            while rest != 0 {
                members.push(64 * i as u32 + rest.trailing_zeros());
                rest &= rest - 1;
            }
        }
        members
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_count_the_members_below() {
        for words in [vec![], vec![0], vec![1 << 63, 5, 0, u64::MAX, 0x0123_4567_89ab_cdef]] {
            let is_member = |n: &u32| words[(n / 64) as usize].to_le_bytes()[(n / 8 % 8) as usize] & 1 << (n % 8) != 0;
            let members: Vec<u32> = (0..64 * words.len() as u32).filter(is_member).collect();
            let set = RankedSet::new(words.clone());
            assert_eq!(set.members(), members);
            assert_eq!(set.len(), members.len());
            for n in 0..64 * words.len() as u32 {
                assert_eq!(set.contains(n), members.contains(&n), "{n}");
                assert_eq!(set.rank(n) as usize, members.partition_point(|&m| m < n), "{n}");
            }
        }
    }
}
