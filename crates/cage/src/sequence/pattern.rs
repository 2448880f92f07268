//! Names of numbered files: `walk_####.obj`, `walk_%04d.obj`.

use std::path::{Path, PathBuf};

use super::SequenceError;
use crate::ReadError;

/// A name with a place for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    folder: PathBuf,
    before: String,
    after: String,
    /// The number has at least that many digits, filled up with zeros.
    digits: usize,
}

/// A file of a sequence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Numbered {
    pub(super) number: u64,
    pub(super) file: PathBuf,
}

impl Pattern {
    /// The pattern in the name of a file, if it has a place for a number; not in those of folders.
    pub(super) fn parse(path: &Path) -> Result<Option<Self>, SequenceError> {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return Ok(None) };
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let Some((before, digits, after)) = place(name) else { return Ok(None) };
        if place(after).is_some() {
            return Err(SequenceError::SeveralPlaces);
        }
        Ok(Some(Self { folder, before: before.into(), after: after.into(), digits }))
    }

    /// The name of a file without its folder.
    fn name(&self, number: u64) -> String {
        let Self { before, after, digits, .. } = self;
        format!("{before}{number:0digits$}{after}")
    }

    /// All files that are there, by rising numbers, of which none may be missing.
    pub(super) fn files(&self) -> Result<Vec<Numbered>, ReadError> {
        let folder = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let io = |error| ReadError::Io { file: folder.into(), error };
        let mut files = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(io)? {
            let name = entry.map_err(io)?.file_name();
            if let Some(number) = name.to_str().and_then(|name| self.number(name)) {
                files.push(Numbered { number, file: self.folder.join(name) });
            }
        }
        files.sort_by_key(|file| file.number);
        let (Some(first), Some(last)) = (files.first(), files.last()) else {
            return Err(self.refuse(SequenceError::NoFiles));
        };
        let (first, last) = (first.number, last.number);
        match (first..).zip(&files).find(|(due, file)| *due != file.number) {
            Some((number, _)) => Err(self.refuse(SequenceError::Missing { number, first, last })),
            None => Ok(files),
        }
    }

    /// The number of a file, if its name is what the number would be written as.
    fn number(&self, name: &str) -> Option<u64> {
        let digits = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        let number = digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok())??;
        (self.name(number) == name).then_some(number)
    }

    fn refuse(&self, error: SequenceError) -> ReadError {
        let missing = match error {
            SequenceError::Missing { number, .. } => self.name(number),
            _ => format!("{}{}{}", self.before, "#".repeat(self.digits.max(1)), self.after),
        };
        ReadError::Sequence { file: self.folder.join(missing).display().to_string(), error }
    }
}

/// What is before the first place for a number, how many digits that has, and what comes after it.
fn place(name: &str) -> Option<(&str, usize, &str)> {
    let at = name.bytes().enumerate().find_map(|(at, byte)| match byte {
        b'#' => Some((at, name[at..].bytes().take_while(|&byte| byte == b'#').count(), None)),
        b'%' => printf(&name[at + 1..]).map(|(digits, length)| (at, length + 1, Some(digits))),
        _ => None,
    });
    let (at, length, digits) = at?;
    Some((&name[..at], digits.unwrap_or(length), &name[at + length..]))
}

/// The digits of `d` or `04d`, and the length of that text.
fn printf(text: &str) -> Option<(usize, usize)> {
    const MOST_DIGITS: usize = 20;
    let (width, _) = text.split_once('d')?;
    let digits = match width.strip_prefix('0') {
        None if width.is_empty() => 0,
        Some(digits) if digits.bytes().all(|byte| byte.is_ascii_digit()) => digits.parse().ok()?,
        _ => return None,
    };
    (digits <= MOST_DIGITS).then_some((digits, width.len() + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(name: &str) -> Pattern {
        Pattern::parse(Path::new(name)).expect("one place").expect("a place")
    }

    #[test]
    fn both_ways_to_write_a_place() {
        let p = pattern("a/walk_####.obj");
        assert_eq!(p, pattern("a/walk_%04d.obj"));
        assert_eq!((p.name(7), p.name(12345)), ("walk_0007.obj".into(), "walk_12345.obj".into()));
        assert_eq!(pattern("%d.obj").name(7), "7.obj");
        assert_eq!(pattern("50%_#.obj").name(7), "50%_7.obj");
        for name in ["walk.obj", "100%.obj", "%4d.obj", "%s.obj", "%0xd.obj", "%099999999999d.obj", "a#/b.obj"] {
            assert_eq!(Pattern::parse(Path::new(name)), Ok(None), "{name}");
        }
        assert_eq!(Pattern::parse(Path::new("a_#_#.obj")), Err(SequenceError::SeveralPlaces));
    }

    #[test]
    fn numbers_are_those_that_are_written_so() {
        let p = pattern("a_##.obj");
        let number = |name: &str| p.number(name);
        assert_eq!(["a_01.obj", "a_10.obj", "a_123.obj"].map(number), [Some(1), Some(10), Some(123)]);
        for name in ["a_1.obj", "a_012.obj", "a_.obj", "a_-1.obj", "a_+1.obj", "b_01.obj", "a_01.ply"] {
            assert_eq!(number(name), None, "{name}");
        }
        assert_eq!(number("a_99999999999999999999999.obj"), None);
    }
}
