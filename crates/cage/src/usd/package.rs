//! Packages (`.usdz`): zip files without compression, of which the first file is the scene.

use std::ops::Range;

use super::UsdError;

/// The first bytes of a zip file.
pub(super) const MAGIC: &[u8] = b"PK\x03\x04";

/// Where the first file of a package lies. A local header is 30 bytes, a name and an extra field.
pub(super) fn first_file(bytes: &[u8]) -> Result<Range<usize>, UsdError> {
    let cut = UsdError::Package("it is cut short");
    let Some(header) = bytes.get(..30) else { return Err(cut) };
    let u16_at = |at: usize| usize::from(u16::from_le_bytes([header[at], header[at + 1]]));
    let u32_at = |at: usize| u16_at(at) | u16_at(at + 2) << 16;
    if u16_at(6) & 1 != 0 {
        return Err(UsdError::Package("it is encrypted"));
    }
    if u16_at(8) != 0 {
        return Err(UsdError::Package("its first file is compressed, which packages must not be"));
    }
    // The size follows the file where it was not known before.
    if u16_at(6) & 8 != 0 || u32_at(18) == u32::MAX as usize {
        return Err(UsdError::Package("the size of its first file is not in front of it"));
    }
    let start = 30 + u16_at(26) + u16_at(28);
    let range = start..start.saturating_add(u32_at(18));
    if bytes.get(range.clone()).is_none() { Err(cut) } else { Ok(range) }
}
