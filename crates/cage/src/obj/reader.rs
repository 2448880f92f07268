//! The statements of an OBJ file, one after the other.

use glam::{DVec2, DVec3};

use super::face::{Corner, Counts, corner};
use super::ignored::{Ignored, reason};
use super::lines::Lines;
use super::numbers::{numbers, words};
use super::{ObjError, tags};
use crate::draft::{Draft, SourceLines};
use crate::face_sets::FaceSets;
use crate::limits::Gauge;
use crate::{CageDesc, FaceSetKind, FaceVarying, NONE, ReadDesc, Tags, Warning};

/// An error and its line.
type AtLine<T> = Result<T, (u32, ObjError)>;

pub(super) fn parse(text: &[u8], desc: &ReadDesc) -> AtLine<Draft> {
    // Binary formats and UTF-16 have zeros soon; all lines would otherwise count as unknown statements.
    if text.iter().take(4096).any(|&byte| byte == 0) {
        return Err((1, ObjError::NotText));
    }
    let gauge = Gauge::new(desc, text).map_err(|error| (1, error.into()))?;
    let mut reader = Reader::new(gauge, desc.repair.is_some());
    let mut lines = Lines::new(text);
    while let Some((number, line)) = lines.next() {
        reader.gauge.left(lines.left()).map_err(|error| (number, error.into()))?;
        reader.statement(&line, number).map_err(|error| (number, error))?;
    }
    reader.finish()
}

struct Reader {
    gauge: Gauge,
    /// Faces with fewer than three corners are left to the repair.
    keep_small: bool,
    positions: Vec<DVec3>,
    uv_values: Vec<DVec2>,
    face_offsets: Vec<u32>,
    face_vertices: Vec<u32>,
    /// One per face corner, [`NONE`] where there is none.
    uv_indices: Vec<u32>,
    tags: Tags,
    sets: FaceSets,
    ignored: Ignored,
    lines: SourceLines,
}

impl Reader {
    fn new(gauge: Gauge, keep_small: bool) -> Self {
        Self {
            gauge,
            keep_small,
            positions: Vec::new(),
            uv_values: Vec::new(),
            face_offsets: vec![0],
            face_vertices: Vec::new(),
            uv_indices: Vec::new(),
            tags: Tags::default(),
            sets: FaceSets::default(),
            ignored: Ignored::default(),
            lines: SourceLines::default(),
        }
    }

    fn statement(&mut self, line: &[u8], at: u32) -> Result<(), ObjError> {
        let mut words = words(line);
        let Some(name) = words.next() else { return Ok(()) };
        match name {
            b"v" => {
                self.gauge.vertex()?;
                self.positions.push(DVec3::from_array(numbers("v", 3, words)?));
            }
            b"vt" => {
                self.gauge.uv()?;
                self.uv_values.push(DVec2::from_array(numbers("vt", 1, words)?));
            }
            // `fo` is how version 2 of the format wrote `f`.
            b"f" | b"fo" => self.face(words, at)?,
            b"g" => self.switch(FaceSetKind::Group, words.map(text)),
            b"o" => self.switch(FaceSetKind::Object, rest(line, name).into_iter()),
            b"usemtl" => self.switch(FaceSetKind::Material, rest(line, name).into_iter()),
            b"s" => self.switch(FaceSetKind::Smoothing, words.take(1).filter(|word| is_smooth(word)).map(text)),
            b"t" => self.tag(&words.collect::<Vec<_>>(), at)?,
            _ => {
                if let Some(reason) = reason(name) {
                    self.ignored.push(name, reason, at);
                }
            }
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, at: u32) -> Result<(), ObjError> {
        let counts = Counts { vertices: self.positions.len(), uv: self.uv_values.len() };
        let start = self.face_vertices.len();
        for word in words {
            self.gauge.part()?;
            let Corner { vertex, uv } = corner(word, counts)?;
            self.face_vertices.push(vertex);
            self.uv_indices.push(uv);
        }
        let end = self.face_vertices.len();
        self.gauge.face(end - start)?;
        if end - start < 3 && !self.keep_small {
            return Err(ObjError::TooFewCorners(end - start));
        }
        let end = u32::try_from(end).ok().filter(|&end| end != NONE).ok_or(ObjError::TooMany("face corners"))?;
        self.face_offsets.push(end);
        self.lines.faces.push(at);
        Ok(())
    }

    fn tag(&mut self, words: &[&[u8]], at: u32) -> Result<(), ObjError> {
        self.gauge.tags(words.len())?;
        if let Some(unknown) = tags::parse(words, at, &mut self.tags, &mut self.lines)? {
            self.ignored.push(&[b"t ", unknown].concat(), "unknown tag", at);
        }
        Ok(())
    }

    fn switch(&mut self, kind: FaceSetKind, names: impl Iterator<Item = String>) {
        self.sets.switch(kind, names, self.lines.faces.len() as u32);
    }

    fn finish(mut self) -> AtLine<Draft> {
        self.check_range("vertex", &self.face_vertices, self.positions.len())?;
        self.check_range("uv", &self.uv_indices, self.uv_values.len())?;
        let mut warnings = std::mem::take(&mut self.ignored).into_warnings();
        if self.lines.faces.is_empty() {
            check_statements(&warnings)?;
        }
        let uv = FaceVarying { values: self.uv_values, indices: self.uv_indices };
        let desc = CageDesc {
            uv: uv.finish(&self.face_offsets, &mut warnings),
            positions: self.positions,
            face_sets: self.sets.finish(self.lines.faces.len() as u32),
            face_offsets: self.face_offsets,
            face_vertices: self.face_vertices,
            tags: self.tags,
            warnings,
            ..CageDesc::default()
        };
        Ok(Draft { desc, lines: self.lines })
    }

    /// Indices may run forward, so the upper end is checked last.
    fn check_range(&self, what: &'static str, indices: &[u32], count: usize) -> AtLine<()> {
        let Some(corner) = indices.iter().position(|&i| i as usize >= count && i != NONE) else { return Ok(()) };
        let face = self.face_offsets.partition_point(|&offset| offset as usize <= corner) - 1;
        let index = i64::from(indices[corner]) + 1;
        Err((self.lines.faces[face], ObjError::OutOfRange { what, index, count }))
    }
}

/// A file without faces that has other statements is likely to be something else.
fn check_statements(warnings: &[Warning]) -> AtLine<()> {
    let statements = warnings.iter().filter_map(|warning| match warning {
        Warning::Statement { name, statements, line, .. } => Some((name, *statements, *line)),
        _ => None,
    });
    let ignored = statements.clone().map(|(_, count, _)| count).sum();
    match statements.min_by_key(|(_, _, line)| *line) {
        Some((first, _, line)) => Err((line, ObjError::NoFaces { ignored, statement: first.clone() })),
        None => Ok(()),
    }
}

/// Whether the argument of `s` names a group; `off` and 0 end the one before.
fn is_smooth(word: &[u8]) -> bool {
    word != b"off" && word.iter().any(|&b| b != b'0')
}

/// Names may be in any encoding.
fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

/// Everything after the first word: names of objects and materials may have blanks.
fn rest(line: &[u8], name: &[u8]) -> Option<String> {
    let rest = line.trim_ascii_start()[name.len()..].trim_ascii();
    (!rest.is_empty()).then(|| text(rest))
}
