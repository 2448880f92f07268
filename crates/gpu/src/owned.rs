//! Vulkan objects that destroy themselves.
//!
//! Every object is wrapped the moment it exists, so an error on the way to a larger thing leaks nothing.

use std::{ffi::CString, sync::Arc};

use ash::{ext, vk};

use crate::instance::Instance;

/// The logical device and the extension functions that go with it.
///
/// Destroyed when the last object made from it is gone, since each holds an `Arc` of it.
pub(crate) struct RawDevice {
    pub(crate) raw: ash::Device,
    pub(crate) debug: Option<ext::debug_utils::Device>,
    /// Whether it belongs to somebody else, who destroys it, and whose commands its queue runs too.
    pub(crate) is_borrowed: bool,
    /// Kept so that the instance outlives its device; after `raw` because Rust drops fields in order of declaration
    /// once `Drop::drop` has destroyed the device.
    _instance: Arc<Instance>,
}

impl RawDevice {
    /// Takes ownership of `raw`, a child of `instance`.
    pub(crate) fn new(instance: Arc<Instance>, raw: ash::Device) -> Self {
        Self::wrap(instance, raw, false)
    }

    /// A device of somebody else's, who destroys it.
    pub(crate) fn borrowed(instance: Arc<Instance>, raw: ash::Device) -> Self {
        Self::wrap(instance, raw, true)
    }

    fn wrap(instance: Arc<Instance>, raw: ash::Device, is_borrowed: bool) -> Self {
        let debug = instance.debug_utils.then(|| ext::debug_utils::Device::new(&instance.raw, &raw));
        Self { raw, debug, is_borrowed, _instance: instance }
    }

    /// Gives a Vulkan object the name that tools and validation messages show.
    pub(crate) fn set_name<H: vk::Handle>(&self, handle: H, name: &str) {
        let (Some(debug), Ok(name)) = (&self.debug, CString::new(name)) else { return };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle is alive and owned by this device; the name lives across the call. A failure costs a name only.
        let _ = unsafe { debug.set_debug_utils_object_name(&info) };
    }
}

impl Drop for RawDevice {
    fn drop(&mut self) {
        if self.is_borrowed {
            return;
        }
        // SAFETY: every child object holds an Arc of self, so all are destroyed, and none is in use by the GPU because
        // submissions wait before they let go of what they use.
        unsafe { self.raw.destroy_device(None) }
    }
}

/// A kind of Vulkan object that a device creates and destroys.
pub(crate) trait Destroy: vk::Handle + Copy {
    /// Destroys the object.
    ///
    /// # Safety
    /// `self` was created by `device`, is not yet destroyed, and the GPU does not use it any more.
    unsafe fn destroy(self, device: &ash::Device);
}

macro_rules! destroy {
    ($($handle:ident by $function:ident),* $(,)?) => {$(
        impl Destroy for vk::$handle {
            unsafe fn destroy(self, device: &ash::Device) {
                // SAFETY: the caller's obligation, passed on.
                unsafe { device.$function(self, None) }
            }
        }
    )*};
}

destroy! {
    Buffer by destroy_buffer,
    BufferView by destroy_buffer_view,
    CommandPool by destroy_command_pool,
    DescriptorSetLayout by destroy_descriptor_set_layout,
    Image by destroy_image,
    ImageView by destroy_image_view,
    Pipeline by destroy_pipeline,
    PipelineCache by destroy_pipeline_cache,
    PipelineLayout by destroy_pipeline_layout,
    QueryPool by destroy_query_pool,
    Sampler by destroy_sampler,
    Semaphore by destroy_semaphore,
    ShaderModule by destroy_shader_module,
}

/// A Vulkan object with the device it came from; destroyed on drop.
pub(crate) struct Owned<H: Destroy> {
    pub(crate) raw: H,
    device: Arc<RawDevice>,
}

impl<H: Destroy> Owned<H> {
    /// Takes ownership of `raw`, which `device` has just created, and names it.
    pub(crate) fn new(device: &Arc<RawDevice>, raw: H, name: &str) -> Self {
        device.set_name(raw, name);
        Self { raw, device: Arc::clone(device) }
    }
}

impl<H: Destroy> Drop for Owned<H> {
    fn drop(&mut self) {
        // SAFETY: `new` took ownership of an object of this device; submissions keep an Arc of what holds this until the GPU
        // is done with it.
        unsafe { self.raw.destroy(&self.device.raw) }
    }
}
