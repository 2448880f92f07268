//! Numbers that GLSL and Rust share, read from `#define` lines so that each is written once.

use osculate_shader_compiler::Folder;

/// A `#define NAME value` line.
pub(crate) struct Define {
    /// Name without the prefix that was asked for.
    pub(crate) name: String,
    pub(crate) value: Value,
    /// The comment on the line, or else the comment above its paragraph.
    pub(crate) doc: String,
}

pub(crate) enum Value {
    Unsigned(u32),
    Float(f32),
}

/// Reads the defines of a file whose names start with `prefix`; a missing file has none. A define without a value (an include
/// guard) is skipped; one whose value is neither an unsigned integer nor a float is an error.
pub(crate) fn parse(folder: &Folder, path: &str, prefix: &str) -> Result<Vec<Define>, Vec<String>> {
    let text = folder.load(path).unwrap_or_default();
    let mut found = Vec::new();
    let mut errors = Vec::new();
    let mut paragraph = String::new();
    for (at, line) in text.lines().map(str::trim).enumerate() {
        if line.is_empty() {
            paragraph.clear();
        } else if let Some(comment) = line.strip_prefix("//") {
            paragraph.push_str(comment);
        } else if let Some((name, rest)) = split_define(line, prefix) {
            match parse_value(rest) {
                Some((value, comment)) => {
                    let doc = if comment.is_empty() { paragraph.trim() } else { comment }.to_owned();
                    found.push(Define { name: name.to_owned(), value, doc });
                }
                None => errors.push(format!(
                    "shaders/{path}:{}: the value of {name} must be an unsigned integer or a float; the host reads it too",
                    at + 1
                )),
            }
        }
    }
    if errors.is_empty() { Ok(found) } else { Err(errors) }
}

/// Name and the rest of the line, if it defines a value under a name with that prefix.
fn split_define<'a>(line: &'a str, prefix: &str) -> Option<(&'a str, &'a str)> {
    let (name, rest) = line.strip_prefix("#define")?.trim().split_once(char::is_whitespace)?;
    Some((name.strip_prefix(prefix)?, rest.trim()))
}

/// The value and the comment after it.
fn parse_value(rest: &str) -> Option<(Value, &str)> {
    let (number, comment) = rest.split_once("//").unwrap_or((rest, ""));
    let number = number.trim();
    let digits = number.trim_end_matches(['u', 'U']);
    let unsigned = match digits.strip_prefix("0x") {
        Some(hex) => u32::from_str_radix(hex, 16),
        None => digits.parse(),
    };
    let value = unsigned.map(Value::Unsigned).or_else(|_| number.parse().map(Value::Float)).ok()?;
    Some((value, comment.trim()))
}
