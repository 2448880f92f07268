//! The models that can be looked at, one after the other.

use std::path::{Path, PathBuf};

/// Files, and which of them is wanted and which one shown.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Models {
    files: Vec<PathBuf>,
    wanted: usize,
    /// How often it was read again.
    revision: u32,
}

impl Models {
    /// Those of the command line, the first one wanted.
    pub(crate) fn new(files: Vec<PathBuf>) -> Self {
        Self { files, ..Self::default() }
    }

    pub(crate) fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Number of the one that is wanted.
    pub(crate) fn position(&self) -> usize {
        self.wanted
    }

    /// The one that is wanted.
    pub(crate) fn wanted(&self) -> Option<&Path> {
        self.files.get(self.wanted).map(PathBuf::as_path)
    }

    pub(crate) fn revision(&self) -> u32 {
        self.revision
    }

    /// Goes on by so many, around the end.
    pub(crate) fn step(&mut self, steps: isize) {
        if !self.files.is_empty() {
            self.wanted = (self.wanted as isize + steps).rem_euclid(self.files.len() as isize) as usize;
        }
    }

    /// Goes to one of them.
    pub(crate) fn choose(&mut self, position: usize) {
        self.wanted = position.min(self.files.len().saturating_sub(1));
    }

    /// Reads the wanted one again.
    pub(crate) fn reload(&mut self) {
        self.revision += 1;
    }

    /// Goes to a file, which joins the others if it is new, and is read again if it is not.
    pub(crate) fn open(&mut self, file: PathBuf) {
        match self.files.iter().position(|known| *known == file) {
            Some(known) => {
                self.wanted = known;
                self.revision += 1;
            }
            None => {
                self.files.push(file);
                self.wanted = self.files.len() - 1;
            }
        }
    }

    /// Goes back to the file that is shown, since the wanted one cannot be.
    pub(crate) fn go_back(&mut self, shown: Option<(&Path, u32)>) {
        let Some((file, revision)) = shown else { return };
        if let Some(known) = self.files.iter().position(|one| one == file) {
            (self.wanted, self.revision) = (known, revision);
        }
    }
}

/// The name of a file for people.
pub(crate) fn title(file: &Path) -> String {
    file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn models() -> Models {
        Models::new(["a.obj", "b.obj", "c.obj"].map(PathBuf::from).to_vec())
    }

    #[test]
    fn models_go_around() {
        let mut models = models();
        models.step(-1);
        assert_eq!(models.wanted(), Some(Path::new("c.obj")));
        models.step(2);
        assert_eq!(models.wanted(), Some(Path::new("b.obj")));
        let mut none = Models::default();
        none.step(1);
        none.choose(3);
        assert_eq!(none.wanted(), None);
    }

    #[test]
    fn opened_files_join_or_are_read_again() {
        let mut models = models();
        models.open("d.obj".into());
        assert_eq!((models.files().len(), models.position(), models.revision()), (4, 3, 0));
        models.open("a.obj".into());
        assert_eq!((models.files().len(), models.position(), models.revision()), (4, 0, 1));
    }

    #[test]
    fn what_cannot_be_shown_is_left_again() {
        let mut models = models();
        models.open("bad.obj".into());
        models.go_back(Some((Path::new("b.obj"), 7)));
        assert_eq!((models.wanted(), models.revision()), (Some(Path::new("b.obj")), 7));
        models.go_back(None);
        assert_eq!(models.wanted(), Some(Path::new("b.obj")));
    }
}
