//! Shaders that are compiled again when their files change.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use osculate::ShaderSet;
use osculate_shader_compiler::{CompileDesc, Folder, compile, list_includes};
use osculate_shaders::{EmbeddedShader, INCLUDE_DIRS, SHADERS, SOURCES};

/// How often files are looked at.
const PERIOD: Duration = Duration::from_millis(400);
/// The variable that names another folder than that of the sources.
const VARIABLE: &str = "OSCULATE_SHADERS";

/// Watches the folder on a thread of its own, which ends when this is dropped.
pub(crate) struct Watcher {
    ends: Arc<AtomicBool>,
    now: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Watcher {
    /// Starts the thread. `tell` hears of new shaders, or of what is wrong with them.
    pub(crate) fn start(tell: impl Fn(Result<ShaderSet, String>) + Send + 'static) -> std::io::Result<Self> {
        let folder = std::env::var_os(VARIABLE).map_or_else(sources, PathBuf::from);
        let (ends, now) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let (until, asked) = (Arc::clone(&ends), Arc::clone(&now));
        let thread = std::thread::Builder::new().name("shaders".to_owned()).spawn(move || {
            let mut known = texts(&folder);
            while !until.load(Ordering::Relaxed) {
                std::thread::park_timeout(PERIOD);
                let found = texts(&folder);
                if asked.swap(false, Ordering::Relaxed) || found != known {
                    tell(compile_changed(&found));
                    known = found;
                }
            }
        })?;
        Ok(Self { ends, now, thread: Some(thread) })
    }

    /// Compiles at once, changed or not.
    pub(crate) fn compile(&self) {
        self.now.store(true, Ordering::Relaxed);
        self.thread.iter().for_each(|thread| thread.thread().unpark());
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            let _panicked_and_said_so = thread.join();
        }
    }
}

/// The folder that the embedded shaders were compiled from.
fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders")
}

/// The texts of all files that shaders are made of, as they are now; of those that are not there, as they were built.
fn texts(folder: &Path) -> BTreeMap<&'static str, String> {
    let folder = Folder(folder.to_owned());
    let text = |&(path, built): &(&'static str, &str)| (path, folder.load(path).unwrap_or_else(|| built.to_owned()));
    SOURCES.iter().map(text).collect()
}

/// The embedded shaders, those compiled again whose texts are others than they were built from.
fn compile_changed(texts: &BTreeMap<&'static str, String>) -> Result<ShaderSet, String> {
    let changed: Vec<&str> =
        SOURCES.iter().filter(|(path, built)| texts[path] != *built).map(|(path, _)| *path).collect();
    let load = |path: &str| texts.get(path).cloned();
    let mut set = ShaderSet::embedded();
    for shader in SHADERS {
        let desc = CompileDesc {
            name: shader.path,
            source: &texts[shader.path],
            include_dirs: INCLUDE_DIRS,
            load: &load,
            defines: shader.defines,
            debug_info: false,
        };
        if is_affected(shader, &desc, &changed)? {
            let words = compile(&desc).map_err(|error| error.to_string())?;
            set = set.with_override(shader.name, words).map_err(|error| error.to_string())?;
        }
    }
    Ok(set)
}

fn is_affected(shader: &EmbeddedShader, desc: &CompileDesc<'_>, changed: &[&str]) -> Result<bool, String> {
    if changed.is_empty() || changed.contains(&shader.path) {
        return Ok(!changed.is_empty());
    }
    let includes = list_includes(desc).map_err(|error| error.to_string())?;
    Ok(includes.iter().any(|path| changed.contains(&path.as_str())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn built() -> BTreeMap<&'static str, String> {
        SOURCES.iter().map(|&(path, text)| (path, text.to_owned())).collect()
    }

    #[test]
    fn changed_texts_make_other_shaders_and_nothing_else() {
        let mut texts = built();
        let same = compile_changed(&texts).unwrap();
        assert_eq!(same.get("view/mark.frag"), osculate_shaders::shader("view/mark.frag"));
        let text = texts["view/mark.frag"].replace("color = mark.color", "color = 0.5 * mark.color");
        texts.insert("view/mark.frag", text);
        let other = compile_changed(&texts).unwrap();
        assert_ne!(other.get("view/mark.frag"), osculate_shaders::shader("view/mark.frag"));
        assert_eq!(other.get("view/gui.frag"), osculate_shaders::shader("view/gui.frag"));
    }

    #[test]
    fn changed_includes_change_what_includes_them() {
        let mut texts = built();
        let text = texts["include/encoding.glsl"].replace("12.92 * c", "12.0 * c");
        texts.insert("include/encoding.glsl", text);
        let other = compile_changed(&texts).unwrap();
        assert_ne!(other.get("view/picture.frag"), osculate_shaders::shader("view/picture.frag"));
        assert_eq!(other.get("view/mark.frag"), osculate_shaders::shader("view/mark.frag"));
    }

    #[test]
    fn errors_name_file_and_line() {
        let mut texts = built();
        texts.insert("view/mark.frag", texts["view/mark.frag"].replace("mark.color;", "mark.colour;"));
        let error = compile_changed(&texts).unwrap_err();
        assert!(error.contains("view/mark.frag:"), "{error}");
    }
}
