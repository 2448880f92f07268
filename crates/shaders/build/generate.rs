//! Writes the Rust code that embeds what was compiled.

use crate::defines::{Define, Value};
use crate::{INCLUDE_DIRS, Job};
use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

/// Writes one `.spv` file per shader and `shaders.rs`, which embeds them and all sources.
pub(crate) fn write(out: &Path, root: &Path, files: &[String], jobs: &[Job], compiled: &[Vec<u32>]) -> io::Result<()> {
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by(|&a, &b| jobs[a].name.cmp(&jobs[b].name));
    let mut statics = String::new();
    let mut table = String::new();
    for at in order {
        let (job, words) = (&jobs[at], &compiled[at]);
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        fs::write(out.join(format!("{at}.spv")), bytes)?;
        let file = format!("include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{at}.spv\"))");
        statics += &format!("static SPIRV_{at}: [u32; {}] = words({file});\n", words.len());
        let Job { name, path, defines } = job;
        table += &format!(
            "    EmbeddedShader {{ name: {name:?}, path: {path:?}, defines: &{defines:?}, spirv: &SPIRV_{at} }},\n"
        );
    }
    let mut sources = String::new();
    for path in files {
        sources += &format!("    ({path:?}, include_str!({:?})),\n", root.join(path));
    }
    let code = format!(
        "{statics}\n\
         /// Every shader, sorted by name.\npub const SHADERS: &[EmbeddedShader] = &[\n{table}];\n\n\
         /// Path and text of every GLSL file, includes too, sorted by path.\npub const SOURCES: &[(&str, &str)] = &[\n{sources}];\n\n\
         /// Where `#include` looks after the including file's own folder, as paths in [`SOURCES`].\n\
         pub const INCLUDE_DIRS: &[&str] = &{INCLUDE_DIRS:?};\n"
    );
    fs::write(out.join("shaders.rs"), code)
}

/// Writes one documented constant per define.
pub(crate) fn write_constants(file: &Path, defines: &[Define]) -> io::Result<()> {
    let mut code = String::new();
    for Define { name, value, doc } in defines {
        let doc = if doc.is_empty() { name } else { doc };
        let (ty, value) = match value {
            Value::Unsigned(value) => ("u32", format!("{value}")),
            Value::Float(value) => ("f32", format!("{value:?}")),
        };
        writeln!(code, "#[doc = {doc:?}]\npub const {name}: {ty} = {value};").map_err(io::Error::other)?;
    }
    fs::write(file, code)
}
