//! Reading a cage from a file.

use std::path::Path;

use crate::{Cage, ReadError, read_gltf, read_obj};

impl Cage {
    /// Reads a cage from a file; the kind is told by the end of its name, in any case: `.obj`, `.gltf`, `.glb`.
    ///
    /// # Errors
    /// A file that cannot be read, is malformed or does not hold a cage. The message starts with the file and, where there is one, the line.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let bytes = || std::fs::read(path).map_err(|error| ReadError::Io { file: path.into(), error });
        match extension.as_deref() {
            Some("obj") => read_obj(&bytes()?, &path.display().to_string()),
            Some("gltf" | "glb") => read_gltf(&bytes()?, &path.display().to_string(), path.parent()),
            _ => Err(ReadError::UnknownFormat { file: path.into() }),
        }
    }
}
