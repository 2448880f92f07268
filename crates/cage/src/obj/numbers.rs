//! Words and numbers of a line.

use super::ObjError;

/// The words of a statement up to a comment.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).take_while(|word| word[0] != b'#')
}

/// A word for a message; long ones are cut.
pub(super) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(word);
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.into_owned(),
    }
}

/// A finite number.
pub(super) fn number(word: &[u8]) -> Result<f64, ObjError> {
    let parsed = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
    let value = parsed.ok_or_else(|| ObjError::Number(quoted(word)))?;
    if value.is_finite() { Ok(value) } else { Err(ObjError::NotFinite(quoted(word))) }
}

/// Up to `N` numbers of a statement, of which `needed` must be there; the others are 0. What follows is not looked at: weights
/// and colours of vertices.
pub(super) fn numbers<'a, const N: usize>(
    statement: &'static str,
    needed: usize,
    words: impl Iterator<Item = &'a [u8]>,
) -> Result<[f64; N], ObjError> {
    let mut values = [0.0; N];
    let mut found = 0;
    for (value, word) in values.iter_mut().zip(words) {
        *value = number(word)?;
        found += 1;
    }
    if found < needed { Err(ObjError::MissingNumbers { statement, needed, found }) } else { Ok(values) }
}

/// A decimal integer with an optional sign; `None` if it is none or does not fit.
pub(super) fn integer(word: &[u8]) -> Option<i64> {
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
    fn numbers_are_exact() {
        assert_eq!(number(b"0.1"), Ok(0.1));
        assert_eq!(number(b"-0"), Ok(-0.0));
        assert_eq!(number(b"+1.5E-3"), Ok(1.5e-3));
        assert_eq!(number(b"1e999"), Err(ObjError::NotFinite("1e999".into())));
        assert_eq!(number(b"nan"), Err(ObjError::NotFinite("nan".into())));
        assert_eq!(number(b"1,5"), Err(ObjError::Number("1,5".into())));
        assert_eq!(number(b"\xFF"), Err(ObjError::Number("\u{FFFD}".into())));
    }

    #[test]
    fn long_words_are_cut_in_messages() {
        assert_eq!(quoted(&[b'x'; 100]), format!("{}...", "x".repeat(40)));
    }
}
