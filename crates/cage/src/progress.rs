//! Telling how far the reading of a file is, and ending it early.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What is being done while a file becomes a cage, in this order; stages that a file does not need are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ReadStage {
    /// Bytes are fetched; counted in bytes.
    Fetch,
    /// Bytes become vertices and faces; counted in bytes of the file, in faces for glTF.
    Parse,
    /// Triangles become polygons again; counted in triangles.
    Polygons,
    /// The mesh is repaired; counted in steps.
    Repair,
    /// Faces find their neighbours; counted in steps.
    Topology,
    /// Edges that stand out become creases; counted in edges.
    Creases,
}

impl ReadStage {
    /// What is being done, in a word or two for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fetch | Self::Parse => "reading",
            Self::Polygons => "finding polygons",
            Self::Repair => "repairing",
            Self::Topology => "joining faces",
            Self::Creases => "finding creases",
        }
    }
}

/// How far the reading of a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadProgress {
    /// What is being done.
    pub stage: ReadStage,
    /// The part of it that is done, in units of the stage; rises, unless the stage begins again.
    pub done: u64,
    /// All of it; 0 where that is not known, as for a pipe.
    pub total: u64,
}

/// Who is told while a file is read, and may end that: with [`ControlFlow::Break`] reading ends in
/// [`ReadError::Cancelled`](crate::ReadError::Cancelled).
///
/// It is told at the start of each stage, then at most 20 times a second, by one thread at a time. In between lie a few thousand
/// elements, or one sort of all of them; the JSON of a glTF file is parsed at once. Two observers are equal if one is a clone of
/// the other.
#[derive(Clone)]
pub struct ReadObserver(Arc<dyn Fn(ReadProgress) -> ControlFlow<()> + Send + Sync>);

impl ReadObserver {
    /// Calls `observe`, from any thread.
    pub fn new(observe: impl Fn(ReadProgress) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        Self(Arc::new(observe))
    }
}

impl fmt::Debug for ReadObserver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ReadObserver")
    }
}

impl PartialEq for ReadObserver {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The observer wants no more of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cancelled;

/// Units of work between looks at the clock, and the time between calls. Unit tests see every step of tiny meshes.
const GRAIN: u64 = if cfg!(test) { 2 } else { 4096 };
const PERIOD: Duration = if cfg!(test) { Duration::ZERO } else { Duration::from_millis(50) };

/// One stage under the eyes of an observer; without one it costs next to nothing.
#[derive(Debug)]
pub(crate) struct Watch {
    observer: Option<ReadObserver>,
    stage: ReadStage,
    total: u64,
    done: AtomicU64,
    /// When the observer was called last.
    last: Mutex<Instant>,
    cancelled: AtomicBool,
}

impl Watch {
    /// Begins a stage of `total` units.
    pub(crate) fn new(observer: Option<&ReadObserver>, stage: ReadStage, total: u64) -> Result<Self, Cancelled> {
        let watch = Self {
            observer: observer.cloned(),
            stage,
            total,
            done: AtomicU64::new(0),
            last: Mutex::new(Instant::now()),
            cancelled: AtomicBool::new(false),
        };
        watch.tell()?;
        Ok(watch)
    }

    /// A watch that nobody keeps.
    pub(crate) fn nobody() -> Self {
        Self {
            observer: None,
            stage: ReadStage::Parse,
            total: 0,
            done: AtomicU64::new(0),
            last: Mutex::new(Instant::now()),
            cancelled: AtomicBool::new(false),
        }
    }

    /// The units of the stage.
    pub(crate) fn total(&self) -> u64 {
        self.total
    }

    /// Counts `units` more as done.
    pub(crate) fn advance(&self, units: u64) -> Result<(), Cancelled> {
        if self.observer.is_none() {
            return Ok(());
        }
        let before = self.done.fetch_add(units, Ordering::Relaxed);
        self.passed(before, before + units)
    }

    /// Counts `done` units as done, from the start.
    pub(crate) fn reach(&self, done: u64) -> Result<(), Cancelled> {
        if self.observer.is_none() {
            return Ok(());
        }
        let before = self.done.swap(done, Ordering::Relaxed);
        self.passed(before, done)
    }

    /// Counts a unit for each turn of a loop over indices from 0, also one that runs in parallel: at every few thousandth.
    pub(crate) fn at(&self, index: u32) -> Result<(), Cancelled> {
        if u64::from(index).is_multiple_of(GRAIN) { self.advance(GRAIN) } else { Ok(()) }
    }

    /// A sign of life at turn `turn` of a loop whose length says nothing about how much is done.
    pub(crate) fn pulse(&self, turn: u64) -> Result<(), Cancelled> {
        if self.observer.is_some() && turn.is_multiple_of(GRAIN) { self.look() } else { Ok(()) }
    }

    /// Looks whether the work has been ended.
    pub(crate) fn check(&self) -> Result<(), Cancelled> {
        if self.cancelled.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }

    fn passed(&self, before: u64, after: u64) -> Result<(), Cancelled> {
        if before / GRAIN == after / GRAIN { Ok(()) } else { self.look() }
    }

    /// Looks at the clock, and tells the observer if it is time to.
    pub(crate) fn look(&self) -> Result<(), Cancelled> {
        self.check()?;
        // Who finds another thread there has nothing to add.
        let Ok(mut last) = self.last.try_lock() else { return Ok(()) };
        self.check()?;
        if last.elapsed() < PERIOD {
            return Ok(());
        }
        let told = self.tell();
        *last = Instant::now();
        told
    }

    fn tell(&self) -> Result<(), Cancelled> {
        let Some(ReadObserver(observe)) = &self.observer else { return Ok(()) };
        let done = self.done.load(Ordering::Relaxed);
        let done = if self.total > 0 { done.min(self.total) } else { done };
        if observe(ReadProgress { stage: self.stage, done, total: self.total }).is_break() {
            self.cancelled.store(true, Ordering::Relaxed);
        }
        self.check()
    }
}

#[cfg(test)]
mod tests;
