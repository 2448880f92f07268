//! Reading a cage from a file.

use std::borrow::Cow;
use std::path::Path;

use crate::draft::Draft;
use crate::{Cage, CreaseDesc, GltfDesc, Limits, ReadError, ReadObserver, RepairDesc, obj, off, ply, read_gltf, usd};

/// How files become cages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadDesc {
    /// How glTF files do.
    pub gltf: GltfDesc,
    /// What is repaired before the mesh is checked; by default nothing, and what is no manifold mesh is refused.
    pub repair: Option<RepairDesc>,
    /// Crease tags to make from the shape and the seams of the cage; by default none.
    pub creases: Option<CreaseDesc>,
    /// How much a file may ask for.
    pub limits: Limits,
    /// Who is told how far the reading is, and may end it; by default nobody.
    pub observer: Option<ReadObserver>,
}

/// Formats of cages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FileFormat {
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY.
    Ply,
    /// Geomview OFF.
    Off,
    /// glTF, in text or binary.
    Gltf,
    /// Universal Scene Description, in text, binary or a package.
    Usd,
}

impl FileFormat {
    /// The format of a file: what its first bytes say without doubt, else the end of its name, in any case.
    #[must_use]
    pub fn of(path: &Path, bytes: &[u8]) -> Option<Self> {
        Self::of_bytes(bytes).or_else(|| Self::of_name(path))
    }

    fn of_name(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "off" => Some(Self::Off),
            "gltf" | "glb" => Some(Self::Gltf),
            "usd" | "usda" | "usdc" | "usdz" => Some(Self::Usd),
            _ => None,
        }
    }

    fn of_bytes(bytes: &[u8]) -> Option<Self> {
        let word = bytes.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        match word {
            b"ply" => Some(Self::Ply),
            word if word.starts_with(b"glTF") => Some(Self::Gltf),
            word if off::is_keyword(word) => Some(Self::Off),
            _ if usd::is_usd(bytes) => Some(Self::Usd),
            _ => None,
        }
    }
}

impl Cage {
    /// Reads a cage from a file of any [`FileFormat`]: `.obj`, `.ply`, `.off`, `.gltf`, `.glb`, `.usd`, `.usda`, `.usdc`,
    /// `.usdz`.
    ///
    /// # Errors
    /// A file that cannot be read, is malformed or does not hold a cage. The message starts with the file and, where there is
    /// one, the line.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        Self::read_with(path, &ReadDesc::default())
    }

    /// Reads a cage from a file, as [`Cage::read`] does, in a way that is told.
    ///
    /// # Errors
    /// As [`Cage::read`], files beyond the limits, and [`ReadError::Cancelled`] where the observer wants no more of it.
    pub fn read_with(path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        let bytes = desc.limits.read_file(path, desc.observer.as_ref());
        let cage = bytes.and_then(|bytes| Self::read_owned_or_borrowed(bytes.into(), path, desc));
        cage.map_err(|error| error.or_cancelled(path))
    }

    /// Reads a cage from bytes as if they were the file at `path`, which says what messages call it, where its external buffers
    /// are, and what its format is where the bytes do not tell.
    ///
    /// # Errors
    /// As [`Cage::read_with`].
    pub fn read_bytes(bytes: &[u8], path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        Self::read_owned_or_borrowed(bytes.into(), path, desc).map_err(|error| error.or_cancelled(path))
    }

    fn read_owned_or_borrowed(bytes: Cow<'_, [u8]>, path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        match Parsed::new(&bytes, path, desc)? {
            Parsed::Draft(draft) => {
                // The text is as large as what was made of it, and no longer needed.
                drop(bytes);
                draft.finish(&path.display().to_string(), desc)
            }
            Parsed::Cage(cage) => Ok(*cage),
        }
    }
}

/// What a file holds.
pub(crate) enum Parsed {
    /// A mesh as the file has it.
    Draft(Box<Draft>),
    /// A cage at once, where the format has no mesh of its own.
    Cage(Box<Cage>),
}

impl Parsed {
    /// Reads bytes as the file at `path`.
    pub(crate) fn new(bytes: &[u8], path: &Path, desc: &ReadDesc) -> Result<Self, ReadError> {
        let name = path.display().to_string();
        let draft = match FileFormat::of(path, bytes).ok_or_else(|| ReadError::UnknownFormat { file: path.into() })? {
            FileFormat::Obj => obj::draft(bytes, &name, desc)?,
            FileFormat::Ply => ply::draft(bytes, &name, desc)?,
            FileFormat::Off => off::draft(bytes, &name, desc)?,
            FileFormat::Usd => usd::draft(bytes, &name, desc)?,
            FileFormat::Gltf => {
                return read_gltf(bytes, &name, path.parent(), desc).map(Box::new).map(Self::Cage);
            }
        };
        Ok(Self::Draft(Box::new(draft)))
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
    fn the_first_bytes_decide_before_the_name() {
        let format = |name: &str, bytes: &str| FileFormat::of(Path::new(name), bytes.as_bytes());
        assert_eq!(format("a.obj", "ply\nformat"), Some(FileFormat::Ply));
        assert_eq!(format("a", "STCNOFF\n"), Some(FileFormat::Off));
        assert_eq!(format("a.off", "8 6 12\n"), Some(FileFormat::Off));
        assert_eq!(format("a.ply", "glTF\x02\0\0\0"), Some(FileFormat::Gltf));
        assert_eq!(format("a.obj", "plywood"), Some(FileFormat::Obj));
        assert_eq!(format("a.obj", "#usda 1.0"), Some(FileFormat::Usd));
        assert_eq!(format("a", "PXR-USDC\0\x08"), Some(FileFormat::Usd));
        assert_eq!(format("a.usdz", "PK\x03\x04"), Some(FileFormat::Usd));
        assert_eq!(format("a.stl", "solid"), None);
    }

    #[test]
    fn bytes_are_read_like_the_file_they_would_be() {
        let read = |bytes: &str, name: &str| Cage::read_bytes(bytes.as_bytes(), Path::new(name), &ReadDesc::default());
        assert_eq!(read(TRIANGLE, "a/b.obj").expect("a cage").face_count(), 1);
        let message = |bytes, name| read(bytes, name).expect_err("must be refused").to_string();
        assert_eq!(message("f 1 2\n", "a/b.obj"), "a/b.obj:1: a face with 2 corners; faces have at least 3");
        assert!(message(TRIANGLE, "a/b.stl").starts_with("a/b.stl: unknown kind of file"));
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
        let unknown =
            ": unknown kind of file; the name must end in .obj, .ply, .off, .gltf, .glb or .usd (.usda, .usdc, .usdz)";
        assert_eq!(refused("a.stl", TRIANGLE), unknown);
        assert_eq!(refused("obj", TRIANGLE), unknown);
        assert_eq!(refused("empty", ""), unknown);
        assert_eq!(refused("bad.obj", "f 1 2\n"), ":1: a face with 2 corners; faces have at least 3");
        assert!(refused("bad.glb", "f 1 2\n").starts_with(": not readable as glTF 2.0: "));
    }

    #[test]
    fn files_that_cannot_be_read() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["missing.obj", "missing.ply", "missing.gltf", "missing"] {
            let error = Cage::read(&folder.path().join(name)).expect_err("no such file");
            assert!(matches!(error, ReadError::Io { .. }));
            assert!(error.to_string().contains(&format!("{name}: No such file")), "{error}");
        }
        let directory = folder.path().join("folder.obj");
        std::fs::create_dir(&directory).expect("made");
        assert!(matches!(Cage::read(&directory), Err(ReadError::Io { .. })));
    }
}
