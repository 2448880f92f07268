//! A program with Vulkan objects of its own, under validation.

use std::{
    ffi::{CStr, c_char, c_void},
    sync::Mutex,
};

use osculate_gpu::{
    Device, DeviceError, Enabled, RawDeviceDesc,
    ash::{self, ext, vk},
};

/// Instance, device, queue and command pool, and what the validation layer has said.
pub(super) struct Own {
    messenger: vk::DebugUtilsMessengerEXT,
    debug: ext::debug_utils::Instance,
    pub(super) pool: vk::CommandPool,
    pub(super) queue: vk::Queue,
    pub(super) enabled: Enabled,
    pub(super) device: ash::Device,
    pub(super) physical: vk::PhysicalDevice,
    pub(super) instance: ash::Instance,
    entry: ash::Entry,
    messages: Box<Mutex<Vec<String>>>,
}

/// A picture of one colour and what it is read through.
pub(super) struct Canvas {
    pub(super) image: vk::Image,
    pub(super) view: vk::ImageView,
    memory: vk::DeviceMemory,
}

/// Memory that the host reads or writes.
pub(super) struct Shared {
    pub(super) buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    size: u64,
}

pub(super) const SIZE: u32 = 16;

impl Own {
    /// With everything that the library wants, as changed by `change`.
    pub(super) fn new(change: impl FnOnce(Enabled) -> Enabled) -> Self {
        // SAFETY: plain set-up; every structure lives across its call, and what is made is destroyed in `drop` once.
        unsafe {
            let entry = ash::Entry::load().unwrap();
            let messages = Box::new(Mutex::new(Vec::new()));
            let instance = instance(&entry);
            let debug = ext::debug_utils::Instance::new(&entry, &instance);
            let messenger = debug.create_debug_utils_messenger(&messenger(&messages), None).unwrap();
            let wanted = std::env::var("OSCULATE_DEVICE").unwrap_or_default().to_lowercase();
            let devices = instance.enumerate_physical_devices().unwrap();
            let name = |one: &vk::PhysicalDevice| {
                let properties = instance.get_physical_device_properties(*one);
                properties.device_name_as_c_str().unwrap().to_string_lossy().to_lowercase()
            };
            let physical = devices.into_iter().find(|one| name(one).contains(&wanted)).expect("a device of that name");
            let enabled = change(Enabled::wanted(&instance, physical).unwrap());
            let device = device(&instance, physical, &enabled);
            let queue = device.get_device_queue(0, 0);
            let pool = device.create_command_pool(&vk::CommandPoolCreateInfo::default(), None).unwrap();
            Self { messenger, debug, pool, queue, enabled, device, physical, instance, entry, messages }
        }
    }

