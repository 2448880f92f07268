//! Polygon File Format (PLY) of Stanford: text, or binary of either byte order.
//!
//! Read are the positions and texture coordinates of `vertex` and the corners and texture coordinates of `face`, whatever their
//! types and whatever stands between them. Other elements and properties are stepped over.

mod error;
mod header;
mod reader;
mod source;
#[cfg(test)]
mod tests;

pub use error::PlyError;

use crate::draft::Draft;
use crate::{Cage, ReadDesc, ReadError};

/// Reads the bytes of a PLY file; `name` is the name of the file for messages.
///
/// # Errors
/// [`ReadError::Ply`] for a malformed file, [`ReadError::Refused`] for a mesh that cannot be a cage.
pub fn read_ply(bytes: &[u8], name: &str) -> Result<Cage, ReadError> {
    let desc = ReadDesc::default();
    draft(bytes, name, &desc)?.finish(name, &desc)
}

pub(crate) fn draft(bytes: &[u8], name: &str, desc: &ReadDesc) -> Result<Draft, ReadError> {
    reader::parse(bytes, desc).map_err(|error| ReadError::Ply { file: name.into(), error })
}
