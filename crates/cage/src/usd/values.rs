//! Values, read where they lie when they are needed.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;

use super::binary::{self, Tables, ValueRep};
use super::layer::Attribute;
use super::{UsdError, text};
use crate::{LimitError, Limits};

/// Where a value lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value {
    /// None: it takes away what was said.
    Blocked,
    /// Bytes of a text.
    Text { start: u64, end: u64 },
    /// A representation of the binary form, which may hold the value itself.
    Binary(ValueRep),
}

/// A moment to read attributes at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Time {
    /// What holds without time, or the first sample where there is nothing else.
    Default,
    /// A time in the units of samples.
    Code(f64),
}

/// The bytes of a file: in memory, or read piece by piece.
pub(super) enum Source<'a> {
    Memory(&'a [u8]),
    File { file: RefCell<File>, start: u64, length: u64 },
}

impl<'a> Source<'a> {
    pub(super) fn length(&self) -> u64 {
        match self {
            Self::Memory(bytes) => bytes.len() as u64,
            Self::File { length, .. } => *length,
        }
    }

    /// `None` if not all of them are there.
    pub(super) fn bytes(&self, range: Range<u64>) -> Result<Option<Cow<'a, [u8]>>, UsdError> {
        if range.start > range.end || range.end > self.length() {
            return Ok(None);
        }
        match self {
            Self::Memory(bytes) => Ok(Some(Cow::Borrowed(&bytes[range.start as usize..range.end as usize]))),
            Self::File { file, start, .. } => {
                let mut file = file.borrow_mut();
                let mut bytes = vec![0; (range.end - range.start) as usize];
                let read = file.seek(SeekFrom::Start(start + range.start)).and_then(|_| file.read_exact(&mut bytes));
                read.map_err(|error| UsdError::Io(error.to_string()))?;
                Ok(Some(Cow::Owned(bytes)))
            }
        }
    }
}

/// Reads the values of a file.
pub(super) struct Values<'a> {
    pub(super) source: Source<'a>,
    /// What values of the binary form refer to.
    pub(super) tables: &'a Tables,
    pub(super) budget: Budget,
}

/// How many numbers may still be read: a small file can ask for much by naming a value often.
pub(super) struct Budget {
    left: Cell<u64>,
    limit: LimitError,
}

impl Budget {
    pub(super) fn new(bytes: u64, limits: Limits) -> Self {
        const FREE: u64 = 64 << 20;
        let left = bytes.saturating_mul(16).saturating_add(FREE).min(limits.memory_bytes / size_of::<f64>() as u64);
        Self { left: Cell::new(left), limit: LimitError::Memory { limit: left * size_of::<f64>() as u64 } }
    }

    /// Takes from what is left.
    pub(super) fn take(&self, numbers: u64) -> Result<(), UsdError> {
        let left = self.left.get().checked_sub(numbers).ok_or_else(|| self.limit.clone())?;
        self.left.set(left);
        Ok(())
    }
}

impl<'a> Values<'a> {
    pub(super) fn new(source: Source<'a>, tables: &'a Tables, limits: Limits) -> Self {
        let budget = Budget::new(source.length(), limits);
        Self::with_budget(source, tables, budget)
    }

    /// Goes on with what is left of a budget.
    pub(super) fn with_budget(source: Source<'a>, tables: &'a Tables, budget: Budget) -> Self {
        Self { source, tables, budget }
    }

    /// The numbers of a value that is a tuple of `size` numbers or an array of such tuples.
    pub(super) fn numbers(&self, value: Value, size: usize) -> Result<Vec<f64>, UsdError> {
        match value {
            Value::Blocked => Ok(Vec::new()),
            Value::Text { start, end } => {
                let numbers = text::numbers(&self.text(start..end)?, size).map_err(|error| self.place(error, start))?;
                self.budget.take(numbers.len() as u64)?;
                Ok(numbers)
            }
            Value::Binary(rep) => binary::numbers(&self.source, self.tables, rep, size, &self.budget),
        }
    }

