//! Vertices and faces, line by line.

use glam::{DVec2, DVec3};

use super::OffError;
use super::header::{self, Header, Keyword};
use crate::ReadDesc;
use crate::draft::{Draft, SourceLines};
use crate::limits::Gauge;
use crate::text::{PhysicalLines, float, integer, quoted, words};
use crate::{CageDesc, FaceVarying, NONE, Warning};

/// An error and its line.
type AtLine<T> = Result<T, (u32, OffError)>;

pub(super) fn parse(text: &[u8], desc: &ReadDesc) -> AtLine<Draft> {
    let mut lines = Lines { lines: PhysicalLines::new(text) };
    let gauge = Gauge::new(desc, text).map_err(|error| (1, error.into()))?;
    let header = header::read(&mut lines)?;
    let mut reader = Reader::new(header, gauge, text.len());
    for found in 0..header.vertices {
        let (at, line) = lines.due("vertex", found, header.vertices)?;
        reader.gauge.left(lines.lines.left()).map_err(|error| (at, error.into()))?;
        reader.vertex(line).map_err(|error| (at, error))?;
    }
    for found in 0..header.faces {
        let (at, line) = lines.due("face", found, header.faces)?;
        reader.gauge.left(lines.lines.left()).map_err(|error| (at, error.into()))?;
        reader.face(line, at, desc.repair.is_some()).map_err(|error| (at, error))?;
    }
    Ok(reader.finish(lines.count()))
}

/// Lines with something in them, without their comments.
struct Lines<'a> {
    lines: PhysicalLines<'a>,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u32, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let uncommented = |line: &'a [u8]| line.split(|&b| b == b'#').next().unwrap_or_default().trim_ascii();
        self.lines.by_ref().map(|(number, line)| (number, uncommented(line))).find(|(_, line)| !line.is_empty())
    }
}

impl<'a> Lines<'a> {
    fn due(&mut self, what: &'static str, found: usize, announced: usize) -> AtLine<(u32, &'a [u8])> {
        self.next().ok_or_else(|| (self.lines.last_number(), OffError::Truncated { what, found, announced }))
    }
}

struct Reader {
    keyword: Keyword,
    vertices: usize,
    desc: CageDesc,
    uv: Vec<DVec2>,
    lines: Vec<u32>,
    gauge: Gauge,
}

impl Reader {
    /// Room is made for what a text of that many bytes can hold, whatever the counts say: an element takes at least six.
    fn new(header: Header, gauge: Gauge, bytes: usize) -> Self {
        let room = |announced: usize| announced.min(bytes / 6);
        let mut desc = CageDesc { positions: Vec::with_capacity(room(header.vertices)), ..CageDesc::default() };
        desc.face_offsets.reserve(room(header.faces) + 1);
        desc.face_offsets.push(0);
        Self { keyword: header.keyword, vertices: header.vertices, desc, uv: Vec::new(), lines: Vec::new(), gauge }
    }

    fn vertex(&mut self, line: &[u8]) -> Result<(), OffError> {
        self.gauge.vertex()?;
        if self.desc.positions.len() + 1 >= NONE as usize {
            return Err(OffError::TooMany("vertices"));
        }
        let mut rest = words(line);
        self.desc.positions.push(DVec3::from_array(numbers(&mut rest, 3)?));
        if self.keyword.has_uv {
            self.gauge.uv()?;
            // Colours may have three numbers or four, so texture coordinates are counted from the end.
            let rest: Vec<&[u8]> = rest.collect();
            let needed = 3 + self.keyword.between.min(rest.len().saturating_sub(2)) + 2;
            let tail = rest.len().checked_sub(2).ok_or(OffError::MissingNumbers { needed, found: 3 + rest.len() })?;
            let [u, v] = numbers(&mut rest[tail..].iter().copied(), 2)?;
            self.uv.push(DVec2::new(u, v));
        }
        Ok(())
    }

    fn face(&mut self, line: &[u8], at: u32, keep_small: bool) -> Result<(), OffError> {
        let mut words = words(line);
        let first = words.next().unwrap_or_default();
        let announced = integer(first).filter(|&n| n >= 0).ok_or_else(|| OffError::CornerCount(quoted(first)))?;
        let start = self.desc.face_vertices.len();
        for found in 0..usize::try_from(announced).unwrap_or(usize::MAX) {
            self.gauge.part()?;
            // What follows the corners is a colour.
            let word = words.next().ok_or(OffError::MissingCorners { announced, found })?;
            let index = integer(word).and_then(|i| usize::try_from(i).ok()).filter(|&i| i < self.vertices);
            let index = index.ok_or_else(|| OffError::Index { word: quoted(word), vertices: self.vertices })?;
            self.desc.face_vertices.push(index as u32);
        }
        let end = self.desc.face_vertices.len();
        self.gauge.face(end - start)?;
        if end - start < 3 && !keep_small {
            return Err(OffError::TooFewCorners(end - start));
        }
        let end = u32::try_from(end).ok().filter(|&end| end != NONE).ok_or(OffError::TooMany("face corners"))?;
        self.desc.face_offsets.push(end);
        self.lines.push(at);
        Ok(())
    }

    fn finish(self, left: usize) -> Draft {
        let Self { mut desc, uv, lines, .. } = self;
        if !uv.is_empty() {
            desc.uv = Some(FaceVarying { values: uv, indices: desc.face_vertices.clone() });
        }
        if left > 0 {
            desc.warnings.push(Warning::NotRead { what: "trailing line", count: left });
        }
        Draft { desc, lines: SourceLines { faces: lines, ..SourceLines::default() } }
    }
}

/// Finite numbers, all of which must be there.
fn numbers<'a, const N: usize>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    needed: usize,
) -> Result<[f64; N], OffError> {
    let mut values = [0.0; N];
    for (found, value) in values.iter_mut().enumerate() {
        let word = words.next().ok_or(OffError::MissingNumbers { needed, found })?;
        *value = float(word).ok_or_else(|| OffError::Number(quoted(word)))?;
        if !value.is_finite() {
            return Err(OffError::NotFinite(quoted(word)));
        }
    }
    Ok(values)
}
