//! The pipeline cache on disk: what a driver learnt while it made pipelines, for the next start of the program.
//!
//! A driver trusts the data it is given, so the file carries a check sum of ours before Vulkan's own header:
//!
//! | bytes | content |
//! |---|---|
//! | 0..8 | `OSCPIPE1` |
//! | 8..16 | FNV-1a hash of the driver's version and the rest, 64 bits, little endian |
//! | 16.. | what Vulkan gave |
//!
//! The version is hashed because the UUID in Vulkan's header, which should change with it, does not on every driver: that of Mesa
//! 22.3's lavapipe is `val-%s`.

use std::{
    fs,
    io::{self, Write},
    path::Path,
    sync::PoisonError,
};

use ash::vk;
use tempfile::NamedTempFile;

use crate::{Device, GpuError, info::CacheIdentity, owned::Owned};

const MAGIC: &[u8; 8] = b"OSCPIPE1";

/// Longer files are neither read nor written: a cache of years of driver and shader versions starts anew.
const MAX_BYTES: u64 = 256 << 20;

impl Device {
    /// The name that a file of this device's pipelines should have in a folder that several devices share.
    ///
    /// It is the same for all versions of a driver, so that a new one replaces what it cannot use.
    pub fn pipeline_cache_name(&self) -> String {
        let CacheIdentity { vendor, device, .. } = self.shared.cache_identity;
        format!("pipelines-{vendor:04x}-{device:04x}.bin")
    }

    /// Adds the pipelines in a file that [`Self::save_pipeline_cache`] has written to those that the driver remembers, which
    /// then makes them in less time.
    ///
    /// Returns whether the file was used: not if it is missing, damaged, longer than 256 MiB, or of another device or driver
    /// version.
    ///
    /// # Errors
    /// If there is a file that cannot be read, or the driver fails.
    pub fn load_pipeline_cache(&self, path: &Path) -> Result<bool, GpuError> {
        let Some(data) = self.read_cache(path)? else { return Ok(false) };
        self.absorb(&data)?;
        Ok(true)
    }

    /// Writes all pipelines that the driver remembers, and those that other processes have saved in the file meanwhile. Missing
    /// folders are made.
    ///
    /// The file appears whole or not at all, and stays untouched if it has all of them. Returns whether it was written: neither
    /// then, nor if it would be longer than 256 MiB.
    ///
    /// # Errors
    /// If the file cannot be read or written, or the driver fails.
    pub fn save_pipeline_cache(&self, path: &Path) -> Result<bool, GpuError> {
        let found = self.read_cache(path)?;
        if let Some(found) = &found {
            self.absorb(found)?;
        }
        let data = self.cache_data()?;
        if found.as_ref() == Some(&data) || data.len() as u64 > MAX_BYTES {
            return Ok(false);
        }
        replace(path, &pack(&data, &self.info().driver_info)).map_err(|source| failure(path, source))?;
        Ok(true)
    }

    /// What Vulkan gave when the file was written, if the file is whole and of this device and driver.
    fn read_cache(&self, path: &Path) -> Result<Option<Vec<u8>>, GpuError> {
        let file = match read(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(source) => return Err(failure(path, source)),
        };
        let data = file.as_deref().and_then(|file| unpack(file, &self.info().driver_info));
        let data = data.filter(|data| identity(data) == Some(self.shared.cache_identity));
        Ok(data.map(<[u8]>::to_vec))
    }

    /// Puts a cache with this data, and all that the present one has, in the place of the present one.
    fn absorb(&self, data: &[u8]) -> Result<(), GpuError> {
        let failed = |result| GpuError::from_vulkan("loading the pipeline cache", result);
        let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
        // SAFETY: the hash says that the data is what Vulkan once gave, and its header names this device and driver.
        let raw = unsafe { self.raw().create_pipeline_cache(&info, None) }.map_err(failed)?;
        let cache = Owned::new(&self.shared.raw, raw, "pipeline cache");
        let mut present = self.shared.cache.write().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: both caches are alive, of this device, and used by this thread alone: one is new, the other locked.
        unsafe { self.raw().merge_pipeline_caches(cache.raw, &[present.raw]) }.map_err(failed)?;
        *present = cache;
        Ok(())
    }

    fn cache_data(&self) -> Result<Vec<u8>, GpuError> {
        let cache = self.shared.cache.read().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the cache is alive and of this device.
        unsafe { self.raw().get_pipeline_cache_data(cache.raw) }
            .map_err(|result| GpuError::from_vulkan("saving the pipeline cache", result))
    }
}

