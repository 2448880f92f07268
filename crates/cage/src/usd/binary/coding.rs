//! Compressed integers: differences with the most frequent one left out, then LZ4.

use super::cursor::{Cursor, chunks};
use super::damaged;
use crate::usd::UsdError;

/// The next `count` integers of `SIZE` bytes, 4 or 8, sign-extended.
pub(super) fn integers<const SIZE: usize>(cursor: &mut Cursor, count: u64) -> Result<Vec<i64>, UsdError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let count = usize::try_from(count).map_err(|_| damaged(TOO_FEW))?;
    let most = count.saturating_mul(SIZE + 1).saturating_add(SIZE + 1);
    let bytes = decompress(cursor, most)?;
    decode::<SIZE>(&bytes, count).ok_or_else(|| damaged(TOO_FEW))
}

const TOO_FEW: &str = "compressed integers are cut short";

/// At most `most` bytes of a compressed block that is preceded by its size.
pub(super) fn decompress(cursor: &mut Cursor, most: usize) -> Result<Vec<u8>, UsdError> {
    let size = cursor.u64()?;
    let block = cursor.bytes(size)?;
    unpack(&block, most).ok_or_else(|| damaged("a compressed block is malformed"))
}

/// Undoes the variable width and the differences.
fn decode<const SIZE: usize>(bytes: &[u8], count: usize) -> Option<Vec<i64>> {
    let (common, rest) = bytes.split_at_checked(SIZE)?;
    let common = little_endian(common);
    let (codes, mut rest) = rest.split_at_checked(count.div_ceil(4))?;
    let mut value = 0_i64;
    let mut decoded = Vec::with_capacity(count);
    for i in 0..count {
        let code = codes[i / 4] >> (2 * (i % 4)) & 3;
        let difference = if code == 0 {
            common
        } else {
            // A quarter, half or all of the size.
            let (number, next) = rest.split_at_checked((SIZE / 4) << (code - 1))?;
            rest = next;
            little_endian(number)
        };
        value = value.wrapping_add(difference);
        if SIZE == 4 {
            value = i64::from(value as i32);
        }
        decoded.push(value);
    }
    Some(decoded)
}

/// A sign-extended number of 1, 2, 4 or 8 bytes.
fn little_endian(bytes: &[u8]) -> i64 {
    let magnitude = bytes.iter().rev().fold(0_u64, |value, &byte| value << 8 | u64::from(byte));
    let unused = 64 - 8 * bytes.len() as u32;
    (magnitude << unused).cast_signed() >> unused
}

/// Chunks of LZ4 blocks: their number, 0 for a single one without a size, and each with its size.
fn unpack(bytes: &[u8], most: usize) -> Option<Vec<u8>> {
    let (&count, mut rest) = bytes.split_first()?;
    let mut unpacked = Vec::new();
    if count == 0 {
        lz4(rest, most, &mut unpacked)?;
    }
    for _ in 0..count {
        let (size, next) = rest.split_at_checked(4)?;
        let size = chunks(size).next().map(i32::from_le_bytes)?;
        let (block, next) = next.split_at_checked(usize::try_from(size).ok()?)?;
        lz4(block, most, &mut unpacked)?;
        rest = next;
    }
    Some(unpacked)
}

/// Appends what a block of the LZ4 format holds; `None` if it is malformed or makes the whole longer than `most`.
fn lz4(mut block: &[u8], most: usize, out: &mut Vec<u8>) -> Option<()> {
    let start = out.len();
    while let Some((&token, rest)) = block.split_first() {
        block = rest;
        let literals = length(token >> 4, &mut block)?;
        let (literal, rest) = block.split_at_checked(literals)?;
        if literals > most - out.len() {
            return None;
        }
        out.extend_from_slice(literal);
        block = rest;
        if block.is_empty() {
            break;
        }
        let (offset, rest) = block.split_at_checked(2)?;
        block = rest;
        let offset = usize::from(u16::from_le_bytes([offset[0], offset[1]]));
        let matched = length(token & 15, &mut block)?.checked_add(4)?;
        if offset == 0 || offset > out.len() - start || matched > most - out.len() {
            return None;
        }
        // The source may overlap what is being written: then it repeats.
        let from = out.len() - offset;
        let mut copied = 0;
        while copied < matched {
            let step = (out.len() - from).min(matched - copied);
            out.extend_from_within(from..from + step);
            copied += step;
        }
    }
    Some(())
}

/// A length of which 15 in four bits and 255 in each following byte mean that there is more.
fn length(bits: u8, block: &mut &[u8]) -> Option<usize> {
    let mut length = usize::from(bits);
    if bits == 15 {
        loop {
            let (&byte, rest) = block.split_first()?;
            *block = rest;
            length = length.checked_add(usize::from(byte))?;
            if byte != 255 {
                break;
            }
        }
    }
    Some(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `unpack` with a limit that none of the cases here reaches.
    fn unpacked(bytes: &[u8]) -> Option<Vec<u8>> {
        unpack(bytes, 1000)
    }

    #[test]
    fn literals_and_matches() {
        assert_eq!(unpacked(b"\x00\x30abc").expect("a block"), b"abc");
        // Two bytes, then six more from two back, which overlaps.
        assert_eq!(unpacked(b"\x00\x22ab\x02\x00\x10c").expect("a block"), b"ababababc");
        // 15 + 255 + 1 literals.
        let long = [&b"\x00\xf0\xff\x01"[..], &[7; 271]].concat();
        assert_eq!(unpacked(&long).expect("a block"), [7; 271]);
        // Two chunks.
        assert_eq!(unpacked(b"\x02\x02\0\0\0\x10a\x02\0\0\0\x10b").expect("blocks"), b"ab");
    }

    #[test]
    fn malformed_blocks() {
        for bytes in [
            &b""[..],
            b"\x00\x30ab",
            b"\x00\x10a\x02\x00\x00",
            b"\x00\x10a\x00\x00\x00",
            b"\x00\x10a\x01",
            b"\x00\xf0\xff",
            b"\x01\xff\xff\xff\xff\x10a",
            b"\x02\x02\0\0\0\x10a",
        ] {
            assert_eq!(unpacked(bytes), None, "{bytes:?}");
        }
        assert_eq!(unpack(b"\x00\x30abc", 2), None);
        assert_eq!(unpack(b"\x00\x1fa\x01\x00\xff\xff\xff\xff\x00", 100), None);
    }

    #[test]
    fn differences_of_all_widths() {
        // Common difference 1; codes 0, 1, 2, 3, 0.
        let bytes = [1, 0, 0, 0, 0b1110_0100, 0, 0xfe, 0x00, 0x01, 0xff, 0xff, 0xff, 0x7f];
        let expected = [1, -1, 255, 255 + i64::from(i32::MAX) - (1 << 32), 255 + i64::from(i32::MAX) - (1 << 32) + 1];
        assert_eq!(decode::<4>(&bytes, 5).expect("integers"), expected);
        assert_eq!(decode::<4>(&bytes[..12], 5), None);
        assert_eq!(decode::<4>(&bytes, 100), None);
        let wide = [5, 0, 0, 0, 0, 0, 0, 0, 0b0000_0100, 0xff, 0xff];
        assert_eq!(decode::<8>(&wide, 3).expect("integers"), [5, 4, 9]);
    }
}
