//! How much a file may ask for.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::ReadError;

/// The most that reading a file may cost. Nothing is allocated because a header announces it; what is really there counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Size of the file in bytes; 4 GiB by default.
    pub file_bytes: u64,
    /// Number of faces; 100 million by default.
    pub faces: u64,
    /// Memory for the file, the cage and its topology in bytes, estimated from their numbers of elements; 16 GiB by default.
    pub memory_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { file_bytes: 4 << 30, faces: 100_000_000, memory_bytes: 16 << 30 }
    }
}

/// A limit that a file exceeds.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LimitError {
    /// The file is too large.
    #[error("the file is larger than the limit of {limit} bytes; raise the limit if it is to be trusted")]
    FileBytes {
        /// The limit.
        limit: u64,
    },
    /// There are too many faces.
    #[error("more faces than the limit of {limit}; raise the limit or split the model")]
    Faces {
        /// The limit.
        limit: u64,
    },
    /// The cage would be too large.
    #[error("the cage would take more memory than the limit of {limit} bytes; raise the limit or split the model")]
    Memory {
        /// The limit.
        limit: u64,
    },
}

impl Limits {
    /// The bytes of a file, of which no more are read than are allowed: a file may grow, and a pipe has no size.
    pub(crate) fn read_file(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        let io = |error| ReadError::Io { file: path.into(), error };
        let too_large = || ReadError::Limit {
            file: path.display().to_string(),
            error: LimitError::FileBytes { limit: self.file_bytes },
        };
        let file = File::open(path).map_err(io)?;
        let announced = file.metadata().map_err(io)?.len();
        if announced > self.file_bytes {
            return Err(too_large());
        }
        let bytes = read_at_most(file, announced, self.file_bytes).map_err(io)?;
        bytes.ok_or_else(too_large)
    }
}

/// All bytes, or `None` if there are more than `most`.
fn read_at_most(from: impl Read, expected: u64, most: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::with_capacity(usize::try_from(expected).unwrap_or(0).min(1 << 30));
    from.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

/// Counts elements while they are read.
#[derive(Debug)]
pub(crate) struct Gauge {
    limits: Limits,
    faces: u64,
    bytes: u64,
}

/// Bytes of a vertex: the position; the half-edge, the number of faces, the index in the file; a row of the table that pairs
/// half-edges.
const VERTEX: u64 = 24 + 12 + 8;
/// Bytes of a face corner: vertex, uv; origin, face, twin and edge of the half-edge, half an edge; an entry of the table.
const CORNER: u64 = 8 + 18 + 8;
/// Bytes of a face: its row and its line.
const FACE: u64 = 8;
/// Bytes of a pair of texture coordinates.
const UV: u64 = 16;
/// Bytes of a crease, corner or hole and its line.
const TAG: u64 = 16;

impl Gauge {
    /// A gauge for a file of that many bytes.
    pub(crate) fn new(limits: Limits, file: &[u8]) -> Result<Self, LimitError> {
        if file.len() as u64 > limits.file_bytes {
            return Err(LimitError::FileBytes { limit: limits.file_bytes });
        }
        let mut gauge = Self { limits, faces: 0, bytes: 0 };
        gauge.add(file.len() as u64)?;
        Ok(gauge)
    }

    pub(crate) fn vertex(&mut self) -> Result<(), LimitError> {
        self.add(VERTEX)
    }

    pub(crate) fn uv(&mut self) -> Result<(), LimitError> {
        self.add(UV)
    }

    pub(crate) fn tags(&mut self, count: usize) -> Result<(), LimitError> {
        self.add(TAG * count as u64)
    }

    /// A face with that many corners.
    pub(crate) fn face(&mut self, corners: usize) -> Result<(), LimitError> {
        self.faces += 1;
        if self.faces > self.limits.faces {
            return Err(LimitError::Faces { limit: self.limits.faces });
        }
        self.add(FACE + CORNER * corners as u64)
    }

    /// Data beside the text of the file.
    pub(crate) fn bytes(&mut self, bytes: u64) -> Result<(), LimitError> {
        self.add(bytes)
    }

    fn add(&mut self, bytes: u64) -> Result<(), LimitError> {
        self.bytes = self.bytes.saturating_add(bytes);
        if self.bytes > self.limits.memory_bytes {
            return Err(LimitError::Memory { limit: self.limits.memory_bytes });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_is_read_than_allowed() {
        assert_eq!(read_at_most(&b"abc"[..], 3, 3).expect("read"), Some(b"abc".to_vec()));
        assert_eq!(read_at_most(&b"abc"[..], 0, 2).expect("read"), None);
        // A source without end.
        assert_eq!(read_at_most(io::repeat(0), 0, 1000).expect("read"), None);
    }

    #[test]
    fn faces_and_memory_are_counted() {
        let limits = Limits { faces: 2, memory_bytes: 10 + VERTEX + FACE + 3 * CORNER, ..Limits::default() };
        let mut gauge = Gauge::new(limits, &[0; 10]).expect("small");
        gauge.vertex().expect("fits");
        gauge.face(3).expect("fits");
        assert_eq!(gauge.uv(), Err(LimitError::Memory { limit: limits.memory_bytes }));
        let mut gauge = Gauge::new(Limits { faces: 1, ..limits }, &[]).expect("small");
        gauge.face(3).expect("fits");
        assert_eq!(gauge.face(3), Err(LimitError::Faces { limit: 1 }));
    }

    #[test]
    fn files_are_measured_before_they_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.obj");
        std::fs::write(&path, "0123456789").expect("written");
        let limits = |file_bytes| Limits { file_bytes, ..Limits::default() };
        assert_eq!(limits(10).read_file(&path).expect("read").len(), 10);
        let message = limits(9).read_file(&path).expect_err("too large").to_string();
        assert!(
            message.ends_with(
                "a.obj: the file is larger than the limit of 9 bytes; raise the limit if it is to be trusted"
            )
        );
    }
}
