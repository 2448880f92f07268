//! What a device is and can do.

use std::ffi::CStr;

use ash::{ext, khr, vk};

use crate::format::sample_flag;
use crate::requirements::supported;
use crate::texels;
use crate::{DeviceError, Enabled};

/// The kind of a device, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DeviceKind {
    /// A graphics card with memory of its own.
    Discrete,
    /// A graphics unit that shares the memory of the CPU.
    Integrated,
    /// A device of a virtual machine.
    Virtual,
    /// The CPU itself, such as llvmpipe.
    Cpu,
    /// Anything else.
    Other,
}

impl DeviceKind {
    fn new(kind: vk::PhysicalDeviceType) -> Self {
        match kind {
            vk::PhysicalDeviceType::DISCRETE_GPU => Self::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => Self::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => Self::Virtual,
            vk::PhysicalDeviceType::CPU => Self::Cpu,
            _ => Self::Other,
        }
    }
}

impl std::fmt::Display for DeviceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Cpu => "cpu",
            Self::Other => "other",
        })
    }
}

/// A device, as found on this machine.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct DeviceInfo {
    /// Position in the order in which Vulkan lists the devices; what a selection by number means.
    pub index: usize,
    /// The device's name for people.
    pub name: String,
    /// Its kind.
    pub kind: DeviceKind,
    /// Name of the driver.
    pub driver_name: String,
    /// Version of the driver, as the driver likes to write it.
    pub driver_info: String,
    /// Vulkan version, such as "1.3.230".
    pub api_version: String,
    /// Whether this is Mesa's llvmpipe, some of whose defects callers must design around.
    pub is_llvmpipe: bool,
    /// Its limits.
    pub limits: Limits,
    /// The optional features it has; of an open device those that are switched on.
    pub features: Features,
    /// Required features that it lacks; a device can be opened only if this is empty.
    pub missing: Vec<String>,
}

/// Limits of a device.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Limits {
    /// Most bytes of a storage buffer that a shader sees.
    pub max_storage_buffer_range: u64,
    /// Most bytes of a uniform buffer that a shader sees.
    pub max_uniform_buffer_range: u64,
    /// Most vectors of a buffer that a shader reads as an array of vectors.
    pub max_texels: u64,
    /// Offsets of storage buffers in bindings are multiples of this, in bytes.
    pub storage_buffer_alignment: u64,
    /// Offsets of uniform buffers in bindings are multiples of this, in bytes.
    pub uniform_buffer_alignment: u64,
    /// Most bytes in one memory allocation.
    pub max_memory_allocation: u64,
    /// Bytes of the largest of the device's own memories; that of the machine where the device has none of its own.
    pub device_memory: u64,
    /// Most bytes of push constants.
    pub max_push_constants: u32,
    /// Most buffers and images that one pipeline binds.
    pub max_push_descriptors: u32,
    /// Most storage buffers that one pipeline binds.
    pub max_pipeline_storage_buffers: u32,
    /// Most uniform buffers that one pipeline binds.
    pub max_pipeline_uniform_buffers: u32,
    /// Most images with samplers that one pipeline binds.
    pub max_pipeline_sampled_images: u32,
    /// Most storage images that one pipeline binds.
    pub max_pipeline_storage_images: u32,
    /// Most storage buffers that one stage of a pipeline uses.
    pub max_stage_storage_buffers: u32,
    /// Most uniform buffers that one stage of a pipeline uses.
    pub max_stage_uniform_buffers: u32,
    /// Most images with samplers that one stage of a pipeline uses.
    pub max_stage_sampled_images: u32,
    /// Most storage images that one stage of a pipeline uses.
    pub max_stage_storage_images: u32,
    /// Most buffers and images that one stage of a pipeline uses; in the fragment stage the colour target counts too.
    pub max_stage_resources: u32,
    /// Highest tessellation level; 0 without tessellation.
    pub max_tessellation_level: u32,
    /// Most points in a patch, in and out; 0 without tessellation.
    pub max_patch_vertices: u32,
    /// Most work groups of a dispatch, per dimension.
    pub max_work_groups: [u32; 3],
    /// Most invocations in a work group.
    pub max_work_group_invocations: u32,
    /// Widest and highest colour or depth target.
    pub max_target_size: u32,
    /// Sample counts that colour and depth targets take, ascending.
    pub sample_counts: Vec<u32>,
    /// Most bytes that one capture pass writes into one buffer; 0 without transform feedback.
    pub max_capture_buffer: u64,
    /// Most bytes per vertex that a capture pass writes; 0 without transform feedback.
    pub max_capture_stride: u32,
    /// Nanoseconds per tick of GPU time; 0 if GPU time cannot be measured.
    pub timestamp_period: f32,
}

