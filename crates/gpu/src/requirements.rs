//! What a device is created with: one table for switching features on and for checking what somebody else has switched on.

use std::ffi::CStr;

use ash::{ext, khr, vk};

use crate::{
    DeviceError, Features,
    info::{Physical, examine},
};

/// Features and extensions that a device was or is to be created with, in the structures of `vkCreateDevice`.
///
/// A program that makes its own device starts from [`Self::wanted`], adds what it needs itself, and hands the same value to
/// [`Device::from_raw`](crate::Device::from_raw):
///
/// ```no_run
/// # use osculate_gpu::{Enabled, ash::{self, ext, khr, vk}};
/// # unsafe fn example(instance: &ash::Instance, physical: vk::PhysicalDevice, queues: &[vk::DeviceQueueCreateInfo<'_>])
/// # -> Result<(), Box<dyn std::error::Error>> {
/// let mut enabled = unsafe { Enabled::wanted(instance, physical)? };
/// enabled.core.sampler_anisotropy = vk::TRUE;
/// enabled.extensions.push(khr::swapchain::NAME);
/// let names = enabled.extension_names();
/// let (mut vulkan12, mut vulkan13) = (enabled.vulkan12, enabled.vulkan13);
/// let mut feedback = enabled.transform_feedback;
/// let mut info = vk::DeviceCreateInfo::default()
///     .queue_create_infos(queues)
///     .enabled_extension_names(&names)
///     .enabled_features(&enabled.core)
///     .push_next(&mut vulkan12)
///     .push_next(&mut vulkan13);
/// if enabled.extensions.contains(&ext::transform_feedback::NAME) {
///     info = info.push_next(&mut feedback);
/// }
/// let device = unsafe { instance.create_device(physical, &info, None)? };
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Enabled {
    /// Device extensions.
    pub extensions: Vec<&'static CStr>,
    /// Features of Vulkan 1.0.
    pub core: vk::PhysicalDeviceFeatures,
    /// Features of Vulkan 1.2.
    pub vulkan12: vk::PhysicalDeviceVulkan12Features<'static>,
    /// Features of Vulkan 1.3.
    pub vulkan13: vk::PhysicalDeviceVulkan13Features<'static>,
    /// Features of `VK_EXT_transform_feedback`.
    pub transform_feedback: vk::PhysicalDeviceTransformFeedbackFeaturesEXT<'static>,
}

