//! Universal Scene Description: text (`.usda`), binary (`.usdc`), either of them (`.usd`), and packages (`.usdz`).
//!
//! One file is read, as it is: prims of the type `Mesh` that are drawn become one cage, each where its transforms place it, and a scene
//! with z up is turned so that y is up. Nothing that needs composition is followed (references, payloads, inherits, variants,
//! sub-layers): such files are refused with the name of the prim, and `usdcat --flatten` makes one of them that is read.
//!
//! The reader is our own: of the crate `openusd`, versions up to 0.6 panic or allocate as much as a header claims on malformed files,
//! and later ones need a newer compiler. Section numbers are those of the *USD Core Specification* 1.0.1.

mod binary;
mod error;
mod layer;
mod mesh;
mod package;
mod primvar;
mod scene;
#[cfg(test)]
mod tests;
mod text;
mod transform;
mod values;

use std::cell::RefCell;
use std::fs::File;
use std::ops::Range;

use glam::DVec3;

pub use error::UsdError;

use crate::draft::Draft;
use crate::limits::Gauge;
use crate::{Cage, CageDesc, LimitError, Limits, ReadDesc, ReadError};
use binary::Tables;
use layer::Layer;
use mesh::{Collector, Mesh};
use scene::Scene;
use values::{Source, Time, Values};

/// Reads the bytes of a USD file of any form; `name` is the name of the file for messages. If something moves, the first frame is read.
///
/// # Errors
/// [`ReadError::Usd`] for a malformed file, [`ReadError::Limit`] for one that is too large, [`ReadError::Refused`] for a mesh that
/// cannot be a cage.
pub fn read_usd(bytes: &[u8], name: &str, desc: &ReadDesc) -> Result<Cage, ReadError> {
    draft(bytes, name, desc)?.finish(name, desc)
}

pub(crate) fn draft(bytes: &[u8], name: &str, desc: &ReadDesc) -> Result<Draft, ReadError> {
    let read = || {
        let mut gauge = Gauge::new(desc, bytes)?;
        let document = Document::read(bytes, desc.limits, &mut gauge)?;
        document.cage(bytes, desc, &mut gauge)
    };
    match read() {
        Ok(desc) => Ok(Draft { desc, ..Draft::default() }),
        Err(error) => Err(refusal(error, name)),
    }
}

/// The error of a file.
pub(crate) fn refusal(error: UsdError, name: &str) -> ReadError {
    match error {
        UsdError::Limit(error) => ReadError::Limit { file: name.into(), error },
        error => ReadError::Usd { file: name.into(), error },
    }
}

/// True if a file starts like one of the forms.
pub(crate) fn is_usd(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    text.starts_with(b"#usda") || bytes.starts_with(binary::MAGIC)
}

/// The structure of a file, without its bytes.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    layer: Layer,
    tables: Tables,
    scene: Scene,
    /// Where the scene is: the whole file, or a part of a package.
    place: Range<u64>,
}

/// The points of all meshes at a time and the faces between them, as they follow each other in the cage.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Frame {
    pub(crate) positions: Vec<DVec3>,
    /// The corners of each face.
    pub(crate) counts: Vec<usize>,
    /// The vertex of each corner.
    pub(crate) vertices: Vec<u32>,
}

impl Document {
    pub(crate) fn read(bytes: &[u8], limits: Limits, gauge: &mut Gauge) -> Result<Self, UsdError> {
        let place = if bytes.starts_with(package::MAGIC) { package::first_file(bytes)? } else { 0..bytes.len() };
        let content = &bytes[place.clone()];
        if !is_usd(content) {
            return Err(UsdError::NotUsd);
        }
        let (layer, tables) = if content.starts_with(binary::MAGIC) {
            binary::parse(content, limits, gauge)?
        } else {
            (text::parse(content, gauge)?, Tables::default())
        };
        let scene = Scene::new(&layer, &Values::new(Source::Memory(content), &tables, limits))?;
        Ok(Self { layer, tables, scene, place: place.start as u64..place.end as u64 })
    }

    /// The times of the frames in seconds; none if nothing moves.
    pub(crate) fn seconds(&self) -> Vec<f64> {
        let rate = self.layer.time_codes_per_second();
        self.scene.times.iter().map(|time| time / rate).collect()
    }

    /// The cage at the first frame, given the bytes of the file.
    pub(crate) fn cage(&self, bytes: &[u8], desc: &ReadDesc, gauge: &mut Gauge) -> Result<CageDesc, UsdError> {
        let content = &bytes[self.place.start as usize..self.place.end as usize];
        let values = Values::new(Source::Memory(content), &self.tables, desc.limits);
        let time = self.scene.first();
        let places = self.scene.places(&self.layer, &values, time)?;
        let mut collector = Collector::new(&self.layer, &values, gauge, desc.repair.is_some());
        for (&mesh, place) in self.scene.meshes.iter().zip(&places) {
            collector.add(mesh, place, time)?;
        }
        let mut cage = collector.finish();
        cage.warnings.extend(self.scene.warnings.iter().cloned());
        Ok(cage)
    }

    /// A frame by its number, read from the file that the document was made from.
    pub(crate) fn frame(&self, frame: usize, file: File, limits: Limits) -> Result<Frame, UsdError> {
        let Range { start, end } = self.place;
        let source = Source::File { file: RefCell::new(file), start, length: end - start };
        let values = Values::new(source, &self.tables, limits);
        let time = self.scene.times.get(frame).map_or(Time::Default, |&time| Time::Code(time));
        let places = self.scene.places(&self.layer, &values, time)?;
        let mut all = Frame::default();
        for (&index, place) in self.scene.meshes.iter().zip(&places) {
            let mesh = Mesh { layer: &self.layer, values: &values, index, time };
            let points = mesh.points()?;
            // What mirrors at one time and not at another turns inside out, as it would in the file.
            let faces = mesh.faces(points.len() / 3, false)?;
            let first = all.positions.len() as u32;
            all.positions.extend(scene::placed(&points, place));
            all.counts.extend(faces.counts);
            all.vertices.extend(faces.vertices.iter().map(|v| v + first));
        }
        if all.positions.len() > u32::MAX as usize {
            return Err(LimitError::Memory { limit: limits.memory_bytes }.into());
        }
        Ok(all)
    }
}
