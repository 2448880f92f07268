//! Cages that move: numbered files, or time samples in one file.

mod error;
mod pattern;
#[cfg(test)]
mod tests;

use std::fs::{File, Metadata};
use std::path::{Path, PathBuf};

use glam::DVec3;

pub use error::SequenceError;
use pattern::{Numbered, Pattern};

use crate::draft::Draft;
use crate::limits::Gauge;
use crate::read::Parsed;
use crate::usd::{self, Document};
use crate::{Bounds, Cage, CageError, FileFormat, Listed, ReadDesc, ReadError};

/// The frames of a cage whose faces stay the same while its vertices move.
///
/// The first frame is a whole [`Cage`]. Of the others only positions are of use; they are read when they are asked for, so a sequence
/// takes no more memory than its first frame.
#[derive(Clone, Debug)]
pub struct Sequence {
    cage: Cage,
    frames: Frames,
    /// In seconds.
    times: Vec<f64>,
    /// The faces of the first frame, as its file has them.
    faces: Faces,
    /// For each vertex of the cage its index in the files.
    vertices: Vec<u32>,
    desc: ReadDesc,
}

/// Where frames come from.
#[derive(Clone, Debug)]
enum Frames {
    /// There is one, and it does not move.
    Still(PathBuf),
    /// A file for each.
    Files(Vec<Numbered>),
    /// Time samples in a file, and what tells that it is still the same.
    Samples { document: Box<Document>, file: PathBuf, stamp: Stamp },
}

/// The length of a file and when it was written.
#[derive(Clone, Debug, PartialEq)]
struct Stamp(u64, Option<std::time::SystemTime>);

/// Faces as a file has them, before a repair.
#[derive(Clone, Debug, Default, PartialEq)]
struct Faces {
    vertex_count: usize,
    offsets: Vec<u32>,
    vertices: Vec<u32>,
}

/// A frame as its file has it.
struct Raw {
    positions: Vec<DVec3>,
    faces: Faces,
}

/// The rate of numbered files where nothing is said.
const FRAMES_PER_SECOND: f64 = 24.0;

impl Sequence {
    /// Opens numbered files by a pattern such as `walk_####.obj` or `walk_%04d.obj`, of any [`FileFormat`], or a single file, whose
    /// frames are the times at which a USD file has samples; other files have one frame. An observer is told of the first frame only.
    ///
    /// The numbers are those that are found in the folder, in rising order without a gap. `####` stands for at least four digits, and
    /// `%d` for a number without leading zeros.
    ///
    /// # Errors
    /// As [`Cage::read`] for the first frame; [`ReadError::Sequence`] if no file has such a name or a number is missing.
    pub fn open(path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        let refused = |error| ReadError::Sequence { file: path.display().to_string(), error };
        let pattern = if path.exists() { None } else { Pattern::parse(path).map_err(refused)? };
        let opened = match pattern {
            Some(pattern) => {
                let files = pattern.files()?;
                let times = files.iter().map(|file| file.number as f64 / FRAMES_PER_SECOND).collect();
                let first = files[0].file.clone();
                let bytes = desc.limits.read_file(&first, desc.observer.as_ref());
                bytes.and_then(|bytes| Self::with_first(bytes, &first, desc, Frames::Files(files), times))
            }
            None => Self::open_file(path, desc),
        };
        opened.map_err(|error| error.or_cancelled(path))
    }

    /// True for a pattern, which [`Sequence::open`] reads, and false for the name of a file that is there.
    #[must_use]
    pub fn is_pattern(path: &Path) -> bool {
        !path.exists() && !matches!(Pattern::parse(path), Ok(None))
    }

    /// The same frames with numbered files at that rate, at the time of their number; 24 per second without this. Files with time
    /// samples have a rate of their own.
    #[must_use]
    pub fn with_frames_per_second(mut self, rate: f64) -> Self {
        if let Frames::Files(files) = &self.frames {
            self.times = files.iter().map(|file| file.number as f64 / rate).collect();
        }
        self
    }

    /// The first frame.
    #[must_use]
    pub fn cage(&self) -> &Cage {
        &self.cage
    }

    /// The first frame, by itself.
    #[must_use]
    pub fn into_cage(self) -> Cage {
        self.cage
    }

