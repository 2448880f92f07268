//! Lines, words and numbers of text formats.

/// The physical lines of a text with their numbers, from 1. Lines end with LF, CR LF or CR, and a byte order mark is dropped.
pub(crate) struct PhysicalLines<'a> {
    rest: &'a [u8],
    next_number: u32,
}

impl<'a> PhysicalLines<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self { rest: text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text), next_number: 1 }
    }

    /// How many bytes are left.
    pub(crate) fn left(&self) -> usize {
        self.rest.len()
    }

    /// The number of the line that came last; 1 before the first.
    pub(crate) fn last_number(&self) -> u32 {
        self.next_number.saturating_sub(1).max(1)
    }
}

impl<'a> Iterator for PhysicalLines<'a> {
    type Item = (u32, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let number = self.next_number;
        self.next_number = number.saturating_add(1);
        let end = self.rest.iter().position(|&b| matches!(b, b'\n' | b'\r'));
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
        Some((number, line))
    }
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word for a message; long ones are cut.
pub(crate) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    excerpt(&String::from_utf8_lossy(word), LONGEST)
}

/// The first characters of a text, as part of a message in one line: what a terminal would obey is replaced.
pub(crate) fn excerpt(text: &str, longest: usize) -> String {
    let printable = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let mut excerpt: String = text.chars().take(longest).map(printable).collect();
    if text.chars().nth(longest).is_some() {
        excerpt += "...";
    }
    excerpt
}

/// A number, which may be infinite or not a number.
pub(crate) fn float(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A decimal integer with an optional sign; `None` if it is none or does not fit.
pub(crate) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() {
        return None;
    }
    let value = digits.iter().try_fold(0_i64, |value, digit| {
        if !digit.is_ascii_digit() {
            return None;
        }
        value.checked_mul(10)?.checked_add(i64::from(digit - b'0'))
    })?;
    Some(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_line_ends() {
        for text in ["a\n\nb\nc", "a\r\n\r\nb\r\nc\r\n", "a\r\rb\rc\r", "\u{FEFF}a\n\nb\nc"] {
            let lines: Vec<_> = PhysicalLines::new(text.as_bytes()).collect();
            assert_eq!(lines, [(1, &b"a"[..]), (2, b""), (3, b"b"), (4, b"c")], "{text:?}");
        }
    }

    #[test]
    fn integers() {
        assert_eq!(integer(b"12"), Some(12));
        assert_eq!(integer(b"+12"), Some(12));
        assert_eq!(integer(b"-7"), Some(-7));
        assert_eq!(integer(b"9223372036854775807"), Some(i64::MAX));
        for bad in ["", "-", "1.5", "0x1", "--1", "9223372036854775808", "1 "] {
            assert_eq!(integer(bad.as_bytes()), None, "{bad:?}");
        }
    }

    #[test]
    fn long_words_are_cut_in_messages() {
        assert_eq!(quoted(&[b'x'; 100]), format!("{}...", "x".repeat(40)));
        assert_eq!(quoted(&[b'x'; 40]), "x".repeat(40));
    }

    #[test]
    fn no_word_breaks_the_line_of_a_message() {
        assert_eq!(quoted(b"a\x1b[2J\x7fb\xff"), "a\u{fffd}[2J\u{fffd}b\u{fffd}");
    }
}