impl Limits {
    /// How many storage buffers, uniform buffers, sampled images and storage images one pipeline binds.
    pub(crate) fn pipeline(&self) -> [u32; 4] {
        [
            self.max_pipeline_storage_buffers,
            self.max_pipeline_uniform_buffers,
            self.max_pipeline_sampled_images,
            self.max_pipeline_storage_images,
        ]
    }

    /// How many of each one stage uses.
    pub(crate) fn stage(&self) -> [u32; 4] {
        [
            self.max_stage_storage_buffers,
            self.max_stage_uniform_buffers,
            self.max_stage_sampled_images,
            self.max_stage_storage_images,
        ]
    }
}

/// Optional features of a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Features {
    /// `tessellationShader`: pipelines with [`Tessellation`](crate::Tessellation).
    pub tessellation: bool,
    /// `VK_EXT_transform_feedback` with `transformFeedbackQueries`, which count what was captured: capture passes.
    pub transform_feedback: bool,
    /// `fillModeNonSolid`: [`PolygonMode::Line`](crate::PolygonMode::Line).
    pub wireframe: bool,
    /// `pipelineStatisticsQuery`: counts of shader invocations.
    pub pipeline_statistics: bool,
}

impl Features {
    /// All of them.
    pub const ALL: Self =
        Self { tessellation: true, transform_feedback: true, wireframe: true, pipeline_statistics: true };

    /// Those that are not among others.
    #[must_use]
    pub fn without(self, others: Self) -> Self {
        Self {
            tessellation: self.tessellation && !others.tessellation,
            transform_feedback: self.transform_feedback && !others.transform_feedback,
            wireframe: self.wireframe && !others.wireframe,
            pipeline_statistics: self.pipeline_statistics && !others.pipeline_statistics,
        }
    }
}

/// What [`Features::tessellation`] stands for, in messages.
pub(crate) const TESSELLATION: &str = "tessellationShader";
/// What [`Features::transform_feedback`] stands for, in messages.
pub(crate) const TRANSFORM_FEEDBACK: &str = "VK_EXT_transform_feedback with transformFeedbackQueries";

/// A physical device and what was found out about it.
pub(crate) struct Physical {
    pub(crate) raw: vk::PhysicalDevice,
    pub(crate) info: DeviceInfo,
    /// A queue family with graphics and compute.
    pub(crate) queue_family: u32,
    /// The bits of a timestamp that count; none if the queue measures no time.
    pub(crate) timestamp_mask: u64,
    pub(crate) extensions: Extensions,
    /// What a pipeline cache made on this device starts with.
    pub(crate) cache_identity: CacheIdentity,
}

/// Device extensions that matter here.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Extensions {
    pub(crate) push_descriptor: bool,
    pub(crate) transform_feedback: bool,
    pub(crate) swapchain: bool,
    pub(crate) portability_subset: bool,
}

/// Vendor, device and driver version, as in the header of Vulkan's pipeline caches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CacheIdentity {
    pub(crate) vendor: u32,
    pub(crate) device: u32,
    pub(crate) uuid: [u8; vk::UUID_SIZE],
}

/// Lists the devices of an instance; with `presents` they must be able to draw to windows.
pub(crate) fn enumerate(instance: &ash::Instance, presents: bool) -> Result<Vec<Physical>, DeviceError> {
    // SAFETY: the instance is alive.
    let devices = unsafe { instance.enumerate_physical_devices() }
        .map_err(|result| DeviceError::Vulkan { operation: "listing the Vulkan devices", result })?;
    devices.into_iter().enumerate().map(|(index, raw)| examine(instance, index, raw, presents)).collect()
}