    /// The texts, tokens or paths of a value that is one of them or an array.
    pub(super) fn words(&self, value: Value) -> Result<Vec<String>, UsdError> {
        match value {
            Value::Blocked => Ok(Vec::new()),
            Value::Text { start, end } => {
                text::words(&self.text(start..end)?).map_err(|error| self.place(error, start))
            }
            Value::Binary(rep) => binary::words(&self.source, self.tables, rep, &self.budget),
        }
    }

    fn text(&self, range: Range<u64>) -> Result<Cow<'a, [u8]>, UsdError> {
        self.source.bytes(range)?.ok_or_else(|| UsdError::Io("the file has become shorter".into()))
    }

    /// An error in a value that starts at a byte, with the line in the file instead of that in the value.
    fn place(&self, error: UsdError, start: u64) -> UsdError {
        match (error, self.source.bytes(0..start)) {
            (UsdError::Syntax { line, problem }, Ok(Some(before))) => {
                let lines = before.iter().filter(|&&byte| byte == b'\n').count();
                UsdError::Syntax { line: line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX)), problem }
            }
            (error, _) => error,
        }
    }

    /// The numbers of an attribute at a time, between samples on the line between them; `None` if it has no value then.
    pub(super) fn numbers_at(&self, of: &Attribute, time: Time, size: usize) -> Result<Option<Vec<f64>>, UsdError> {
        let Some((value, next)) = of.at(time) else { return Ok(None) };
        let mut numbers = self.numbers(value, size)?;
        if let Some((value, t)) = next {
            let after = self.numbers(value, size)?;
            if after.len() == numbers.len() {
                numbers.iter_mut().zip(after).for_each(|(a, b)| *a = *a * (1.0 - t) + b * t);
            }
        }
        Ok(Some(numbers))
    }

    /// The integers of an attribute at a time, held between samples; empty if it has no value.
    pub(super) fn integers_at(&self, of: Option<&Attribute>, time: Time) -> Result<Vec<i64>, UsdError> {
        let Some((value, _)) = of.and_then(|attribute| attribute.at(time)) else { return Ok(Vec::new()) };
        // Integers of 32 bits are exact in f64; others are beyond all elements anyway.
        let numbers = self.numbers(value, 1)?;
        match numbers.iter().all(|number| number.fract() == 0.0) {
            true => Ok(numbers.into_iter().map(|number| number as i64).collect()),
            false => Err(UsdError::Type("integers")),
        }
    }

    /// The single text of an attribute that does not change.
    pub(super) fn word(&self, of: Option<&Attribute>) -> Result<Option<String>, UsdError> {
        let Some((value, _)) = of.and_then(|attribute| attribute.at(Time::Default)) else { return Ok(None) };
        Ok(self.words(value)?.into_iter().next())
    }
}

impl Attribute {
    /// The value at a time, and the next sample with how far it is on the way to that.
    fn at(&self, time: Time) -> Option<(Value, Option<(Value, f64)>)> {
        let held = |value: Value| (value != Value::Blocked).then_some((value, None));
        let Time::Code(time) = time else {
            return held(self.default.or_else(|| Some(self.samples.first()?.value))?);
        };
        let after = self.samples.partition_point(|sample| sample.time <= time);
        match (self.samples[..after].last(), self.samples.get(after)) {
            (None, None) => held(self.default?),
            (None, Some(only)) | (Some(only), None) => held(only.value),
            (Some(before), Some(_)) if before.time == time || before.value == Value::Blocked => held(before.value),
            (Some(before), Some(after)) if after.value == Value::Blocked => held(before.value),
            (Some(before), Some(after)) => {
                let t = (time - before.time) / (after.time - before.time);
                Some((before.value, Some((after.value, t))))
            }
        }
    }
}
