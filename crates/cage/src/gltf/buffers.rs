//! The bytes of a file's buffers: binary part, `data:` uri or file beside it.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use ::gltf::Gltf;
use ::gltf::buffer::{Buffer, Source};

use super::GltfError;
use super::base64;
use super::document::cut;
use crate::{ReadDesc, ReadError};

/// All buffers of a file, at least as long as announced.
pub(super) struct Buffers {
    data: Vec<Rc<[u8]>>,
    /// True if integers may stand for positions and the like (`KHR_mesh_quantization`).
    pub(super) quantized: bool,
    /// Accessors whose sparse indices were found to rise. Any number of primitives may use one.
    pub(super) rising: RefCell<HashSet<usize>>,
}

impl Buffers {
    pub(super) fn load(gltf: &Gltf, folder: Option<&Path>, desc: &ReadDesc) -> Result<Self, GltfError> {
        let mut loader = Loader { blob: gltf.blob.as_deref(), folder, desc, files: HashMap::new() };
        let data = gltf.buffers().map(|buffer| loader.load(&buffer)).collect::<Result<_, _>>()?;
        let mut extensions = gltf.extensions_used().chain(gltf.extensions_required());
        let quantized = extensions.any(|name| name == "KHR_mesh_quantization");
        Ok(Self { data, quantized, rising: RefCell::default() })
    }

    pub(super) fn get(&self, buffer: usize) -> &[u8] {
        &self.data[buffer]
    }

    /// How many bytes there are in all buffers.
    pub(super) fn size(&self) -> usize {
        self.data.iter().map(|data| data.len()).sum()
    }
}

struct Loader<'a> {
    blob: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    desc: &'a ReadDesc,
    /// Many buffers may name one file.
    files: HashMap<PathBuf, Rc<[u8]>>,
}

impl Loader<'_> {
    fn load(&mut self, buffer: &Buffer) -> Result<Rc<[u8]>, GltfError> {
        let index = buffer.index();
        let data = match buffer.source() {
            // Only the first buffer can be the binary part.
            Source::Bin => {
                self.blob.take().filter(|_| index == 0).map(Rc::from).ok_or(GltfError::BufferMissing(index))?
            }
            Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => Rc::from(from_data_uri(data).map_err(|fault| fault.of_buffer(index, uri))?),
                None => self.file(index, uri)?,
            },
        };
        let announced = buffer.length();
        if data.len() < announced {
            return Err(GltfError::BufferShort { buffer: index, announced, found: data.len() });
        }
        Ok(data)
    }

    fn file(&mut self, buffer: usize, uri: &str) -> Result<Rc<[u8]>, GltfError> {
        let refused = || GltfError::BufferUri { buffer, uri: cut(uri) };
        let file = self.folder.and_then(|folder| inside(folder, uri)).ok_or_else(refused)?;
        if let Some(data) = self.files.get(&file) {
            return Ok(data.clone());
        }
        // A pipe would be waited for, and a device never ends.
        if file.metadata().is_ok_and(|metadata| !metadata.is_file()) {
            let error = std::io::Error::other("not a regular file");
            return Err(GltfError::BufferFile { buffer, file, error });
        }
        match self.desc.limits.read_file(&file, self.desc.observer.as_ref()) {
            Ok(data) => Ok(self.files.entry(file).or_insert(data.into()).clone()),
            Err(ReadError::Limit { error, .. }) => Err(error.into()),
            Err(ReadError::Io { error, .. }) => Err(GltfError::BufferFile { buffer, file, error }),
            Err(error) => Err(GltfError::BufferFile { buffer, file, error: std::io::Error::other(error) }),
        }
    }
}

/// What is wrong with a `data:` uri.
pub(super) enum DataFault {
    /// It is not marked as base64.
    Kind,
    /// Its base64 is malformed.
    Base64,
}

impl DataFault {
    fn of_buffer(self, buffer: usize, uri: &str) -> GltfError {
        match self {
            Self::Kind => GltfError::BufferUri { buffer, uri: cut(uri) },
            Self::Base64 => GltfError::BufferBase64(buffer),
        }
    }
}

/// The bytes of a uri after `data:`.
pub(super) fn from_data_uri(data: &str) -> Result<Vec<u8>, DataFault> {
    let (_, text) = data.split_once(',').filter(|(kind, _)| kind.ends_with(";base64")).ok_or(DataFault::Kind)?;
    base64::decode(text.as_bytes()).ok_or(DataFault::Base64)
}

/// The path that a relative uri names; `None` if it has a scheme or leaves the folder.
pub(super) fn inside(folder: &Path, uri: &str) -> Option<PathBuf> {
    let path = PathBuf::from(percent_decoded(uri)?);
    let stays = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    (stays && !uri.contains(':') && path.file_name().is_some()).then(|| folder.join(path))
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte == b'%' {
            let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &rest[2..];
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok().filter(|path| !path.contains('\0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_stay_in_the_folder() {
        let folder = Path::new("models");
        assert_eq!(inside(folder, "a%20b.bin"), Some(folder.join("a b.bin")));
        assert_eq!(inside(folder, "./sub/a.bin"), Some(folder.join("./sub/a.bin")));
        for bad in [
            "/etc/a.bin",
            "../a.bin",
            "sub/../../a.bin",
            "%2e%2e/a.bin",
            "http://host/a.bin",
            "file:a.bin",
            "",
            "a%2",
            "a%zz",
            "a%00",
        ] {
            assert_eq!(inside(folder, bad), None, "{bad:?}");
        }
    }
}
