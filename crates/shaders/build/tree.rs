//! Which files the shaders folder holds.

use std::fs;
use std::path::Path;

/// Paths of all GLSL files below `root`, relative to it, with `/` between components, sorted.
pub(crate) fn sources(root: &Path) -> Result<Vec<String>, String> {
    let mut found = Vec::new();
    walk(root, "", &mut found)?;
    found.sort();
    Ok(found)
}

fn walk(root: &Path, dir: &str, found: &mut Vec<String>) -> Result<(), String> {
    let message = |error| format!("shaders/{dir}: {error}");
    for entry in fs::read_dir(root.join(dir)).map_err(message)? {
        let entry = entry.map_err(message)?;
        let name = entry.file_name();
        let Some(name) = name.to_str() else { continue };
        let path = if dir.is_empty() { name.to_owned() } else { format!("{dir}/{name}") };
        if entry.file_type().map_err(message)?.is_dir() {
            walk(root, &path, found)?;
        } else if is_source(name) {
            found.push(path);
        }
    }
    Ok(())
}

fn is_source(name: &str) -> bool {
    let extension = name.rsplit_once('.').map(|(_, extension)| extension);
    // Editors keep hidden and backup copies beside the file.
    !name.starts_with('.') && matches!(extension, Some("vert" | "tesc" | "tese" | "frag" | "comp" | "glsl"))
}
