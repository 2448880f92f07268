//! What a reader found, on its way to a cage.

use crate::{Cage, CageDesc, CageError, ReadDesc, ReadError, TagError, repair};

/// What a file holds, before it is known to be a cage.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) desc: CageDesc,
    pub(crate) lines: SourceLines,
}

/// The lines of elements, from 1, for messages about the mesh as a whole; empty where a file has no lines.
#[derive(Default)]
pub(crate) struct SourceLines {
    pub(crate) faces: Vec<u32>,
    pub(crate) creases: Vec<u32>,
    pub(crate) corners: Vec<u32>,
    pub(crate) holes: Vec<u32>,
}

impl Draft {
    /// Repairs and checks what was read, and adds the tags that are asked for; `name` is the name of the file for messages.
    pub(crate) fn finish(self, name: &str, desc: &ReadDesc) -> Result<Cage, ReadError> {
        let Self { desc: cage, lines } = self;
        build(cage, desc).map_err(|error| {
            // After a repair, elements have other numbers.
            let line = if desc.repair.is_some() { None } else { lines.of(&error) };
            ReadError::Refused { file: name.into(), line, error }
        })
    }
}

/// From what a file holds to a cage, the same way for all formats.
pub(crate) fn build(cage: CageDesc, desc: &ReadDesc) -> Result<Cage, CageError> {
    let observer = desc.observer.as_ref();
    let cage = match &desc.repair {
        Some(repair) => repair::observed(cage, repair, observer)?,
        None => cage,
    };
    let mut cage = Cage::observed(cage, observer)?;
    if let Some(creases) = &desc.creases {
        cage.add_creases(creases, observer)?;
    }
    Ok(cage)
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