    /// The objects as the library takes them.
    pub(super) fn desc(&self) -> RawDeviceDesc<'_> {
        RawDeviceDesc {
            entry: self.entry.clone(),
            instance: self.instance.clone(),
            physical: self.physical,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: 0,
            enabled: &self.enabled,
            debug_utils: true,
        }
    }

    pub(super) fn lend(&self) -> Result<Device, DeviceError> {
        // SAFETY: the handles belong together and outlive the library's objects in these tests, which use one thread.
        unsafe { Device::from_raw(self.desc()) }
    }

    /// A command buffer in the recording state.
    pub(super) fn begin(&self) -> vk::CommandBuffer {
        let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
        // SAFETY: the pool is ours.
        unsafe {
            let commands = self.device.allocate_command_buffers(&info).unwrap()[0];
            self.device.begin_command_buffer(commands, &vk::CommandBufferBeginInfo::default()).unwrap();
            commands
        }
    }

    /// Ends and submits commands; the fence is signalled when they have run.
    pub(super) fn submit(&self, commands: vk::CommandBuffer) -> vk::Fence {
        let buffers = [commands];
        // SAFETY: the commands are complete, and no other thread uses the queue.
        unsafe {
            self.device.end_command_buffer(commands).unwrap();
            let fence = self.device.create_fence(&vk::FenceCreateInfo::default(), None).unwrap();
            let info = vk::SubmitInfo::default().command_buffers(&buffers);
            self.device.queue_submit(self.queue, &[info], fence).unwrap();
            fence
        }
    }

    pub(super) fn wait(&self, fence: vk::Fence) {
        // SAFETY: the fence is ours and not in use afterwards.
        unsafe {
            self.device.wait_for_fences(&[fence], true, u64::MAX).unwrap();
            self.device.destroy_fence(fence, None);
        }
    }

    fn memory(&self, needs: vk::MemoryRequirements, wanted: vk::MemoryPropertyFlags) -> vk::DeviceMemory {
        // SAFETY: plain parameters.
        unsafe {
            let types = self.instance.get_physical_device_memory_properties(self.physical);
            let kind = (0..types.memory_type_count).find(|&kind| {
                needs.memory_type_bits >> kind & 1 == 1
                    && types.memory_types[kind as usize].property_flags.contains(wanted)
            });
            let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind.unwrap());
            self.device.allocate_memory(&info, None).unwrap()
        }
    }

    pub(super) fn canvas(&self) -> Canvas {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(vk::Format::R8G8B8A8_UNORM)
            .extent(vk::Extent3D { width: SIZE, height: SIZE, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: a small image in a format that every device draws to.
        unsafe {
            let image = self.device.create_image(&info, None).unwrap();
            let memory =
                self.memory(self.device.get_image_memory_requirements(image), vk::MemoryPropertyFlags::empty());
            self.device.bind_image_memory(image, memory, 0).unwrap();
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(vk::Format::R8G8B8A8_UNORM)
                .subresource_range(all());
            let view = self.device.create_image_view(&info, None).unwrap();
            Canvas { image, view, memory }
        }
    }

    pub(super) fn shared(&self, size: u64, usage: vk::BufferUsageFlags) -> Shared {
        let host = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // SAFETY: plain parameters.
        unsafe {
            let buffer =
                self.device.create_buffer(&vk::BufferCreateInfo::default().size(size).usage(usage), None).unwrap();
            let memory = self.memory(self.device.get_buffer_memory_requirements(buffer), host);
            self.device.bind_buffer_memory(buffer, memory, 0).unwrap();
            Shared { buffer, memory, size }
        }
    }

    /// Exchanges bytes with the memory; nothing is in flight.
    pub(super) fn touch<T>(&self, shared: &Shared, with: impl FnOnce(&mut [u8]) -> T) -> T {
        // SAFETY: the memory is mapped whole, once, and coherent.
        unsafe {
            let flags = vk::MemoryMapFlags::empty();
            let start = self.device.map_memory(shared.memory, 0, vk::WHOLE_SIZE, flags).unwrap();
            let result = with(std::slice::from_raw_parts_mut(start.cast(), shared.size as usize));
            self.device.unmap_memory(shared.memory);
            result
        }
    }

    /// Begins a rendering on pictures, cleared to black.
    pub(super) fn begin_rendering(&self, commands: vk::CommandBuffer, canvases: &[&Canvas]) {
        let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        canvases.iter().for_each(|canvas| self.change(commands, canvas, vk::ImageLayout::UNDEFINED, layout));
        let colors: Vec<_> = canvases
            .iter()
            .map(|canvas| {
                vk::RenderingAttachmentInfo::default()
                    .image_view(canvas.view)
                    .image_layout(layout)
                    .load_op(vk::AttachmentLoadOp::CLEAR)
                    .store_op(vk::AttachmentStoreOp::STORE)
            })
            .collect();
        let extent = vk::Extent2D { width: SIZE, height: SIZE };
        let area = vk::Rect2D { extent, ..vk::Rect2D::default() };
        let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&colors);
        // SAFETY: the pictures are in the layout that was named.
        unsafe { self.device.cmd_begin_rendering(commands, &info) }
    }

    /// Ends the rendering and copies a picture.
    pub(super) fn end_rendering(&self, commands: vk::CommandBuffer, canvas: &Canvas, to: &Shared) {
        let (from, source) = (vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let subresource = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let region = vk::BufferImageCopy::default().image_subresource(subresource).image_extent(vk::Extent3D {
            width: SIZE,
            height: SIZE,
            depth: 1,
        });
        // SAFETY: the buffer takes all texels.
        unsafe { self.device.cmd_end_rendering(commands) };
        self.change(commands, canvas, from, source);
        // SAFETY: as above.
        unsafe { self.device.cmd_copy_image_to_buffer(commands, canvas.image, source, to.buffer, &[region]) }
    }

    fn change(&self, commands: vk::CommandBuffer, canvas: &Canvas, from: vk::ImageLayout, to: vk::ImageLayout) {
        let barrier = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
            .old_layout(from)
            .new_layout(to)
            .image(canvas.image)
            .subresource_range(all())];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barrier);
        // SAFETY: outside of a rendering.
        unsafe { self.device.cmd_pipeline_barrier2(commands, &info) }
    }

    pub(super) fn destroy(&self, canvas: Canvas) {
        // SAFETY: nothing is in flight.
        unsafe {
            self.device.destroy_image_view(canvas.view, None);
            self.device.destroy_image(canvas.image, None);
            self.device.free_memory(canvas.memory, None);
        }
    }

    pub(super) fn free(&self, shared: Shared) {
        // SAFETY: nothing is in flight.
        unsafe {
            self.device.destroy_buffer(shared.buffer, None);
            self.device.free_memory(shared.memory, None);
        }
    }

    /// What validation has said so far.
    pub(super) fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap().clone()
    }
}