    /// How many frames there are; at least one.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        self.times.len()
    }

    /// When the frames are, in seconds, rising.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Reads the positions of a frame, counted from 0, in the order of [`Cage::positions`].
    ///
    /// # Errors
    /// A frame that does not exist, cannot be read, or does not have the faces of the first; the error names the file.
    pub fn positions(&self, frame: usize) -> Result<Vec<DVec3>, ReadError> {
        let count = self.frame_count();
        if frame >= count {
            return Err(self.refuse(0, SequenceError::NoSuchFrame { frame, count }));
        }
        if frame == 0 {
            return Ok(self.cage.positions().to_vec());
        }
        let raw = self.raw(frame).map_err(|error| error.or_cancelled(Path::new(&self.name(frame))))?;
        if let Some(difference) = self.faces.difference(&raw.faces, &self.name(0)) {
            return Err(self.refuse(frame, difference));
        }
        let positions: Vec<DVec3> = self.vertices.iter().map(|&v| raw.positions[v as usize]).collect();
        match check(&positions) {
            Ok(()) => Ok(positions),
            Err(error) => Err(ReadError::Refused { file: self.name(frame), line: None, error }),
        }
    }

    /// Positions at a time in seconds, on the straight line between frames; before the first frame and after the last these.
    ///
    /// # Errors
    /// As [`Sequence::positions`], for the frames before and after the time.
    pub fn positions_at(&self, time: f64) -> Result<Vec<DVec3>, ReadError> {
        let after = self.times.partition_point(|&frame| frame <= time);
        let before = after.saturating_sub(1);
        let mut positions = self.positions(before)?;
        let (Some(&next), start) = (self.times.get(after), self.times[before]) else { return Ok(positions) };
        let t = (time - start) / (next - start);
        if t > 0.0 {
            let ends = self.positions(after)?;
            positions.iter_mut().zip(ends).for_each(|(p, end)| *p = p.lerp(end, t));
        }
        Ok(positions)
    }

    fn open_file(path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        let bytes = desc.limits.read_file(path, desc.observer.as_ref())?;
        if FileFormat::of(path, &bytes) != Some(FileFormat::Usd) {
            return Self::with_first(bytes, path, desc, Frames::Still(path.into()), vec![0.0]);
        }
        let name = path.display().to_string();
        let read = || {
            let mut gauge = Gauge::new(desc, &bytes)?;
            let document = Document::read(&bytes, desc.limits, &mut gauge)?;
            let cage = document.cage(&bytes, desc, &mut gauge)?;
            Ok((document, cage))
        };
        let (document, cage) = read().map_err(|error| usd::refusal(error, &name))?;
        drop(bytes);
        let times = document.seconds();
        let cage = Draft { desc: cage, ..Draft::default() }.finish(&name, desc)?;
        let vertices = cage.source_vertices().to_vec();
        let frames = match times.len() {
            0 | 1 => Frames::Still(path.into()),
            _ => Frames::Samples { document: Box::new(document), file: path.into(), stamp: stamp(path)?.1 },
        };
        let times = if times.is_empty() { vec![0.0] } else { times };
        let mut sequence = Self { cage, frames, times, faces: Faces::default(), vertices, desc: unobserved(desc) };
        if sequence.frame_count() > 1 {
            sequence.faces = sequence.raw(0)?.faces;
        }
        Ok(sequence)
    }

    /// A sequence of which the first frame is in the file `first`, which has these bytes.
    fn with_first(
        bytes: Vec<u8>,
        first: &Path,
        desc: &ReadDesc,
        frames: Frames,
        times: Vec<f64>,
    ) -> Result<Self, ReadError> {
        let (cage, faces, vertices) = match Parsed::new(&bytes, first, desc)? {
            Parsed::Draft(draft) => {
                let faces = Faces::of_draft(&draft);
                drop(bytes);
                let cage = draft.finish(&first.display().to_string(), desc)?;
                let vertices = cage.source_vertices().to_vec();
                (cage, faces, vertices)
            }
            Parsed::Cage(cage) => {
                let (faces, vertices) = (Faces::of_cage(&cage), (0..cage.vertex_count() as u32).collect());
                (*cage, faces, vertices)
            }
        };
        Ok(Self { cage, frames, times, faces, vertices, desc: unobserved(desc) })
    }

    fn raw(&self, frame: usize) -> Result<Raw, ReadError> {
        match &self.frames {
            Frames::Still(file) => self.raw_file(file),
            Frames::Files(files) => self.raw_file(&files[frame].file),
            Frames::Samples { document, file, stamp: opened } => {
                let (open, now) = stamp(file)?;
                if now != *opened {
                    return Err(self.refuse(frame, SequenceError::Changed));
                }
                let read = document.frame(frame, open, self.desc.limits);
                let usd::Frame { positions, counts, vertices } =
                    read.map_err(|error| usd::refusal(error, &self.name(frame)))?;
                let mut offsets = vec![0];
                offsets.extend(counts.iter().scan(0_u32, |end, &count| {
                    *end = end.saturating_add(count as u32);
                    Some(*end)
                }));
                let vertex_count = positions.len();
                Ok(Raw { positions, faces: Faces { vertex_count, offsets, vertices } })
            }
        }
    }

    fn raw_file(&self, file: &Path) -> Result<Raw, ReadError> {
        let bytes = self.desc.limits.read_file(file, self.desc.observer.as_ref())?;
        Ok(match Parsed::new(&bytes, file, &self.desc)? {
            Parsed::Draft(draft) => Raw { faces: Faces::of_draft(&draft), positions: draft.desc.positions },
            Parsed::Cage(cage) => Raw { faces: Faces::of_cage(&cage), positions: cage.positions().to_vec() },
        })
    }

    /// The file of a frame, for messages.
    fn name(&self, frame: usize) -> String {
        match &self.frames {
            Frames::Still(file) => file.display().to_string(),
            Frames::Files(files) => files[frame].file.display().to_string(),
            Frames::Samples { file, .. } => format!("{}, {} s", file.display(), self.times[frame]),
        }
    }

    fn refuse(&self, frame: usize, error: SequenceError) -> ReadError {
        ReadError::Sequence { file: self.name(frame), error }
    }
}

