//! The keyword and the counts.

use super::OffError;
use crate::text::{integer, words};

/// What the keyword says of the vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Keyword {
    /// Numbers between the position and the texture coordinates.
    pub(super) between: usize,
    pub(super) has_uv: bool,
}

/// True if the word is a keyword of the format, read or not.
pub(crate) fn is_keyword(word: &[u8]) -> bool {
    keyword(word).is_some()
}

/// Splits `[ST][C][N][4][n]OFF`.
fn keyword(word: &[u8]) -> Option<Result<Keyword, OffError>> {
    let prefixes = word.strip_suffix(b"OFF")?;
    let (has_uv, rest) = prefixes.strip_prefix(b"ST").map_or((false, prefixes), |rest| (true, rest));
    let (colours, rest) = rest.strip_prefix(b"C").map_or((0, rest), |rest| (4, rest));
    let (normals, rest) = rest.strip_prefix(b"N").map_or((0, rest), |rest| (3, rest));
    match rest {
        b"" => Some(Ok(Keyword { between: colours + normals, has_uv })),
        b"4" | b"n" | b"4n" => Some(Err(OffError::Variant("OFF with other than three coordinates"))),
        _ => None,
    }
}

/// A header with the counts of vertices and faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) keyword: Keyword,
    pub(super) vertices: usize,
    pub(super) faces: usize,
}

/// Reads the header from lines without comments. The keyword may be missing, and the counts may stand behind it.
pub(super) fn read<'a>(lines: &mut impl Iterator<Item = (u32, &'a [u8])>) -> Result<Header, (u32, OffError)> {
    let (number, line) = lines.next().ok_or((1, OffError::NotOff))?;
    let mut rest: Vec<&[u8]> = words(line).collect();
    let Some(found) = keyword(rest[0]) else {
        let counts = counts(&rest).filter(|_| rest.len() <= 3).ok_or((number, OffError::NotOff))?;
        return Ok(Header { keyword: Keyword::default(), vertices: counts[0], faces: counts[1] });
    };
    let keyword = found.map_err(|error| (number, error))?;
    rest.remove(0);
    if rest.first() == Some(&&b"BINARY"[..]) {
        return Err((number, OffError::Variant("binary OFF")));
    }
    let mut at = number;
    if rest.is_empty() {
        let (number, line) = lines.next().ok_or((at, OffError::Counts))?;
        (at, rest) = (number, words(line).collect());
    }
    let counts = counts(&rest).ok_or((at, OffError::Counts))?;
    Ok(Header { keyword, vertices: counts[0], faces: counts[1] })
}

/// The numbers of vertices and faces; the number of edges is not looked at, and often wrong or missing.
fn counts(words: &[&[u8]]) -> Option<[usize; 2]> {
    let count = |word: &[u8]| integer(word).and_then(|n| usize::try_from(n).ok());
    Some([count(words.first()?)?, count(words.get(1)?)?])
}
