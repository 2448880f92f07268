//! Files that results go to.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

/// A file in a folder that exists, with an ending that says its format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Output<F> {
    /// The file.
    pub(crate) path: PathBuf,
    /// The format that its name asks for.
    pub(crate) format: F,
}

impl<F: Copy> Output<F> {
    /// Checks the place and finds the format among `(ending, format)`, so that a typo is not found after minutes of work.
    pub(crate) fn new(path: PathBuf, formats: &[(&str, F)]) -> Result<Self, Failure> {
        check_folder(&path)?;
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
        match formats.iter().find(|(known, _)| *known == ending) {
            Some(&(_, format)) => Ok(Self { path, format }),
            None => {
                let endings: Vec<String> = formats.iter().map(|(known, _)| format!(".{known}")).collect();
                Err(Failure::usage(format_args!(
                    "{}: the name does not say a format that can be written",
                    path.display()
                ))
                .with_hint(format_args!("end it in {}", endings.join(", "))))
            }
        }
    }
}

fn check_folder(path: &Path) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if path.is_dir() {
        return Err(Failure::output(path, "it is a folder"));
    }
    if folder.is_dir() { Ok(()) } else { Err(Failure::output(path, "its folder does not exist")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_says_the_format_in_any_case() {
        let formats = [("png", 1), ("ply", 2)];
        assert_eq!(Output::new("a.b.PLY".into(), &formats).unwrap().format, 2);
        for wrong in ["a", "a.jpg", "png", ".png"] {
            assert!(Output::new(wrong.into(), &formats).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_folder_must_exist() {
        let folder = tempfile::tempdir().unwrap();
        let formats = [("png", ())];
        assert!(Output::new(folder.path().join("a.png"), &formats).is_ok());
        assert!(Output::new(folder.path().join("no/a.png"), &formats).is_err());
        std::fs::create_dir(folder.path().join("b.png")).unwrap();
        assert!(Output::new(folder.path().join("b.png"), &formats).is_err());
    }
}
