//! The device: everything is made from it.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};

use ash::{ext, khr, vk};

use crate::{
    DeviceError, DeviceInfo, Enabled, Features, GpuError, MessageLog, WindowSystem,
    info::{CacheIdentity, Physical, enumerate},
    instance::Instance,
    memory::Memory,
    owned::{Owned, RawDevice},
    present::WindowFunctions,
    select::choose,
    submission::Commands,
};

/// How to open a device.
#[derive(Clone, Debug, Default)]
pub struct DeviceDesc {
    /// The device's number or a part of its name; `None` takes the best: discrete, integrated, virtual, then CPU.
    pub select: Option<String>,
    /// Switches on core and synchronization validation; what it says is in [`Device::validation_messages`].
    pub validation: bool,
    /// Name of the program, for drivers and tools.
    pub application: String,
    /// The system whose windows the device draws to, for [`Device::presenter`]; `None` leaves out what windows need.
    pub windows: Option<WindowSystem>,
    /// Optional features to leave off though the device has them: to see what becomes of a program on a lesser device.
    pub without: Features,
}

/// Lists the devices of this machine, those that cannot be opened (see [`DeviceInfo::missing`]) among them.
pub fn devices() -> Result<Vec<DeviceInfo>, DeviceError> {
    let instance = Instance::new("osculate", false, None)?;
    Ok(enumerate(&instance.raw, false)?.into_iter().map(|physical| physical.info).collect())
}

/// An open device. Clones share it; it closes when the last clone and the last object made from it are gone.
///
/// All methods of the device and of what is made from it may be called from any thread, at the same time too. Submissions run
/// in the order in which they are made; threads that submit at the same time are served in any order, and so is a thread that
/// reads or writes a [`Buffer`](crate::Buffer) by the host meanwhile.
#[derive(Clone)]
pub struct Device {
    pub(crate) shared: Arc<Shared>,
}

/// What the clones of a [`Device`] share. Field order is destruction order: children before `raw`.
pub(crate) struct Shared {
    queue: Mutex<Queue>,
    pub(crate) cache: RwLock<Owned<vk::PipelineCache>>,
    pub(crate) timeline: Owned<vk::Semaphore>,
    pub(crate) memory: Arc<Memory>,
    pub(crate) push_descriptor: khr::push_descriptor::Device,
    /// ash 0.38 has no methods for this extension, only its function pointers.
    pub(crate) transform_feedback: Option<ext::transform_feedback::Device>,
    pub(crate) windows: Option<WindowFunctions>,
    pub(crate) raw: Arc<RawDevice>,
    pub(crate) info: DeviceInfo,
    pub(crate) cache_identity: CacheIdentity,
    /// The bits of a timestamp that count.
    pub(crate) timestamp_mask: u64,
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) instance: Arc<Instance>,
}

/// The queue and what is used only together with it.
pub(crate) struct Queue {
    pub(crate) raw: vk::Queue,
    pub(crate) family: u32,
    /// Value of the timeline that the latest submission reaches.
    pub(crate) submitted: u64,
    /// Command buffers that no submission uses.
    pub(crate) idle: Vec<Commands>,
    /// Binary semaphores that the next submission waits for, and with it all later ones: acquired images of windows. Their
    /// [`Presenter`](crate::Presenter) keeps them alive and sees to it that they are waited for.
    pub(crate) waits: Vec<vk::Semaphore>,
}

impl Device {
    /// Opens a device.
    pub fn new(desc: &DeviceDesc) -> Result<Self, DeviceError> {
        let instance = Instance::new(&desc.application, desc.validation, desc.windows.as_ref())?;
        let presents = desc.windows.is_some();
        let mut devices = enumerate(&instance.raw, presents)?;
        let infos: Vec<DeviceInfo> = devices.iter().map(|physical| physical.info.clone()).collect();
        let physical = devices.swap_remove(choose(&infos, desc.select.as_deref())?).without(desc.without);
        let enabled = Enabled::of(&physical, presents);
        let raw = Arc::new(RawDevice::new(Arc::clone(&instance), create_device(&instance, &physical, &enabled)?));
        // SAFETY: the device was created with one queue of this family.
        let queue = unsafe { raw.raw.get_device_queue(physical.queue_family, 0) };
        raw.set_name(queue, "queue");
        Self::assemble(instance, raw, physical, queue, desc.windows.clone())
    }

