//! The corners of an `f` statement.

use super::ObjError;
use crate::NONE;
use crate::text::{integer, quoted};

/// How many vertices and uv there are so far; negative indices count back from there.
#[derive(Clone, Copy)]
pub(super) struct Counts {
    pub(super) vertices: usize,
    pub(super) uv: usize,
}

/// Vertex and uv of a face corner, from 0; [`NONE`] for a corner without uv.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) uv: u32,
}

/// Parses `v`, `v/vt`, `v//vn` or `v/vt/vn`. The index of the normal is read but not checked: normals are not used.
pub(super) fn corner(word: &[u8], counts: Counts) -> Result<Corner, ObjError> {
    let mut parts = word.split(|&b| b == b'/');
    let index = |part: Option<&[u8]>| match part {
        None | Some([]) => Ok(None),
        Some(part) => match integer(part) {
            Some(0) => Err(ObjError::ZeroIndex(quoted(word))),
            Some(index) => Ok(Some(index)),
            None => Err(ObjError::Corner(quoted(word))),
        },
    };
    let vertex = index(parts.next())?.ok_or_else(|| ObjError::Corner(quoted(word)))?;
    let uv = index(parts.next())?;
    index(parts.next())?;
    if parts.next().is_some() {
        return Err(ObjError::Corner(quoted(word)));
    }
    Ok(Corner {
        vertex: resolve("vertex", vertex, counts.vertices)?,
        uv: uv.map_or(Ok(NONE), |uv| resolve("uv", uv, counts.uv))?,
    })
}

/// Makes an index count from 0. Indices beyond the last element may still become valid: faces can precede vertices.
fn resolve(what: &'static str, index: i64, count: usize) -> Result<u32, ObjError> {
    let resolved = if index < 0 { count as i64 + index } else { index - 1 };
    match u32::try_from(resolved) {
        Ok(resolved) if resolved != NONE => Ok(resolved),
        _ => Err(ObjError::OutOfRange { what, index, count }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNTS: Counts = Counts { vertices: 8, uv: 4 };

    fn parse(word: &str) -> Result<Corner, ObjError> {
        corner(word.as_bytes(), COUNTS)
    }

    #[test]
    fn all_forms() {
        assert_eq!(parse("3"), Ok(Corner { vertex: 2, uv: NONE }));
        assert_eq!(parse("3/2"), Ok(Corner { vertex: 2, uv: 1 }));
        assert_eq!(parse("3//9"), Ok(Corner { vertex: 2, uv: NONE }));
        assert_eq!(parse("3/2/9"), Ok(Corner { vertex: 2, uv: 1 }));
        assert_eq!(parse("3/"), Ok(Corner { vertex: 2, uv: NONE }));
        assert_eq!(parse("-1/-4/-1"), Ok(Corner { vertex: 7, uv: 0 }));
        assert_eq!(parse("100"), Ok(Corner { vertex: 99, uv: NONE }), "may be defined later");
    }

    #[test]
    fn malformed() {
        for bad in ["", "/1", "a", "1/b", "1//c", "1/2/3/4", "1.0"] {
            assert_eq!(parse(bad), Err(ObjError::Corner(bad.into())));
        }
        assert_eq!(parse("1/0"), Err(ObjError::ZeroIndex("1/0".into())));
        assert_eq!(parse("-9"), Err(ObjError::OutOfRange { what: "vertex", index: -9, count: 8 }));
        assert_eq!(parse("1/-5"), Err(ObjError::OutOfRange { what: "uv", index: -5, count: 4 }));
        let huge = 1_i64 << 32;
        assert_eq!(parse(&huge.to_string()), Err(ObjError::OutOfRange { what: "vertex", index: huge, count: 8 }));
    }
}