/// Finds out what one device is and can do.
pub(crate) fn examine(
    instance: &ash::Instance,
    index: usize,
    raw: vk::PhysicalDevice,
    presents: bool,
) -> Result<Physical, DeviceError> {
    let extensions = find_extensions(instance, raw)?;
    // SAFETY: `raw` comes from this instance.
    let version = unsafe { instance.get_physical_device_properties(raw) }.api_version;
    // A device older than 1.3 may be listed, but must not be asked with 1.3's structures.
    let modern = version >= vk::API_VERSION_1_3;
    let supported = if modern { find_features(instance, raw, extensions) } else { Enabled::default() };
    let mut missing = vec!["Vulkan 1.3".to_owned()];
    if modern {
        missing = supported.missing().into_iter().map(str::to_owned).collect();
        missing.extend(texels::missing(instance, raw));
    }
    if presents && !extensions.swapchain {
        missing.push("VK_KHR_swapchain, which windows need".to_owned());
    }
    let queue_family = find_queue_family(instance, raw);
    if queue_family.is_none() {
        missing.push("a queue with graphics and compute".to_owned());
    }
    let (queue_family, timestamp_mask) = queue_family.unwrap_or_default();
    let Properties { info, cache_identity, counts_captures } = find_properties(instance, raw, modern, extensions);
    let features = supported.features();
    let mut info = DeviceInfo { index, api_version: version_text(version), features, missing, ..info };
    info.features.transform_feedback &= counts_captures;
    close(&mut info.limits, info.features, timestamp_mask);
    Ok(Physical { raw, info, queue_family, timestamp_mask, extensions, cache_identity })
}

impl Physical {
    /// The same device with fewer features.
    pub(crate) fn without(mut self, features: Features) -> Self {
        self.info.features = self.info.features.without(features);
        close(&mut self.info.limits, self.info.features, self.timestamp_mask);
        self
    }
}

/// Zeroes the limits of what the device cannot do.
fn close(limits: &mut Limits, features: Features, timestamp_mask: u64) {
    if timestamp_mask == 0 {
        limits.timestamp_period = 0.0;
    }
    if !features.tessellation {
        (limits.max_tessellation_level, limits.max_patch_vertices) = (0, 0);
    }
    if !features.transform_feedback {
        (limits.max_capture_buffer, limits.max_capture_stride) = (0, 0);
    }
}

fn version_text(version: u32) -> String {
    let [major, minor, patch] =
        [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)];
    format!("{major}.{minor}.{patch}")
}

fn find_extensions(instance: &ash::Instance, raw: vk::PhysicalDevice) -> Result<Extensions, DeviceError> {
    // SAFETY: `raw` comes from this instance.
    let found = unsafe { instance.enumerate_device_extension_properties(raw) }
        .map_err(|result| DeviceError::Vulkan { operation: "listing the device extensions", result })?;
    let has = |name: &CStr| found.iter().any(|one| one.extension_name_as_c_str() == Ok(name));
    Ok(Extensions {
        push_descriptor: has(khr::push_descriptor::NAME),
        transform_feedback: has(ext::transform_feedback::NAME),
        swapchain: has(khr::swapchain::NAME),
        portability_subset: has(khr::portability_subset::NAME),
    })
}

/// The first queue family with graphics and compute, and the bits of its timestamps that count.
fn find_queue_family(instance: &ash::Instance, raw: vk::PhysicalDevice) -> Option<(u32, u64)> {
    (0..queue_families(instance, raw).len() as u32)
        .find_map(|family| Some((family, timestamp_mask(instance, raw, family)?)))
}

fn queue_families(instance: &ash::Instance, raw: vk::PhysicalDevice) -> Vec<vk::QueueFamilyProperties> {
    // SAFETY: `raw` comes from this instance.
    unsafe { instance.get_physical_device_queue_family_properties(raw) }
}