impl Faces {
    fn of_draft(Draft { desc, .. }: &Draft) -> Self {
        Self {
            vertex_count: desc.positions.len(),
            offsets: desc.face_offsets.clone(),
            vertices: desc.face_vertices.clone(),
        }
    }

    fn of_cage(cage: &Cage) -> Self {
        Self {
            vertex_count: cage.vertex_count(),
            offsets: cage.face_offsets().to_vec(),
            vertices: cage.face_vertices().to_vec(),
        }
    }

    /// What another frame has that this one, in the file `first`, does not.
    fn difference(&self, other: &Self, first: &str) -> Option<SequenceError> {
        let first = || first.to_string();
        if self.vertex_count != other.vertex_count {
            let (found, due) = (other.vertex_count, self.vertex_count);
            return Some(SequenceError::Vertices { found, due, first: first() });
        }
        if self.offsets.len() != other.offsets.len() {
            let (found, due) = (other.offsets.len().saturating_sub(1), self.offsets.len().saturating_sub(1));
            return Some(SequenceError::Faces { found, due, first: first() });
        }
        if self == other {
            return None;
        }
        let faces = || (0..self.offsets.len().saturating_sub(1)).map(|f| (f, self.face(f), other.face(f)));
        let (face, ..) = faces().find(|(_, a, b)| a != b)?;
        Some(SequenceError::Face { face, first: first() })
    }

    fn face(&self, f: usize) -> Option<&[u32]> {
        self.vertices.get(self.offsets[f] as usize..self.offsets[f + 1] as usize)
    }
}

/// The same without the observer, which would otherwise be kept as long as the sequence.
fn unobserved(desc: &ReadDesc) -> ReadDesc {
    ReadDesc { observer: None, ..desc.clone() }
}

/// What a cage checks of its positions.
fn check(positions: &[DVec3]) -> Result<(), CageError> {
    let bad: Listed<u32> = (0..).zip(positions).filter(|(_, p)| !p.is_finite()).map(|(v, _)| v).collect();
    if !bad.is_empty() {
        return Err(CageError::NotFinite(bad));
    }
    let size = Bounds::of(positions).half_diagonal() * 2.0;
    if size > Cage::MAX_SIZE { Err(CageError::TooLarge { size }) } else { Ok(()) }
}

/// An open file, and what tells whether it is the same as before.
fn stamp(path: &Path) -> Result<(File, Stamp), ReadError> {
    let io = |error| ReadError::Io { file: path.into(), error };
    let file = File::open(path).map_err(io)?;
    let metadata: Metadata = file.metadata().map_err(io)?;
    Ok((file, Stamp(metadata.len(), metadata.modified().ok())))
}
