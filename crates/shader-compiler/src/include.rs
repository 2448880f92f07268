//! Finding included files, and guarding against includes that never end.

use shaderc::{IncludeCallbackResult, IncludeType, ResolvedInclude};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// Deeper nesting than any honest source has; what passes it includes itself.
const MAX_DEPTH: usize = 32;

/// A folder as the source of included text: pass `&|path| folder.load(path)` as the loader.
#[derive(Debug, Clone)]
pub struct Folder(pub PathBuf);

impl Folder {
    /// Text of the file at `path` below the folder; nothing if there is none or it is not UTF-8.
    pub fn load(&self, path: &str) -> Option<String> {
        fs::read_to_string(self.0.join(path)).ok()
    }
}

/// Resolves the `#include` lines of one compilation and remembers what it loaded.
pub(crate) struct Resolver<'a> {
    dirs: &'a [&'a str],
    load: &'a dyn Fn(&str) -> Option<String>,
    loaded: RefCell<BTreeSet<String>>,
    /// Paths at which a quoted include was not found; the compiler asks again as if it were in angle brackets.
    missed: RefCell<Vec<String>>,
}

impl<'a> Resolver<'a> {
    pub(crate) fn new(dirs: &'a [&'a str], load: &'a dyn Fn(&str) -> Option<String>) -> Self {
        Self { dirs, load, loaded: RefCell::default(), missed: RefCell::default() }
    }

    /// Paths of all files loaded so far, sorted.
    pub(crate) fn loaded(&self) -> Vec<String> {
        self.loaded.borrow().iter().cloned().collect()
    }

    /// Answers one `#include` line: `"wanted"` is looked for beside the including file `from` first, `<wanted>` is not.
    pub(crate) fn resolve(&self, wanted: &str, kind: IncludeType, from: &str, depth: usize) -> IncludeCallbackResult {
        if depth > MAX_DEPTH {
            return Err(format!("includes nested more than {MAX_DEPTH} deep; does '{wanted}' include itself?"));
        }
        let candidates = self.candidates(wanted, kind, from);
        for path in &candidates {
            let Some(content) = (self.load)(path) else {
                continue;
            };
            self.missed.take();
            if content.contains('\0') {
                return Err(format!("'{path}' holds a NUL character"));
            }
            self.loaded.borrow_mut().insert(path.clone());
            return Ok(ResolvedInclude { resolved_name: path.clone(), content });
        }
        Err(self.not_found(candidates, kind))
    }

    fn not_found(&self, candidates: Vec<String>, kind: IncludeType) -> String {
        let mut tried = self.missed.take();
        let new: Vec<_> = candidates.into_iter().filter(|path| !tried.contains(path)).collect();
        tried.extend(new);
        let message = format!("no such file (looked for {})", tried.join(", "));
        if kind == IncludeType::Relative {
            self.missed.replace(tried);
        }
        message
    }

    fn candidates(&self, wanted: &str, kind: IncludeType, from: &str) -> Vec<String> {
        let own = from.rsplit_once('/').map_or("", |(dir, _)| dir);
        let own = (kind == IncludeType::Relative).then_some(own);
        let mut paths = Vec::new();
        for dir in own.into_iter().chain(self.dirs.iter().copied()) {
            if let Some(path) = normalise(dir, wanted).filter(|path| !paths.contains(path)) {
                paths.push(path);
            }
        }
        paths
    }
}

/// `dir/path` without `.` and `..`, so that one file has one name; nothing if it leaves the root.
fn normalise(dir: &str, path: &str) -> Option<String> {
    let mut parts = Vec::new();
    for part in dir.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()?),
            part => parts.push(part),
        }
    }
    (!parts.is_empty()).then(|| parts.join("/"))
}