/// Name and flag of a feature.
type Flag = (&'static str, fn(&mut Enabled) -> &mut vk::Bool32);

/// Features that every use of this crate needs.
const REQUIRED: [Flag; 6] = [
    ("robustBufferAccess", |enabled| &mut enabled.core.robust_buffer_access),
    ("scalarBlockLayout", |enabled| &mut enabled.vulkan12.scalar_block_layout),
    ("timelineSemaphore", |enabled| &mut enabled.vulkan12.timeline_semaphore),
    ("dynamicRendering", |enabled| &mut enabled.vulkan13.dynamic_rendering),
    ("synchronization2", |enabled| &mut enabled.vulkan13.synchronization2),
    ("maintenance4", |enabled| &mut enabled.vulkan13.maintenance4),
];

impl Enabled {
    /// What this crate needs and can make use of on a device: all that is required, and everything of [`Features`] that it has.
    ///
    /// # Errors
    /// If the device lacks something required; the error names it.
    ///
    /// # Safety
    /// The instance was made for Vulkan 1.3 or later, and the device is one of it.
    pub unsafe fn wanted(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Result<Self, DeviceError> {
        let found = examine(instance, 0, physical, false)?;
        match found.info.missing.first() {
            None => Ok(Self::of(&found, false)),
            Some(feature) => {
                Err(DeviceError::MissingFeature { device: found.info.name.clone(), feature: feature.clone() })
            }
        }
    }

    /// All that is required, and the optional features of [`Physical::info`]; with `presents` what windows need too.
    pub(crate) fn of(physical: &Physical, presents: bool) -> Self {
        let mut enabled = Self::default();
        REQUIRED.iter().for_each(|(_, flag)| *flag(&mut enabled) = vk::TRUE);
        enabled.switch_on(physical.info.features);
        let extensions = [
            (true, khr::push_descriptor::NAME),
            (physical.info.features.transform_feedback, ext::transform_feedback::NAME),
            (presents, khr::swapchain::NAME),
            (physical.extensions.portability_subset, khr::portability_subset::NAME),
        ];
        enabled.extensions.extend(extensions.into_iter().filter(|(wanted, _)| *wanted).map(|(_, name)| name));
        enabled
    }

    fn switch_on(&mut self, features: Features) {
        self.core.tessellation_shader = features.tessellation.into();
        self.core.fill_mode_non_solid = features.wireframe.into();
        self.core.pipeline_statistics_query = features.pipeline_statistics.into();
        self.transform_feedback.transform_feedback = features.transform_feedback.into();
    }

    /// The same without some optional features: to see what becomes of a program on a lesser device.
    #[must_use]
    pub fn without(mut self, features: Features) -> Self {
        self.switch_on(self.features().without(features));
        if features.transform_feedback {
            self.extensions.retain(|name| *name != ext::transform_feedback::NAME);
        }
        self
    }

    /// The optional features that are on.
    pub fn features(&self) -> Features {
        let on = |flag: vk::Bool32| flag == vk::TRUE;
        Features {
            tessellation: on(self.core.tessellation_shader),
            transform_feedback: on(self.transform_feedback.transform_feedback)
                && self.extensions.contains(&ext::transform_feedback::NAME),
            wireframe: on(self.core.fill_mode_non_solid),
            pipeline_statistics: on(self.core.pipeline_statistics_query),
        }
    }

    /// The names of the required features and extensions that are off.
    pub fn missing(&self) -> Vec<&'static str> {
        let mut all = self.clone();
        let off = REQUIRED.iter().filter(|(_, flag)| *flag(&mut all) != vk::TRUE).map(|(name, _)| *name);
        let extension = (!self.extensions.contains(&khr::push_descriptor::NAME)).then_some("VK_KHR_push_descriptor");
        off.collect::<Vec<_>>().into_iter().chain(extension).collect()
    }

    /// The extensions as `vkCreateDevice` takes them.
    pub fn extension_names(&self) -> Vec<*const std::ffi::c_char> {
        self.extensions.iter().map(|name| name.as_ptr()).collect()
    }
}

/// The features of a device of version 1.3; all that it has, and no extensions.
pub(crate) fn supported(instance: &ash::Instance, raw: vk::PhysicalDevice, has_feedback: bool) -> Enabled {
    let mut found = Enabled::default();
    let mut all = vk::PhysicalDeviceFeatures2::default().push_next(&mut found.vulkan12).push_next(&mut found.vulkan13);
    if has_feedback {
        all = all.push_next(&mut found.transform_feedback);
    }
    // SAFETY: `raw` comes from this instance, and the chain holds structures of its version and extensions.
    unsafe { instance.get_physical_device_features2(raw, &mut all) };
    found.core = all.features;
    // The chain goes with this function.
    found.vulkan12.p_next = std::ptr::null_mut();
    found.vulkan13.p_next = std::ptr::null_mut();
    found.transform_feedback.p_next = std::ptr::null_mut();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_required() -> Enabled {
        let mut enabled = Enabled { extensions: vec![khr::push_descriptor::NAME], ..Enabled::default() };
        REQUIRED.iter().for_each(|(_, flag)| *flag(&mut enabled) = vk::TRUE);
        enabled
    }

    #[test]
    fn what_is_off_is_named() {
        assert_eq!(all_required().missing(), [""; 0]);
        assert_eq!(Enabled::default().missing().len(), REQUIRED.len() + 1);
        for (name, flag) in REQUIRED {
            let mut enabled = all_required();
            *flag(&mut enabled) = vk::FALSE;
            assert_eq!(enabled.missing(), [name]);
        }
        let bare = Enabled { extensions: Vec::new(), ..all_required() };
        assert_eq!(bare.missing(), ["VK_KHR_push_descriptor"]);
    }

    #[test]
    fn optional_features_are_read_as_they_were_switched_on() {
        let mut enabled = all_required();
        assert_eq!(enabled.features(), Features::default());
        enabled.switch_on(Features::ALL);
        assert!(!enabled.features().transform_feedback, "the extension is missing");
        enabled.extensions.push(ext::transform_feedback::NAME);
        assert_eq!(enabled.features(), Features::ALL);
        let less = Features { tessellation: true, transform_feedback: true, ..Features::default() };
        let reduced = enabled.without(less);
        assert_eq!(reduced.features(), Features::ALL.without(less));
        assert_eq!(reduced.extensions, [khr::push_descriptor::NAME]);
        assert_eq!(reduced.missing(), [""; 0]);
    }
}
