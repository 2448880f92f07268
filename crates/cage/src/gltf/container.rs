//! The container of a binary file (glTF 2.0 specification, section 4.4): a header, the JSON, perhaps a buffer.

use super::GltfError;

/// What begins a binary file.
const MAGIC: &[u8] = b"glTF";
/// Sizes of the header and of the beginning of a chunk.
const HEADER: usize = 12;
const CHUNK: usize = 8;

/// The JSON text and the binary part. A file that is not binary is all text.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    if bytes.len() < HEADER + CHUNK {
        return Err(fault("the header of the binary file is cut short".into()));
    }
    let (version, length) = (number(&bytes[4..]), number(&bytes[8..]));
    if version != 2 {
        return Err(fault(format!("the file is binary glTF of version {version}; export it again as glTF 2.0")));
    }
    if length < HEADER + CHUNK {
        return Err(fault(format!("the header of the binary file announces {length} bytes, which is too few")));
    }
    let Some(content) = bytes.get(HEADER..length) else {
        return Err(fault(format!(
            "the file has {} of the {length} bytes its header announces; it is cut short",
            bytes.len()
        )));
    };
    let Some((b"JSON", json, rest)) = chunk(content)? else {
        return Err(fault("the binary file does not begin with its JSON".into()));
    };
    // Chunks of other kinds have no meaning, wherever they are.
    let mut rest = rest;
    while let Some((kind, data, more)) = chunk(rest)? {
        if kind == b"BIN\0" {
            return Ok((json, Some(data)));
        }
        rest = more;
    }
    Ok((json, None))
}

/// The kind and the data of the first chunk, and what follows it.
type Chunk<'a> = (&'a [u8; 4], &'a [u8], &'a [u8]);

/// The first chunk; none at the end.
fn chunk(bytes: &[u8]) -> Result<Option<Chunk<'_>>, GltfError> {
    let Some((head, rest)) = bytes.split_at_checked(CHUNK) else { return Ok(None) };
    let length = number(head);
    let kind = head[4..].first_chunk().expect("a head has two times four bytes");
    let cut = || fault(format!("a chunk of the binary file announces {length} bytes, but {} are left", rest.len()));
    let (data, rest) = rest.split_at_checked(length).ok_or_else(cut)?;
    // Padding is part of the length; some exporters forget that.
    let padding = (length.next_multiple_of(4) - length).min(rest.len());
    Ok(Some((kind, data, &rest[padding..])))
}

fn number(bytes: &[u8]) -> usize {
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize
}

fn fault(what: String) -> GltfError {
    GltfError::Format(what)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
        let mut content = Vec::new();
        for (kind, data) in chunks {
            content.extend((data.len() as u32).to_le_bytes());
            content.extend_from_slice(*kind);
            content.extend_from_slice(data);
            content.resize(content.len().next_multiple_of(4), 0);
        }
        let length = (HEADER + content.len()) as u32;
        [MAGIC, &2_u32.to_le_bytes(), &length.to_le_bytes(), &content].concat()
    }

    #[test]
    fn parts() {
        let parts = |chunks: &[(&[u8; 4], &[u8])]| {
            let file = file(chunks);
            let (json, bin) = split(&file).expect("well formed");
            (json.to_vec(), bin.map(<[u8]>::to_vec))
        };
        assert_eq!(parts(&[(b"JSON", b"{}  ")]), (b"{}  ".to_vec(), None));
        assert_eq!(parts(&[(b"JSON", b"{} "), (b"BIN\0", b"abcd")]), (b"{} ".to_vec(), Some(b"abcd".to_vec())));
        let unknown = parts(&[(b"JSON", b"{}  "), (b"MORE", b"1234"), (b"BIN\0", b""), (b"BIN\0", b"no")]);
        assert_eq!(unknown, (b"{}  ".to_vec(), Some(Vec::new())));
        assert_eq!(split(b"{}").expect("text"), (&b"{}"[..], None));
    }

    #[test]
    fn every_cut_is_noticed() {
        let whole = file(&[(b"JSON", b"{}  "), (b"BIN\0", b"abcd")]);
        for length in 4..whole.len() {
            assert!(split(&whole[..length]).is_err(), "{length}");
        }
    }
}
