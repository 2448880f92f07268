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
        check_place(&path)?;
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

impl<F> Output<F> {
    /// The same output, if it is none of the files that are read.
    pub(crate) fn apart_from<'a>(self, inputs: impl IntoIterator<Item = &'a Path>) -> Result<Self, Failure> {
        check_apart(&self.path, inputs).map(|()| self)
    }

    /// How many bytes were written, as far as the system says.
    pub(crate) fn bytes(&self) -> u64 {
        std::fs::metadata(&self.path).map_or(0, |found| found.len())
    }
}

/// Refuses to write over a file that is read: what was typed is more likely a slip than a wish.
pub(crate) fn check_apart<'a>(path: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    if path.is_file() && inputs.into_iter().any(|input| is_same(path, input)) {
        return Err(Failure::usage(format_args!("{}: the output is also the input", path.display()))
            .with_hint("write to another file"));
    }
    Ok(())
}

/// Whether both are one file, by whatever names.
#[cfg(unix)]
fn is_same(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |path: &Path| std::fs::metadata(path).map(|found| (found.dev(), found.ino())).ok();
    identity(a).is_some_and(|a| Some(a) == identity(b))
}

/// Whether both are one file, by whatever names but those of hard links.
#[cfg(not(unix))]
fn is_same(a: &Path, b: &Path) -> bool {
    a.canonicalize().ok().is_some_and(|a| Some(a) == b.canonicalize().ok())
}

/// Checks that a file could be at this place, so that a typo is not found after minutes of work.
pub(crate) fn check_place(path: &Path) -> Result<(), Failure> {
    if path == Path::new("-") {
        return Err(Failure::usage("-: -o takes the name of a file and cannot write to stdout")
            .with_hint("name a file; for one that is called so, ./-. Only sample prints, without -o"));
    }
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
    fn an_input_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let (file, other) = (folder.path().join("a"), folder.path().join("b"));
        std::fs::write(&file, "x").unwrap();
        let same = folder.path().join(".").join("a");
        assert!(check_apart(&same, [other.as_path(), &file]).is_err());
        assert!(check_apart(&other, [file.as_path()]).is_ok());
        std::fs::hard_link(&file, &other).unwrap();
        assert_eq!(check_apart(&other, [file.as_path()]).is_err(), cfg!(unix));
    }

    #[test]
    fn the_folder_must_exist() {
        assert!(check_place(Path::new("-")).is_err() && check_place(Path::new("./-")).is_ok());
        let folder = tempfile::tempdir().unwrap();
        let formats = [("png", ())];
        assert!(Output::new(folder.path().join("a.png"), &formats).is_ok());
        assert!(Output::new(folder.path().join("no/a.png"), &formats).is_err());
        std::fs::create_dir(folder.path().join("b.png")).unwrap();
        assert!(Output::new(folder.path().join("b.png"), &formats).is_err());
    }
}
