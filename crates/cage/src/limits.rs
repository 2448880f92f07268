//! How much a file may ask for.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::progress::{Cancelled, Watch};
use crate::{ReadDesc, ReadError, ReadObserver, ReadStage};

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

/// Why a reader stops before the end of a file that may be well formed: a limit that it exceeds.
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
    /// Nothing is too large, but the observer has ended the reading.
    #[error("reading was cancelled")]
    Cancelled,
}

impl From<Cancelled> for LimitError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl Limits {
    /// The bytes of a file, of which no more are read than are allowed: a file may grow, and a pipe has no size.
    pub(crate) fn read_file(&self, path: &Path, observer: Option<&ReadObserver>) -> Result<Vec<u8>, ReadError> {
        let beyond = |error| ReadError::Limit { file: path.display().to_string(), error };
        let fault = |error| match error {
            Fault::Io(error) => ReadError::Io { file: path.into(), error },
            Fault::Limit(error) => beyond(error),
        };
        let (file, announced) = open(path).map_err(|error| ReadError::Io { file: path.into(), error })?;
        if announced > self.file_bytes {
            return Err(beyond(LimitError::FileBytes { limit: self.file_bytes }));
        }
        let watch = Watch::new(observer, ReadStage::Fetch, announced).map_err(|end| beyond(end.into()))?;
        read_at_most(file, announced, self.file_bytes, &watch).map_err(fault)
    }
}

/// An open file and its size; 0 for a pipe.
fn open(path: &Path) -> io::Result<(File, u64)> {
    let file = File::open(path)?;
    let size = file.metadata()?.len();
    Ok((file, size))
}

/// Why a file could not be fetched.
#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error(transparent)]
    Io(#[from] io::Error),
    #[error(transparent)]
    Limit(#[from] LimitError),
}

/// All bytes, of which there may be `most`.
fn read_at_most(from: impl Read, expected: u64, most: u64, watch: &Watch) -> Result<Vec<u8>, Fault> {
    const PIECE: u64 = 1 << 20;
    let mut bytes = Vec::with_capacity(usize::try_from(expected).unwrap_or(0).min(1 << 30));
    let mut rest = from.take(most.saturating_add(1));
    while rest.by_ref().take(PIECE).read_to_end(&mut bytes)? > 0 {
        watch.reach(bytes.len() as u64).map_err(LimitError::from)?;
    }
    if bytes.len() as u64 > most { Err(LimitError::FileBytes { limit: most }.into()) } else { Ok(bytes) }
}

/// Counts elements while they are read, and shows the reader's observer that it goes on.
#[derive(Debug)]
pub(crate) struct Gauge {
    limits: Limits,
    faces: u64,
    bytes: u64,
    watch: Watch,
    turns: u64,
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
    /// A gauge for a file with these bytes, which begins the stage in which they are parsed.
    pub(crate) fn new(desc: &ReadDesc, file: &[u8]) -> Result<Self, LimitError> {
        let (limits, size) = (desc.limits, file.len() as u64);
        if size > limits.file_bytes {
            return Err(LimitError::FileBytes { limit: limits.file_bytes });
        }
        let watch = Watch::new(desc.observer.as_ref(), ReadStage::Parse, size)?;
        let mut gauge = Self { limits, faces: 0, bytes: 0, watch, turns: 0 };
        gauge.add(size)?;
        Ok(gauge)
    }

    /// Counts progress in this many faces instead of bytes, where it does not follow the bytes of the file.
    pub(crate) fn expect_faces(&mut self, desc: &ReadDesc, faces: u64) -> Result<(), LimitError> {
        self.watch = Watch::new(desc.observer.as_ref(), ReadStage::Parse, faces)?;
        Ok(())
    }

    /// All but the last `left` bytes of the file have been parsed.
    pub(crate) fn left(&self, left: usize) -> Result<(), LimitError> {
        Ok(self.watch.reach(self.watch.total().saturating_sub(left as u64))?)
    }

    /// That many faces have been parsed.
    pub(crate) fn faces_done(&self) -> Result<(), LimitError> {
        Ok(self.watch.reach(self.faces)?)
    }

    /// Part of an element has been parsed; elements may be of any size.
    pub(crate) fn part(&mut self) -> Result<(), LimitError> {
        self.turns += 1;
        Ok(self.watch.pulse(self.turns)?)
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
        self.part()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_is_read_than_allowed() {
        let nobody = Watch::nobody();
        assert_eq!(read_at_most(&b"abc"[..], 3, 3, &nobody).expect("read"), b"abc");
        let refused = |result: Result<Vec<u8>, Fault>| result.expect_err("too large").to_string();
        assert!(refused(read_at_most(&b"abc"[..], 0, 2, &nobody)).contains("limit of 2 bytes"));
        // A source without end.
        assert!(refused(read_at_most(io::repeat(0), 0, 1000, &nobody)).contains("limit of 1000 bytes"));
    }

    #[test]
    fn faces_and_memory_are_counted() {
        let limits = Limits { faces: 2, memory_bytes: 10 + VERTEX + FACE + 3 * CORNER, ..Limits::default() };
        let desc = |limits| ReadDesc { limits, ..ReadDesc::default() };
        let mut gauge = Gauge::new(&desc(limits), &[0; 10]).expect("small");
        gauge.vertex().expect("fits");
        gauge.face(3).expect("fits");
        assert_eq!(gauge.uv(), Err(LimitError::Memory { limit: limits.memory_bytes }));
        let mut gauge = Gauge::new(&desc(Limits { faces: 1, ..limits }), &[]).expect("small");
        gauge.face(3).expect("fits");
        assert_eq!(gauge.face(3), Err(LimitError::Faces { limit: 1 }));
    }

    #[test]
    fn files_are_measured_before_they_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.obj");
        std::fs::write(&path, "0123456789").expect("written");
        let limits = |file_bytes| Limits { file_bytes, ..Limits::default() };
        assert_eq!(limits(10).read_file(&path, None).expect("read").len(), 10);
        let message = limits(9).read_file(&path, None).expect_err("too large").to_string();
        assert!(
            message.ends_with(
                "a.obj: the file is larger than the limit of 9 bytes; raise the limit if it is to be trusted"
            )
        );
    }
}
