//! The pipeline cache on disk: what a driver learnt while it made pipelines, for the next start of the program.
//!
//! A driver trusts the data it is given, so the file carries a check sum of ours before Vulkan's own header:
//!
//! | bytes | content |
//! |---|---|
//! | 0..8 | `OSCPIPE1` |
//! | 8..16 | FNV-1a hash of the rest, 64 bits, little endian |
//! | 16.. | what Vulkan gave |

use std::{fs, io, path::Path, sync::PoisonError};

use ash::vk;

use crate::{Device, GpuError, info::CacheIdentity, owned::Owned};

const MAGIC: &[u8; 8] = b"OSCPIPE1";

impl Device {
    /// Starts from the pipelines in a file that [`Self::save_pipeline_cache`] has written. Call it before making pipelines.
    ///
    /// Returns whether the file was used: not if it is missing, damaged, or of another device or driver version.
    pub fn load_pipeline_cache(&self, path: &Path) -> Result<bool, GpuError> {
        let file = match fs::read(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
            Err(source) => return Err(failure(path, source)),
        };
        let Some(data) = unpack(&file).filter(|data| identity(data) == Some(self.shared.cache_identity)) else {
            return Ok(false);
        };
        let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
        // SAFETY: the hash says that the data is what Vulkan once gave, and its header names this device and driver.
        let raw = unsafe { self.raw().create_pipeline_cache(&info, None) }
            .map_err(|result| GpuError::from_vulkan("loading the pipeline cache", result))?;
        let cache = Owned::new(&self.shared.raw, raw, "pipeline cache");
        *self.shared.cache.write().unwrap_or_else(PoisonError::into_inner) = cache;
        Ok(true)
    }

    /// Writes the cache of all pipelines made so far. The file appears whole or not at all.
    pub fn save_pipeline_cache(&self, path: &Path) -> Result<(), GpuError> {
        let cache = self.shared.cache.read().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the cache is alive and of this device.
        let data = unsafe { self.raw().get_pipeline_cache_data(cache.raw) }
            .map_err(|result| GpuError::from_vulkan("saving the pipeline cache", result))?;
        drop(cache);
        let mut temporary = path.as_os_str().to_owned();
        temporary.push(format!(".{}.tmp", std::process::id()));
        let written = fs::write(&temporary, pack(&data)).and_then(|()| fs::rename(&temporary, path));
        written.map_err(|source| {
            // The error that matters is the first; the file may not even exist.
            let _ = fs::remove_file(&temporary);
            failure(path, source)
        })
    }
}

fn failure(path: &Path, source: io::Error) -> GpuError {
    GpuError::PipelineCache { path: path.display().to_string(), source }
}

fn pack(data: &[u8]) -> Vec<u8> {
    [MAGIC, hash(data).to_le_bytes().as_slice(), data].concat()
}

fn unpack(file: &[u8]) -> Option<&[u8]> {
    let (sum, data) = file.strip_prefix(MAGIC)?.split_first_chunk::<8>()?;
    (hash(data) == u64::from_le_bytes(*sum)).then_some(data)
}

/// FNV-1a with the published 64-bit offset basis and prime.
fn hash(data: &[u8]) -> u64 {
    data.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Whose data it is, by `VkPipelineCacheHeaderVersionOne`: length, version, vendor, device, UUID.
fn identity(data: &[u8]) -> Option<CacheIdentity> {
    let word = |index: usize| data.get(4 * index..4 * index + 4)?.try_into().ok().map(u32::from_le_bytes);
    let uuid = data.get(16..32)?.try_into().ok()?;
    (word(1)? == 1).then_some(())?;
    Some(CacheIdentity { vendor: word(2)?, device: word(3)?, uuid })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header() -> Vec<u8> {
        let words = [32u32, 1, 0x10005, 7].into_iter().flat_map(u32::to_le_bytes);
        words.chain([9; 16]).chain([1, 2, 3]).collect()
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        assert_eq!(unpack(&pack(&header())), Some(header().as_slice()));
        assert_eq!(unpack(&pack(&[])), Some([].as_slice()));
    }

    #[test]
    fn damage_is_noticed() {
        let whole = pack(&header());
        for position in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[position] ^= 1;
            assert_eq!(unpack(&damaged), None, "byte {position}");
            assert_eq!(unpack(&whole[..position]), None, "length {position}");
        }
    }

    #[test]
    fn the_owner_is_read_from_the_header() {
        assert_eq!(identity(&header()), Some(CacheIdentity { vendor: 0x10005, device: 7, uuid: [9; 16] }));
        assert_eq!(identity(&header()[..31]), None);
    }
}