/// The bits of a queue family's timestamps that count; `None` unless it has graphics and compute.
pub(crate) fn timestamp_mask(instance: &ash::Instance, raw: vk::PhysicalDevice, family: u32) -> Option<u64> {
    let wanted = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    let family = *queue_families(instance, raw).get(family as usize)?;
    let mask = u64::MAX.checked_shr(64u32.saturating_sub(family.timestamp_valid_bits)).unwrap_or(0);
    family.queue_flags.contains(wanted).then_some(mask)
}

/// The features and, as far as they matter, extensions of a device of version 1.3.
fn find_features(instance: &ash::Instance, raw: vk::PhysicalDevice, extensions: Extensions) -> Enabled {
    let mut found = supported(instance, raw, extensions.transform_feedback);
    let names = [
        (extensions.push_descriptor, khr::push_descriptor::NAME),
        (extensions.transform_feedback, ext::transform_feedback::NAME),
    ];
    found.extensions.extend(names.into_iter().filter(|(has, _)| *has).map(|(_, name)| name));
    found
}

/// What [`find_properties`] finds.
struct Properties {
    /// Names, kind and limits; index, version, features and what is missing are left at their defaults.
    info: DeviceInfo,
    cache_identity: CacheIdentity,
    /// Transform feedback has queries of what was written.
    counts_captures: bool,
}

fn find_properties(
    instance: &ash::Instance,
    raw: vk::PhysicalDevice,
    modern: bool,
    extensions: Extensions,
) -> Properties {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
    let mut push = vk::PhysicalDevicePushDescriptorPropertiesKHR::default();
    let mut feedback = vk::PhysicalDeviceTransformFeedbackPropertiesEXT::default();
    let mut all = vk::PhysicalDeviceProperties2::default();
    if modern {
        all = all.push_next(&mut driver).push_next(&mut v11);
    }
    if extensions.push_descriptor {
        all = all.push_next(&mut push);
    }
    if extensions.transform_feedback {
        all = all.push_next(&mut feedback);
    }
    // SAFETY: `raw` comes from this instance, and the chain holds structures of its version and extensions.
    unsafe { instance.get_physical_device_properties2(raw, &mut all) };
    let core = all.properties;
    let limits = Limits {
        max_memory_allocation: v11.max_memory_allocation_size,
        device_memory: largest_heap(instance, raw),
        max_push_descriptors: push.max_push_descriptors,
        max_capture_buffer: feedback.max_transform_feedback_buffer_size,
        max_capture_stride: capture_stride(&feedback),
        ..core_limits(&core.limits)
    };
    let text = |name: Result<&CStr, _>| name.map_or_else(|_| String::new(), |name| name.to_string_lossy().into_owned());
    let info = DeviceInfo {
        index: 0,
        name: text(core.device_name_as_c_str()),
        kind: DeviceKind::new(core.device_type),
        driver_name: text(driver.driver_name_as_c_str()),
        driver_info: text(driver.driver_info_as_c_str()),
        api_version: String::new(),
        is_llvmpipe: driver.driver_id == vk::DriverId::MESA_LLVMPIPE,
        limits,
        features: Features::default(),
        missing: Vec::new(),
    };
    let cache_identity =
        CacheIdentity { vendor: core.vendor_id, device: core.device_id, uuid: core.pipeline_cache_uuid };
    Properties { info, cache_identity, counts_captures: feedback.transform_feedback_queries == vk::TRUE }
}

/// The stride that is within all limits of one vertex's data, which can be as long as the stride.
fn capture_stride(feedback: &vk::PhysicalDeviceTransformFeedbackPropertiesEXT<'_>) -> u32 {
    let data = feedback.max_transform_feedback_buffer_data_size.min(feedback.max_transform_feedback_stream_data_size);
    feedback.max_transform_feedback_buffer_data_stride.min(data)
}

/// Bytes of the largest heap that is the device's own.
fn largest_heap(instance: &ash::Instance, raw: vk::PhysicalDevice) -> u64 {
    // SAFETY: `raw` comes from this instance.
    let memory = unsafe { instance.get_physical_device_memory_properties(raw) };
    let own = |heap: &&vk::MemoryHeap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL);
    memory.memory_heaps_as_slice().iter().filter(own).map(|heap| heap.size).max().unwrap_or(0)
}

