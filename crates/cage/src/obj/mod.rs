//! Wavefront OBJ, with the `t` statements that OpenSubdiv adds for tags.
//!
//! Read are vertices, uv, polygons of any size, objects, groups, smoothing groups, materials and tags; normals mean nothing to a
//! subdivision surface. Indices may run forward, and negative ones count back from the last vertex so far.

mod error;
mod face;
mod ignored;
mod lines;
mod numbers;
mod reader;
mod tags;
#[cfg(test)]
mod tests;
mod write;

pub use error::ObjError;
pub use write::write_obj;

use crate::draft::Draft;
use crate::{Cage, ReadDesc, ReadError};

/// Reads the text of an OBJ file; `name` is the name of the file for messages.
///
/// # Errors
/// [`ReadError::Obj`] for a malformed line, [`ReadError::Refused`] for a mesh that cannot be a cage.
pub fn read_obj(text: &[u8], name: &str) -> Result<Cage, ReadError> {
    let desc = ReadDesc::default();
    draft(text, name, &desc)?.finish(name, &desc)
}

pub(crate) fn draft(text: &[u8], name: &str, desc: &ReadDesc) -> Result<Draft, ReadError> {
    reader::parse(text, desc).map_err(|(line, error)| ReadError::Obj { file: name.into(), line, error })
}
