//! Devices that belong to somebody else: a program with Vulkan objects of its own lends them.

use std::sync::Arc;

use ash::vk;

use crate::{
    Device, DeviceError, Enabled,
    info::{Physical, examine, timestamp_mask},
    instance::Instance,
    owned::RawDevice,
};

/// The Vulkan objects of a program, to be used by [`Device::from_raw`]. Handles are borrowed: nothing of them is ever destroyed.
#[derive(Clone)]
pub struct RawDeviceDesc<'a> {
    /// The loader.
    pub entry: ash::Entry,
    /// The instance, made for Vulkan 1.3 or later.
    pub instance: ash::Instance,
    /// The physical device.
    pub physical: vk::PhysicalDevice,
    /// The logical device.
    pub device: ash::Device,
    /// A queue with graphics and compute.
    pub queue: vk::Queue,
    /// The family of the queue.
    pub queue_family: u32,
    /// What the logical device was created with. What is not said here is taken to be off.
    pub enabled: &'a Enabled,
    /// Whether the instance was made with `VK_EXT_debug_utils`: objects then get names, and passes labels.
    pub debug_utils: bool,
}

impl Device {
    /// A device around Vulkan objects of the caller's. Its memory comes from an allocator of its own on the caller's device.
    ///
    /// Optional features that were not switched on are absent from [`DeviceInfo::features`](crate::DeviceInfo::features), and
    /// what needs them is an error that names them. There are no windows ([`Device::presenter`] fails), and no list of validation
    /// messages: those go to the caller's messenger.
    ///
    /// Work goes to the GPU in two ways. [`Self::submit`] and what rests on it (uploads, downloads, making surfaces) hands it to
    /// the queue at once, ordered against all that was submitted there before. [`Self::encode`] and [`Self::encode_draws`] write
    /// it into command buffers of the caller's.
    ///
    /// # Errors
    /// If the device lacks something required, or it was not switched on; the error names it.
    ///
    /// # Safety
    /// * The handles are valid and belong together; `enabled` and `debug_utils` are true.
    /// * Instance and device live until this device, its clones, and all objects made from them are gone.
    /// * The queue is used by one thread at a time, as Vulkan has it: while a call on this device may submit or wait (anything but
    ///   [`Self::encode`], [`Self::encode_draws`] and the making of buffers, shaders and pipelines), nobody else uses the queue. A
    ///   program whose threads share queues gives this device one of its own, of the same family as that which its commands run on.
    pub unsafe fn from_raw(desc: RawDeviceDesc<'_>) -> Result<Self, DeviceError> {
        let instance = Instance::borrowed(desc.entry, desc.instance, desc.debug_utils);
        let physical = describe(&instance.raw, desc.physical, desc.queue_family, desc.enabled)?;
        let raw = Arc::new(RawDevice::borrowed(Arc::clone(&instance), desc.device));
        Self::assemble(instance, raw, physical, desc.queue, None)
    }
}

/// What the device can do as it was created.
fn describe(
    instance: &ash::Instance,
    raw: vk::PhysicalDevice,
    queue_family: u32,
    enabled: &Enabled,
) -> Result<Physical, DeviceError> {
    // SAFETY: the instance is alive, by the promise of `from_raw`'s caller.
    let all = unsafe { instance.enumerate_physical_devices() }
        .map_err(|result| DeviceError::Vulkan { operation: "listing the Vulkan devices", result })?;
    let index = all.iter().position(|one| *one == raw).unwrap_or(0);
    let mut found = examine(instance, index, raw, false)?;
    let device = || found.info.name.clone();
    if let Some(feature) = found.info.missing.first() {
        return Err(DeviceError::MissingFeature { device: device(), feature: feature.clone() });
    }
    if let Some(feature) = enabled.missing().first() {
        return Err(DeviceError::NotEnabled { device: device(), feature: (*feature).to_owned() });
    }
    let Some(mask) = timestamp_mask(instance, raw, queue_family) else {
        let feature = format!("graphics and compute in queue family {queue_family}");
        return Err(DeviceError::NotEnabled { device: device(), feature });
    };
    (found.queue_family, found.timestamp_mask) = (queue_family, mask);
    let off = found.info.features.without(enabled.features());
    Ok(found.without(off))
}
