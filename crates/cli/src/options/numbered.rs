//! Names of numbered files.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

/// A path with the place of a number in its file name: `%d`, or `%04d` for four digits at least, as ffmpeg and C have it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NumberedPath {
    before: PathBuf,
    after: String,
    digits: usize,
}

impl NumberedPath {
    /// Finds the place of the number.
    pub(crate) fn new(path: &Path) -> Result<Self, Failure> {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let parsed = name.split_once('%').and_then(|(before, rest)| {
            let (width, after) = rest.split_once('d')?;
            // A width that is not padded with zeros would make names with spaces.
            let digits = if width.is_empty() { 1 } else { width.strip_prefix('0')?.parse().ok()? };
            let fits = (1..=20).contains(&digits) && !after.contains('%');
            fits.then(|| Self { before: path.with_file_name(before), after: after.to_owned(), digits })
        });
        parsed.ok_or_else(|| {
            Failure::usage(format_args!("{}: several pictures need a place for their number", path.display()))
                .with_hint("put %04d or %d once into the name of the file, such as frame_%04d.png")
        })
    }

    /// The path with a number.
    pub(crate) fn of(&self, number: u32) -> PathBuf {
        let mut path = self.before.clone().into_os_string();
        path.push(format!("{number:0digits$}{}", self.after, digits = self.digits));
        path.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_stands_where_it_should() {
        for (pattern, number, expected) in [
            ("frame_%04d.png", 7, "frame_0007.png"),
            ("a/%d.png", 12, "a/12.png"),
            ("100%/x%02dy.png", 123, "100%/x123y.png"),
            ("/a/b.%03d.png", 1, "/a/b.001.png"),
        ] {
            assert_eq!(NumberedPath::new(Path::new(pattern)).unwrap().of(number), Path::new(expected));
        }
        for wrong in ["frame.png", "%.png", "%4d.png", "%x.png", "%d%d.png", "%00d.png", "%099d.png", "%d/a.png", ""] {
            assert!(NumberedPath::new(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