    /// Makes what belongs to every device, around a logical device and a queue of `physical.queue_family`.
    pub(crate) fn assemble(
        instance: Arc<Instance>,
        raw: Arc<RawDevice>,
        physical: Physical,
        queue: vk::Queue,
        windows: Option<WindowSystem>,
    ) -> Result<Self, DeviceError> {
        let memory =
            Memory::new(&instance, &raw, physical.raw, physical.info.limits.max_memory_allocation).map_err(|_| {
                DeviceError::Vulkan { operation: "creating the memory allocator", result: vk::Result::ERROR_UNKNOWN }
            })?;
        tracing::debug!(device = physical.info.name, driver = physical.info.driver_info, "opened device");
        let shared = Shared {
            queue: Mutex::new(Queue {
                raw: queue,
                family: physical.queue_family,
                submitted: 0,
                idle: Vec::new(),
                waits: Vec::new(),
            }),
            cache: RwLock::new(empty_cache(&raw)?),
            timeline: create_timeline(&raw)?,
            memory,
            push_descriptor: khr::push_descriptor::Device::new(&instance.raw, &raw.raw),
            transform_feedback: (physical.info.features.transform_feedback)
                .then(|| ext::transform_feedback::Device::new(&instance.raw, &raw.raw)),
            windows: windows.map(|system| WindowFunctions::new(system, &instance, &raw)),
            raw,
            info: physical.info,
            cache_identity: physical.cache_identity,
            timestamp_mask: physical.timestamp_mask,
            physical: physical.raw,
            instance,
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// What the device is and can do.
    pub fn info(&self) -> &DeviceInfo {
        &self.shared.info
    }

    /// All warnings and errors of the validation layers so far; empty without [`DeviceDesc::validation`]. Messages that are
    /// known not to be defects are left out: `OutputNotConsumed`, since a stage may have outputs that not every pipeline reads.
    pub fn validation_messages(&self) -> Vec<String> {
        self.message_log().all()
    }

    /// The list behind [`Self::validation_messages`]; it outlives the device, so that messages about its end are seen too.
    pub fn message_log(&self) -> MessageLog {
        self.shared.instance.messages.clone()
    }

    /// Waits until everything submitted so far is done.
    pub fn wait_idle(&self) -> Result<(), GpuError> {
        let submitted = self.queue().submitted;
        self.wait_for(submitted, "waiting for the device")
    }

    pub(crate) fn raw(&self) -> &ash::Device {
        &self.shared.raw.raw
    }

    /// Whether both are one device.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }

    /// Exclusive use of the queue. After a panic elsewhere its state is still right: it changes only after a submission.
    pub(crate) fn queue(&self) -> MutexGuard<'_, Queue> {
        self.shared.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the timeline has reached `value`.
    pub(crate) fn wait_for(&self, value: u64, during: &str) -> Result<(), GpuError> {
        if value == 0 {
            return Ok(());
        }
        let (semaphores, values) = ([self.shared.timeline.raw], [value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the semaphore belongs to this device and lives as long as self.
        unsafe { self.raw().wait_semaphores(&info, u64::MAX) }.map_err(|result| GpuError::from_vulkan(during, result))
    }

    /// The error for a missing optional feature.
    pub(crate) fn missing(&self, what: impl Into<String>, feature: &'static str) -> GpuError {
        GpuError::MissingFeature { what: what.into(), feature, device: self.info().name.clone() }
    }
}

impl std::fmt::Debug for Device {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Device").field(&self.info().name).finish()
    }
}

/// Creates the logical device. What shaders may use beyond Vulkan's core is also held in `reflect`, which refuses the rest.
fn create_device(instance: &Instance, physical: &Physical, enabled: &Enabled) -> Result<ash::Device, DeviceError> {
    let (mut v12, mut v13, mut feedback) = (enabled.vulkan12, enabled.vulkan13, enabled.transform_feedback);
    let extensions = enabled.extension_names();
    let priorities = [1.0];
    let queues =
        [vk::DeviceQueueCreateInfo::default().queue_family_index(physical.queue_family).queue_priorities(&priorities)];
    let mut info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extensions)
        .enabled_features(&enabled.core)
        .push_next(&mut v12)
        .push_next(&mut v13);
    if enabled.features().transform_feedback {
        info = info.push_next(&mut feedback);
    }
    // SAFETY: all structures live across the call, and the device was found to have these extensions and features.
    unsafe { instance.raw.create_device(physical.raw, &info, None) }
        .map_err(|result| DeviceError::Vulkan { operation: "opening the Vulkan device", result })
}

fn empty_cache(raw: &Arc<RawDevice>) -> Result<Owned<vk::PipelineCache>, DeviceError> {
    // SAFETY: no initial data.
    let cache = unsafe { raw.raw.create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) }
        .map_err(|result| DeviceError::Vulkan { operation: "creating the pipeline cache", result })?;
    Ok(Owned::new(raw, cache, "pipeline cache"))
}

fn create_timeline(raw: &Arc<RawDevice>) -> Result<Owned<vk::Semaphore>, DeviceError> {
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
    // SAFETY: timeline semaphores were switched on.
    let semaphore = unsafe { raw.raw.create_semaphore(&info, None) }
        .map_err(|result| DeviceError::Vulkan { operation: "creating the timeline", result })?;
    Ok(Owned::new(raw, semaphore, "timeline"))
}
