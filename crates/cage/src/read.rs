//! Reading a cage from a file.

use std::path::Path;

use crate::{Cage, ReadError, read_gltf, read_obj};

impl Cage {
    /// Reads a cage from a file; the kind is told by the end of its name, in any case: `.obj`, `.gltf`, `.glb`.
    ///
    /// # Errors
    /// A file that cannot be read, is malformed or does not hold a cage. The message starts with the file and, where there is
    /// one, the line.
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

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    #[test]
    fn the_end_of_the_name_decides_in_any_case() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.b.OBJ");
        std::fs::write(&file, TRIANGLE).expect("written");
        assert_eq!(Cage::read(&file).expect("a cage").face_count(), 1);
    }

    #[test]
    fn messages_start_with_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let refused = |name: &str, text: &str| {
            let file = folder.path().join(name);
            std::fs::write(&file, text).expect("written");
            let message = Cage::read(&file).expect_err("must be refused").to_string();
            message.strip_prefix(&*file.to_string_lossy()).expect("the file comes first").to_string()
        };
        let unknown = ": unknown kind of file; the name must end in .obj, .gltf or .glb";
        assert_eq!(refused("a.stl", TRIANGLE), unknown);
        assert_eq!(refused("obj", TRIANGLE), unknown);
        assert_eq!(refused("bad.obj", "f 1 2\n"), ":1: a face with 2 corners; faces have at least 3");
        assert!(refused("bad.glb", "f 1 2\n").starts_with(": not readable as glTF 2.0: "));
    }

    #[test]
    fn files_that_cannot_be_read() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["missing.obj", "missing.gltf", "missing.glb"] {
            let error = Cage::read(&folder.path().join(name)).expect_err("no such file");
            assert!(matches!(error, ReadError::Io { .. }));
            assert!(error.to_string().contains(&format!("{name}: No such file")), "{error}");
        }
        let directory = folder.path().join("folder.obj");
        std::fs::create_dir(&directory).expect("made");
        assert!(matches!(Cage::read(&directory), Err(ReadError::Io { .. })));
    }
}