/// The limits of Vulkan 1.0.
fn core_limits(core: &vk::PhysicalDeviceLimits) -> Limits {
    let counts = core.framebuffer_color_sample_counts & core.framebuffer_depth_sample_counts;
    let samples =
        [1, 2, 4, 8, 16, 32].into_iter().filter(|&n| sample_flag(n).is_some_and(|flag| counts.contains(flag)));
    Limits {
        max_storage_buffer_range: core.max_storage_buffer_range.into(),
        max_texels: core.max_texel_buffer_elements.into(),
        max_uniform_buffer_range: core.max_uniform_buffer_range.into(),
        storage_buffer_alignment: core.min_storage_buffer_offset_alignment,
        uniform_buffer_alignment: core.min_uniform_buffer_offset_alignment,
        max_push_constants: core.max_push_constants_size,
        max_pipeline_storage_buffers: core.max_descriptor_set_storage_buffers,
        max_pipeline_uniform_buffers: core.max_descriptor_set_uniform_buffers,
        // An image with its sampler counts as both.
        max_pipeline_sampled_images: core.max_descriptor_set_sampled_images.min(core.max_descriptor_set_samplers),
        max_pipeline_storage_images: core.max_descriptor_set_storage_images,
        max_stage_storage_buffers: core.max_per_stage_descriptor_storage_buffers,
        max_stage_uniform_buffers: core.max_per_stage_descriptor_uniform_buffers,
        max_stage_sampled_images: core
            .max_per_stage_descriptor_sampled_images
            .min(core.max_per_stage_descriptor_samplers),
        max_stage_storage_images: core.max_per_stage_descriptor_storage_images,
        max_stage_resources: core.max_per_stage_resources,
        max_tessellation_level: core.max_tessellation_generation_level,
        max_patch_vertices: core.max_tessellation_patch_size,
        max_work_groups: core.max_compute_work_group_count,
        max_work_group_invocations: core.max_compute_work_group_invocations,
        max_target_size: core.max_framebuffer_width.min(core.max_framebuffer_height).min(core.max_image_dimension2_d),
        sample_counts: samples.collect(),
        timestamp_period: core.timestamp_period,
        ..Limits::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_device_cannot_do_has_no_limits() {
        let open = Limits { max_capture_buffer: 9, max_capture_stride: 8, timestamp_period: 1.0, ..Limits::default() };
        let can = Features { transform_feedback: true, ..Features::default() };
        let closed = |features, mask| {
            let mut limits = open.clone();
            close(&mut limits, features, mask);
            (limits.max_capture_buffer, limits.max_capture_stride, limits.timestamp_period)
        };
        assert_eq!(closed(can, 1), (9, 8, 1.0));
        assert_eq!(closed(Features::default(), 1), (0, 0, 1.0));
        assert_eq!(closed(can, 0), (9, 8, 0.0));
        let mut limits = Limits { max_patch_vertices: 32, max_tessellation_level: 64, ..Limits::default() };
        close(&mut limits, Features { tessellation: true, ..can }, 1);
        assert_eq!((limits.max_patch_vertices, limits.max_tessellation_level), (32, 64));
        close(&mut limits, can, 1);
        assert_eq!((limits.max_patch_vertices, limits.max_tessellation_level), (0, 0));
    }

    #[test]
    fn the_smallest_limit_of_a_vertexs_data_holds() {
        let limits = |stride, buffer, stream| {
            let all = vk::PhysicalDeviceTransformFeedbackPropertiesEXT::default();
            let all = all.max_transform_feedback_buffer_data_stride(stride);
            capture_stride(
                &all.max_transform_feedback_buffer_data_size(buffer).max_transform_feedback_stream_data_size(stream),
            )
        };
        assert_eq!([limits(1, 2, 3), limits(3, 1, 2), limits(2, 3, 1)], [1; 3]);
    }
}
