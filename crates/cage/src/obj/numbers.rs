//! Words and numbers of a line.

use super::ObjError;
use crate::text::{float, quoted};

/// The words of a statement up to a comment.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    crate::text::words(line).take_while(|word| word[0] != b'#')
}

/// A finite number.
pub(super) fn number(word: &[u8]) -> Result<f64, ObjError> {
    let value = float(word).ok_or_else(|| ObjError::Number(quoted(word)))?;
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