fn failure(path: &Path, source: io::Error) -> GpuError {
    GpuError::PipelineCache { path: path.display().to_string(), source }
}

/// The bytes of a file, unless there are too many.
fn read(path: &Path) -> io::Result<Option<Vec<u8>>> {
    let bytes = fs::metadata(path)?.len();
    if bytes > MAX_BYTES { Ok(None) } else { fs::read(path).map(Some) }
}

/// Writes a file beside its place and moves it there: processes that do so at the same time see whole files only.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

fn pack(data: &[u8], version: &str) -> Vec<u8> {
    [MAGIC, hash(data, version).to_le_bytes().as_slice(), data].concat()
}

fn unpack<'f>(file: &'f [u8], version: &str) -> Option<&'f [u8]> {
    let (sum, data) = file.strip_prefix(MAGIC)?.split_first_chunk::<8>()?;
    (hash(data, version) == u64::from_le_bytes(*sum)).then_some(data)
}

/// FNV-1a with the published 64-bit offset basis and prime.
fn hash(data: &[u8], version: &str) -> u64 {
    let bytes = version.bytes().chain(data.iter().copied());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Whose data it is, by `VkPipelineCacheHeaderVersionOne`: length of the header, version, vendor, device, UUID.
fn identity(data: &[u8]) -> Option<CacheIdentity> {
    let word = |index: usize| data.get(4 * index..4 * index + 4)?.try_into().ok().map(u32::from_le_bytes);
    let uuid = data.get(16..32)?.try_into().ok()?;
    (word(0)? == 32 && word(1)? == 1).then_some(())?;
    Some(CacheIdentity { vendor: word(2)?, device: word(3)?, uuid })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DeviceDesc;

    fn header() -> Vec<u8> {
        let words = [32u32, 1, 0x10005, 7].into_iter().flat_map(u32::to_le_bytes);
        words.chain([9; 16]).chain([1, 2, 3]).collect()
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        assert_eq!(unpack(&pack(&header(), "1"), "1"), Some(header().as_slice()));
        assert_eq!(unpack(&pack(&[], "1"), "1"), Some([].as_slice()));
        assert_eq!(unpack(&pack(&header(), "1"), "2"), None, "another version of the driver");
    }

    #[test]
    fn damage_is_noticed() {
        let whole = pack(&header(), "1");
        for position in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[position] ^= 1;
            assert_eq!(unpack(&damaged, "1"), None, "byte {position}");
            assert_eq!(unpack(&whole[..position], "1"), None, "length {position}");
        }
    }

    #[test]
    fn the_owner_is_read_from_the_header() {
        assert_eq!(identity(&header()), Some(CacheIdentity { vendor: 0x10005, device: 7, uuid: [9; 16] }));
        assert_eq!(identity(&header()[..31]), None);
        for (byte, what) in [(0, "length"), (4, "version")] {
            let mut other = header();
            other[byte] += 1;
            assert_eq!(identity(&other), None, "another {what}");
        }
    }

    /// Vendor, device and driver are those of the header; a file that differs in any of them has a right hash all the same.
    #[test]
    fn files_of_other_devices_and_drivers_are_ignored_and_replaced() {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        let device = Device::new(&DeviceDesc { select, validation: true, ..DeviceDesc::default() }).unwrap();
        let (folder, version) = (tempfile::tempdir().unwrap(), &device.info().driver_info);
        let path = folder.path().join(device.pipeline_cache_name());
        assert!(device.save_pipeline_cache(&path).unwrap());
        let own = unpack(&fs::read(&path).unwrap(), version).unwrap().to_vec();
        for (byte, what) in [(8, "vendor"), (12, "device"), (16, "driver")] {
            let mut foreign = own.clone();
            foreign[byte] ^= 1;
            fs::write(&path, pack(&foreign, version)).unwrap();
            assert!(!device.load_pipeline_cache(&path).unwrap(), "another {what}");
        }
        fs::write(&path, pack(&own, "another version")).unwrap();
        assert!(!device.load_pipeline_cache(&path).unwrap(), "another version");
        assert!(device.save_pipeline_cache(&path).unwrap(), "what it cannot use is replaced");
        assert!(device.load_pipeline_cache(&path).unwrap());
        assert_eq!(device.validation_messages(), [""; 0]);
    }

    #[test]
    fn files_that_have_grown_too_long_are_not_read() {
        let file = tempfile::NamedTempFile::new().unwrap();
        file.as_file().set_len(MAX_BYTES + 1).unwrap();
        assert_eq!(read(file.path()).unwrap(), None);
    }
}