impl Drop for Own {
    /// Destroys everything. Validation lists objects of the device that are left over.
    fn drop(&mut self) {
        // SAFETY: nothing is in flight, children go first.
        unsafe {
            self.device.device_wait_idle().unwrap();
            self.device.destroy_command_pool(self.pool, None);
            self.device.destroy_device(None);
            self.debug.destroy_debug_utils_messenger(self.messenger, None);
            self.instance.destroy_instance(None);
        }
        let messages = self.messages();
        assert!(messages.is_empty() || std::thread::panicking(), "validation messages:\n{}", messages.join("\n"));
    }
}

fn all() -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1)
}

unsafe fn instance(entry: &ash::Entry) -> ash::Instance {
    let layers: [*const c_char; 1] = [c"VK_LAYER_KHRONOS_validation".as_ptr()];
    let extensions = [ext::debug_utils::NAME.as_ptr(), ext::validation_features::NAME.as_ptr()];
    let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
    let checks = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&checks);
    let info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_layer_names(&layers)
        .enabled_extension_names(&extensions)
        .push_next(&mut features);
    // SAFETY: all structures live across the call.
    unsafe { entry.create_instance(&info, None) }.expect("these tests need Vulkan and its validation layer")
}

unsafe fn device(instance: &ash::Instance, physical: vk::PhysicalDevice, enabled: &Enabled) -> ash::Device {
    let names = enabled.extension_names();
    let (mut v12, mut v13, mut feedback) = (enabled.vulkan12, enabled.vulkan13, enabled.transform_feedback);
    let queues = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
    let mut info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&names)
        .enabled_features(&enabled.core)
        .push_next(&mut v12)
        .push_next(&mut v13);
    if enabled.extensions.contains(&ext::transform_feedback::NAME) {
        info = info.push_next(&mut feedback);
    }
    // SAFETY: all structures live across the call.
    unsafe { instance.create_device(physical, &info, None) }.unwrap()
}

fn messenger(messages: &Mutex<Vec<String>>) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR)
        .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
        .pfn_user_callback(Some(said))
        .user_data(std::ptr::from_ref(messages).cast_mut().cast())
}

unsafe extern "system" fn said(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    log: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes a valid structure with a string; the log outlives the messenger.
    let (text, log) =
        unsafe { (CStr::from_ptr((*data).p_message).to_string_lossy(), &*log.cast::<Mutex<Vec<String>>>()) };
    log.lock().unwrap().push(text.into_owned());
    vk::FALSE
}
