//! Object File Format (OFF) of Geomview, as text: `OFF` with the prefixes `ST`, `C` and `N`, with or without the keyword.
//!
//! Read are vertices, polygons and, with `ST`, texture coordinates; normals and colours mean nothing to a cage. Each vertex and
//! each face is one line; comments start with `#`.

mod error;
mod header;
mod reader;
#[cfg(test)]
mod tests;

pub use error::OffError;
pub(crate) use header::is_keyword;

use crate::draft::Draft;
use crate::{Cage, ReadDesc, ReadError};

/// Reads the text of an OFF file; `name` is the name of the file for messages.
///
/// # Errors
/// [`ReadError::Off`] for a malformed line, [`ReadError::Refused`] for a mesh that cannot be a cage.
pub fn read_off(text: &[u8], name: &str) -> Result<Cage, ReadError> {
    let desc = ReadDesc::default();
    draft(text, name, &desc)?.finish(name, &desc)
}

pub(crate) fn draft(text: &[u8], name: &str, desc: &ReadDesc) -> Result<Draft, ReadError> {
    reader::parse(text, desc).map_err(|(line, error)| ReadError::Off { file: name.into(), line, error })
}
