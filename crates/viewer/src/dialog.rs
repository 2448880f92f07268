//! Choosing a file: a list of what is in a folder.

use std::fs;
use std::path::{Path, PathBuf};

/// Ends of the names of files that can be read.
const EXTENSIONS: [&str; 9] = ["obj", "ply", "off", "gltf", "glb", "usd", "usda", "usdc", "usdz"];

/// A folder and what is in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FileDialog {
    folder: PathBuf,
    folders: Vec<String>,
    files: Vec<String>,
    problem: Option<String>,
}

impl FileDialog {
    /// The folder of a file, or else the current one.
    pub(crate) fn beside(file: Option<&Path>) -> Self {
        let folder = file.and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        Self::of(folder.canonicalize().unwrap_or_else(|_| folder.to_owned()))
    }

    fn of(folder: PathBuf) -> Self {
        let (mut folders, mut files, mut problem) = (Vec::new(), Vec::new(), None);
        match fs::read_dir(&folder) {
            Ok(entries) => {
                for entry in entries.flatten() {
                    let name = entry.file_name().to_string_lossy().into_owned();
                    let is_folder = entry.path().is_dir();
                    if name.starts_with('.') {
                    } else if is_folder {
                        folders.push(name);
                    } else if can_be_read(&name) {
                        files.push(name);
                    }
                }
            }
            Err(error) => problem = Some(error.to_string()),
        }
        folders.sort_unstable_by_key(|name| name.to_lowercase());
        files.sort_unstable_by_key(|name| name.to_lowercase());
        Self { folder, folders, files, problem }
    }

    /// Shows the window; what was chosen, or `Some(None)` if nothing is to be.
    pub(crate) fn show(&mut self, context: &egui::Context) -> Option<Option<PathBuf>> {
        let (mut open, mut chosen, mut next) = (true, None, None);
        egui::Window::new("Open").open(&mut open).collapsible(false).default_size([440.0, 420.0]).show(context, |ui| {
            ui.horizontal(|ui| {
                if ui.button("⬆ Up").clicked() {
                    next = self.folder.parent().map(Path::to_owned);
                }
                ui.add(egui::Label::new(egui::RichText::new(self.folder.display().to_string()).weak()).truncate());
            });
            ui.separator();
            if let Some(problem) = &self.problem {
                ui.colored_label(ui.visuals().error_fg_color, problem);
            }
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                for name in &self.folders {
                    if ui.selectable_label(false, format!("🗀  {name}")).clicked() {
                        next = Some(self.folder.join(name));
                    }
                }
                for name in &self.files {
                    if ui.selectable_label(false, format!("🗋  {name}")).clicked() {
                        chosen = Some(self.folder.join(name));
                    }
                }
                if self.files.is_empty() {
                    ui.weak(format!("no models here ({})", EXTENSIONS.join(", ")));
                }
            });
        });
        if let Some(folder) = next {
            *self = Self::of(folder);
        }
        if chosen.is_some() || !open { Some(chosen) } else { None }
    }
}

fn can_be_read(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|end| EXTENSIONS.iter().any(|known| end.eq_ignore_ascii_case(known)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_and_models_are_listed() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.obj", "A.GLB", "notes.txt", ".hidden.obj"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        fs::create_dir(folder.path().join("more.obj")).unwrap();
        let dialog = FileDialog::beside(Some(&folder.path().join("b.obj")));
        assert_eq!(
            (dialog.folders.as_slice(), dialog.files.as_slice()),
            (&["more.obj".to_owned()][..], &["A.GLB".to_owned(), "b.obj".to_owned()][..])
        );
        assert!(FileDialog::of("/no/such/folder".into()).problem.is_some());
        assert!(
            FileDialog::beside(Some(Path::new("cube.obj"))).folder.is_absolute(),
            "a bare name is in the current folder"
        );
    }
}
