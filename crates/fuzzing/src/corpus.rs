//! The corpus of a target in one file: so many small inputs would bury everything else in the history of the repository.
//!
//! | bytes | what |
//! |---|---|
//! | 4 | the length of an input, lowest byte first |
//! | length | the input |
//!
//! and so on to the end. Inputs are sorted by length, then by value, so that a corpus has one form.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// The kept corpus of a target.
#[must_use]
pub fn kept(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(format!("{target}.pack"))
}

/// The inputs in a packed corpus.
///
/// # Errors
/// A file that cannot be read, or that ends in the middle of an input.
pub fn read(pack: &Path) -> io::Result<Vec<Vec<u8>>> {
    let bytes = fs::read(pack)?;
    let mut rest = &bytes[..];
    let mut inputs = Vec::new();
    while !rest.is_empty() {
        let (length, more) = rest.split_first_chunk().ok_or(io::ErrorKind::UnexpectedEof)?;
        let length = u32::from_le_bytes(*length) as usize;
        let (input, more) = more.split_at_checked(length).ok_or(io::ErrorKind::UnexpectedEof)?;
        inputs.push(input.to_vec());
        rest = more;
    }
    Ok(inputs)
}

/// Packs inputs, each once.
///
/// # Errors
/// A file that cannot be written, or an input of 4 GiB.
pub fn write(pack: &Path, mut inputs: Vec<Vec<u8>>) -> io::Result<()> {
    inputs.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    inputs.dedup();
    let mut bytes = Vec::new();
    for input in inputs {
        let length = u32::try_from(input.len()).map_err(io::Error::other)?;
        bytes.extend(length.to_le_bytes());
        bytes.extend(input);
    }
    fs::write(pack, bytes)
}
