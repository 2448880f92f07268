//! What the file of a case holds.
//!
//! Lines end with a line feed. Between `<<` and `>>` stand bytes: numbers after the name of their type (`u8` to `u32`, `i8` to
//! `i32`, `f32`, `f64`, with `be` for the highest byte first), `text WORD`, `times N` to repeat what is in the brackets before it;
//! a line that ends with them has no line feed. After `<<base64` they become a `data:` uri.
//!
//! With the option `from=NAME` the file is that of another case with changes: a line `A => B` for each text that is replaced,
//! which must occur exactly once; `\n` is a line end there, and nothing may follow the arrow. With `glb`, the lines up to `BIN` are the JSON of a binary glTF file and those after it its buffer.

use crate::table::Case;

/// The bytes of a case's file.
///
/// # Panics
/// If they cannot be made.
pub(crate) fn bytes(case: &Case, all: &[Case]) -> Vec<u8> {
    let text = text(case, all);
    if case.options.iter().any(|option| option == "glb") { glb(&text) } else { expand(&text) }
}

fn text(case: &Case, all: &[Case]) -> String {
    let Some(source) = case.options.iter().find_map(|option| option.strip_prefix("from=")) else {
        return case
            .lines
            .iter()
            .map(|line| format!("{line}{}", if line.ends_with(">>") { "" } else { "\n" }))
            .collect();
    };
    let source = all.iter().find(|other| other.name == source).unwrap_or_else(|| panic!("no case {source}"));
    case.lines.iter().fold(text(source, all), |text, line| {
        let (old, new) = line.split_once(" =>").unwrap_or_else(|| panic!("{}: {line:?} is no change", case.name));
        let (old, new) = (old.replace("\\n", "\n"), new.strip_prefix(' ').unwrap_or(new).replace("\\n", "\n"));
        assert_eq!(text.matches(&old).count(), 1, "{}: {old:?} must occur once in {}", case.name, source.name);
        text.replace(&old, &new)
    })
}

/// The container of a JSON text and a buffer.
fn glb(text: &str) -> Vec<u8> {
    let (json, bin) = text.split_once("BIN\n").unwrap_or((text, ""));
    let (json, mut bin) = (json.trim_end().to_owned(), expand(bin));
    let json = format!("{json:width$}", width = json.len().next_multiple_of(4));
    bin.resize(bin.len().next_multiple_of(4), 0);
    let chunk = |kind: &[u8; 4], data: &[u8]| [&(data.len() as u32).to_le_bytes(), &kind[..], data].concat();
    let mut chunks = chunk(b"JSON", json.as_bytes());
    if !bin.is_empty() {
        chunks.extend(chunk(b"BIN\0", &bin));
    }
    [b"glTF", &2_u32.to_le_bytes()[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

/// Replaces what is between brackets by bytes.
fn expand(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<<") {
        let (values, after) = after.split_once(">>").expect("brackets that end");
        bytes.extend_from_slice(before.as_bytes());
        match values.strip_prefix("base64 ") {
            Some(values) => {
                let uri = format!("data:application/octet-stream;base64,{}", base64(&values_of(values)));
                bytes.extend_from_slice(uri.as_bytes());
            }
            None => bytes.extend(values_of(values)),
        }
        rest = after;
    }
    bytes.extend_from_slice(rest.as_bytes());
    bytes
}

fn values_of(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut kind = "";
    for word in text.split_whitespace() {
        match kind {
            "text" => bytes.extend_from_slice(word.as_bytes()),
            "times" => bytes = bytes.repeat(word.parse().expect("a number of times")),
            _ if word.parse::<f64>().is_ok() => {
                bytes.extend(number(kind, word));
                continue;
            }
            _ => {
                kind = word;
                continue;
            }
        }
        kind = "";
    }
    bytes
}

/// A number of that type.
fn number(kind: &str, word: &str) -> Vec<u8> {
    let (kind, reversed) = kind.strip_suffix("be").map_or((kind, false), |kind| (kind, true));
    let value: f64 = word.parse().expect("a number");
    let mut bytes = match kind {
        "u8" => (value as u8).to_le_bytes().to_vec(),
        "i8" => (value as i8).to_le_bytes().to_vec(),
        "u16" => (value as u16).to_le_bytes().to_vec(),
        "i16" => (value as i16).to_le_bytes().to_vec(),
        "u32" => (value as u32).to_le_bytes().to_vec(),
        "i32" => (value as i32).to_le_bytes().to_vec(),
        "f32" => (value as f32).to_le_bytes().to_vec(),
        "f64" => value.to_le_bytes().to_vec(),
        _ => panic!("{kind:?} is no type of numbers"),
    };
    if reversed {
        bytes.reverse();
    }
    bytes
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    let symbols = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |group: &[u8]| {
        let bits = (0..3).fold(0_u32, |bits, i| bits << 8 | u32::from(group.get(i).copied().unwrap_or(0)));
        let symbol =
            |i: usize| if i <= group.len() { char::from(symbols[(bits >> (18 - 6 * i) & 63) as usize]) } else { '=' };
        (0..4).map(symbol).collect::<String>()
    };
    bytes.chunks(3).map(group).collect()
}

#[test]
fn brackets_become_bytes() {
    assert_eq!(expand("a<<u8 1 2 u16be 258 text xy>>b\n"), b"a\x01\x02\x01\x02xyb\n");
    assert_eq!(expand("<<u8 7 times 3 i8 -1>>"), b"\x07\x07\x07\xff");
    assert_eq!(expand("<<base64 text foob>>"), b"data:application/octet-stream;base64,Zm9vYg==");
}
