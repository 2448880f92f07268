//! Wavefront OBJ, with the `t` statements that OpenSubdiv adds for tags.
//!
//! Read are vertices, uv, polygons of any size, objects, groups, materials and tags; normals and smoothing groups mean nothing to
//! a subdivision surface. Indices may run forward, and negative ones count back from the last vertex so far.

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

use crate::{Cage, CageError, ReadError, TagError};
use reader::{Parsed, SourceLines};

/// Reads the text of an OBJ file; `name` is the name of the file for messages.
///
/// # Errors
/// [`ReadError::Obj`] for a malformed line, [`ReadError::Refused`] for a mesh that cannot be a cage.
pub fn read_obj(text: &[u8], name: &str) -> Result<Cage, ReadError> {
    let Parsed { desc, lines } =
        reader::parse(text).map_err(|(line, error)| ReadError::Obj { file: name.into(), line, error })?;
    Cage::new(desc).map_err(|error| ReadError::Refused { file: name.into(), line: lines.of(&error), error })
}

impl SourceLines {
    /// The line of the first element that `error` names.
    fn of(&self, error: &CageError) -> Option<u32> {
        let (lines, index) = match error {
            CageError::Topology(error) => (&self.faces, error.face()? as usize),
            CageError::Tag(TagError::NoSuchEdge { index, .. } | TagError::Sharpness { tag: "crease", index, .. }) => {
                (&self.creases, *index)
            }
            CageError::Tag(TagError::NoSuchVertex { index, .. } | TagError::Sharpness { index, .. }) => {
                (&self.corners, *index)
            }
            CageError::Tag(TagError::NoSuchFace { index, .. }) => (&self.holes, *index),
            _ => return None,
        };
        lines.get(index).copied()
    }
}
