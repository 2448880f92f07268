//! The first few of many elements, for messages that stay readable whatever the size of the mesh.

use std::fmt;

/// The first [`Listed::SHOWN`] elements of a collection and how many there were.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed<T> {
    first: Vec<T>,
    total: usize,
}

impl<T> Listed<T> {
    /// How many elements are kept.
    pub const SHOWN: usize = 4;

    /// The elements that are kept, in order.
    #[must_use]
    pub fn first(&self) -> &[T] {
        &self.first
    }

    /// How many elements there were.
    #[must_use]
    pub fn total(&self) -> usize {
        self.total
    }

    /// True if there was no element.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.total == 0
    }

    /// Adds all elements of another list behind these.
    pub(crate) fn append(&mut self, other: Self) {
        self.total += other.total - other.first.len();
        for item in other.first {
            self.push(item);
        }
    }

    /// The list of what `f` makes of each element.
    pub(crate) fn map<U>(&self, f: impl FnMut(&T) -> U) -> Listed<U> {
        Listed { first: self.first.iter().map(f).collect(), total: self.total }
    }

    /// Adds an element; only the first few are kept.
    pub fn push(&mut self, item: T) {
        if self.first.len() < Self::SHOWN {
            self.first.push(item);
        }
        self.total += 1;
    }

    /// The number of elements with the noun for it: `1 edge`, `7 edges`.
    pub(crate) fn count(&self, noun: &str) -> String {
        plural(self.total, noun)
    }
}

impl<T> Default for Listed<T> {
    fn default() -> Self {
        Self { first: Vec::new(), total: 0 }
    }
}

impl<T> FromIterator<T> for Listed<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let mut listed = Self::default();
        items.into_iter().for_each(|item| listed.push(item));
        listed
    }
}

impl<T: fmt::Display> fmt::Display for Listed<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, item) in self.first.iter().enumerate() {
            let separator = if i == 0 { "" } else { ", " };
            write!(f, "{separator}{item}")?;
        }
        match self.total - self.first.len() {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// What elements there are when they count from 0: `the faces are 0 to 11`, `the only face is 0`, `there are no faces`.
pub(crate) fn numbered(n: usize, noun: &str) -> String {
    let name = plural(2, noun).split_off(2);
    match n {
        0 => format!("there are no {name}"),
        1 => format!("the only {noun} is 0"),
        _ => format!("the {name} are 0 to {}", n - 1),
    }
}

/// `1 vertex`, `2 vertices`, `3 faces`: a count with its noun.
pub(crate) fn plural(n: usize, noun: &str) -> String {
    match n {
        1 => format!("1 {noun}"),
        _ => match noun.strip_suffix("vertex") {
            Some(kind) => format!("{n} {kind}vertices"),
            // A word that is its own plural.
            None if noun == "uv" => format!("{n} uv"),
            None if noun.ends_with("mesh") || noun.ends_with("patch") => format!("{n} {noun}es"),
            // "sets of targets", but "edges".
            None => match noun.split_once(" of ") {
                Some((noun, of)) => format!("{n} {noun}s of {of}"),
                None => format!("{n} {noun}s"),
            },
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_are_all_shown() {
        let listed: Listed<u32> = [3, 5].into_iter().collect();
        assert_eq!(listed.to_string(), "3, 5");
        assert_eq!(listed.total(), 2);
    }

    #[test]
    fn many_are_cut() {
        let listed: Listed<u32> = (0..10).collect();
        assert_eq!(listed.to_string(), "0, 1, 2, 3 and 6 more");
        assert_eq!(listed.first(), [0, 1, 2, 3]);
        assert_eq!(listed.count("vertex"), "10 vertices");
    }

    #[test]
    fn counts_agree_with_their_nouns() {
        assert_eq!(plural(1, "vertex"), "1 vertex");
        assert_eq!(plural(0, "edge"), "0 edges");
        assert_eq!(plural(2, "unused vertex"), "2 unused vertices");
    }

    #[test]
    fn ranges_name_their_last_element() {
        assert_eq!(numbered(12, "face"), "the faces are 0 to 11");
        assert_eq!(numbered(1, "vertex"), "the only vertex is 0");
        assert_eq!(numbered(0, "uv"), "there are no uv");
    }
}
