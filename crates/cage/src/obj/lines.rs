//! Splitting a text into logical lines.

use std::borrow::Cow;

use crate::text::PhysicalLines;

/// Logical lines with the number, from 1, of the physical line they start in. A backslash at the end joins the next line, except
/// in a comment, where it is more likely a path.
pub(super) struct Lines<'a>(PhysicalLines<'a>);

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self(PhysicalLines::new(text))
    }

    /// How many bytes are left.
    pub(super) fn left(&self) -> usize {
        self.0.left()
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u32, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let (number, line) = self.0.next()?;
        let mut line = Cow::Borrowed(line);
        let comment = line.trim_ascii_start().starts_with(b"#");
        while !comment && line.ends_with(b"\\") {
            let joined = line.to_mut();
            joined.pop();
            let Some((_, continued)) = self.0.next() else { break };
            joined.push(b' ');
            joined.extend_from_slice(continued);
        }
        Some((number, line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<(u32, String)> {
        Lines::new(text.as_bytes()).map(|(n, line)| (n, String::from_utf8_lossy(&line).into_owned())).collect()
    }

    fn line(number: u32, text: &str) -> (u32, String) {
        (number, text.into())
    }

    #[test]
    fn all_line_ends() {
        let expected = [line(1, "a"), line(2, ""), line(3, "b"), line(4, "c")];
        for text in ["a\n\nb\nc", "a\r\n\r\nb\r\nc\r\n", "a\r\rb\rc\r"] {
            assert_eq!(lines(text), expected, "{text:?}");
        }
    }

    #[test]
    fn byte_order_mark_is_dropped() {
        assert_eq!(lines("\u{FEFF}v 1"), [line(1, "v 1")]);
    }

    #[test]
    fn continuations_keep_the_first_number() {
        assert_eq!(lines("f 1\\\r\n2 \\\n3\nnext"), [line(1, "f 1 2  3"), line(4, "next")]);
    }

    #[test]
    fn continuation_at_the_end_of_the_text() {
        assert_eq!(lines("f 1 2 3\\"), [line(1, "f 1 2 3")]);
        assert_eq!(lines("f 1 2 3\\\n"), [line(1, "f 1 2 3")]);
    }

    #[test]
    fn comments_are_not_continued() {
        assert_eq!(lines(" # C:\\models\\\nv 1"), [line(1, " # C:\\models\\"), line(2, "v 1")]);
    }
}
