//! The renderer's own Vulkan: instance, device, queue, images, a descriptor set. Nothing here knows of the library but [`Vulkan::new`], which asks what it
//! wants to be switched on, and [`Vulkan::lend`].

use std::ffi::{CStr, c_char, c_void};
use std::sync::Mutex;

use osculate::gpu::ash::{self, ext, vk};
use osculate::gpu::{Device, Enabled, RawDeviceDesc};

use crate::common::Result;

pub(crate) const COLOR: vk::Format = vk::Format::R8G8B8A8_SRGB;
pub(crate) const DEPTH: vk::Format = vk::Format::D32_SFLOAT;

/// Instance and device of the renderer.
pub(crate) struct Vulkan {
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    pub(crate) queue: vk::Queue,
    pub(crate) family: u32,
    enabled: Enabled,
    pub(crate) device: ash::Device,
    physical: vk::PhysicalDevice,
    instance: ash::Instance,
    entry: ash::Entry,
    messages: Box<Mutex<Vec<String>>>,
}

/// A piece of memory with an image or a buffer in it.
pub(crate) struct Picture {
    pub(crate) image: vk::Image,
    pub(crate) view: vk::ImageView,
    memory: vk::DeviceMemory,
}

pub(crate) struct HostBuffer {
    pub(crate) buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    bytes: *mut u8,
    size: usize,
}

/// A descriptor set with one uniform buffer.
pub(crate) struct Scene {
    pub(crate) layout: vk::DescriptorSetLayout,
    pub(crate) set: vk::DescriptorSet,
    pool: vk::DescriptorPool,
}

impl Vulkan {
    pub(crate) fn new(validation: bool) -> Result<Self> {
        let messages = Box::new(Mutex::new(Vec::new()));
        // SAFETY: plain set-up. Every structure lives across its call, and the log outlives the messenger.
        unsafe {
            let entry = ash::Entry::load()?;
            let instance = create_instance(&entry, validation)?;
            let messenger = match validation {
                true => {
                    let functions = ext::debug_utils::Instance::new(&entry, &instance);
                    let messenger = functions.create_debug_utils_messenger(&messenger_info(&messages), None)?;
                    Some((functions, messenger))
                }
                false => None,
            };
            let physical = choose(&instance)?;
            let family = instance
                .get_physical_device_queue_family_properties(physical)
                .iter()
                .position(|one| one.queue_flags.contains(vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE))
                .ok_or("the device has no queue for graphics and compute")? as u32;
            // What the library wants. A renderer adds here what it wants itself.
            let enabled = Enabled::wanted(&instance, physical)?;
            let device = create_device(&instance, physical, family, &enabled)?;
            let queue = device.get_device_queue(family, 0);
            Ok(Self { messenger, queue, family, enabled, device, physical, instance, entry, messages })
        }
    }

    /// Lends everything to the library.
    ///
    /// # Safety
    /// What the library makes goes before this does, and one thread uses the queue.
    pub(crate) unsafe fn lend(&self) -> Result<Device> {
        let desc = RawDeviceDesc {
            entry: self.entry.clone(),
            instance: self.instance.clone(),
            physical: self.physical,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: self.family,
            enabled: &self.enabled,
            debug_utils: self.messenger.is_some(),
        };
        // SAFETY: the handles belong together; the rest is our caller's promise.
        Ok(unsafe { Device::from_raw(desc) }?)
    }

    /// What validation has said so far.
    pub(crate) fn messages(&self) -> Vec<String> {
        self.messages.lock().map(|messages| messages.clone()).unwrap_or_default()
    }

    fn allocate(&self, needs: vk::MemoryRequirements, wanted: vk::MemoryPropertyFlags) -> Result<vk::DeviceMemory> {
        // SAFETY: plain parameters.
        unsafe {
            let types = self.instance.get_physical_device_memory_properties(self.physical);
            let fits = |kind: &u32| {
                needs.memory_type_bits >> kind & 1 == 1
                    && types.memory_types[*kind as usize].property_flags.contains(wanted)
            };
            let kind = (0..types.memory_type_count).find(fits).ok_or("no memory of the wanted kind")?;
            let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind);
            Ok(self.device.allocate_memory(&info, None)?)
        }
    }

    /// An image to draw to.
    pub(crate) fn picture(
        &self,
        format: vk::Format,
        [width, height]: [u32; 2],
        usage: vk::ImageUsageFlags,
    ) -> Result<Picture> {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage);
        // SAFETY: a picture of moderate size in formats that every device draws to.
        unsafe {
            let image = self.device.create_image(&info, None)?;
            let needs = self.device.get_image_memory_requirements(image);
            let memory = self.allocate(needs, vk::MemoryPropertyFlags::empty())?;
            self.device.bind_image_memory(image, memory, 0)?;
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(format)
                .subresource_range(range(format));
            let view = self.device.create_image_view(&info, None)?;
            Ok(Picture { image, view, memory })
        }
    }

    /// A buffer that the host sees.
    pub(crate) fn host_buffer(&self, size: usize, usage: vk::BufferUsageFlags) -> Result<HostBuffer> {
        let host = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // SAFETY: plain parameters; the memory stays mapped.
        unsafe {
            let info = vk::BufferCreateInfo::default().size(size as u64).usage(usage);
            let buffer = self.device.create_buffer(&info, None)?;
            let memory = self.allocate(self.device.get_buffer_memory_requirements(buffer), host)?;
            self.device.bind_buffer_memory(buffer, memory, 0)?;
            let bytes = self.device.map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?.cast();
            Ok(HostBuffer { buffer, memory, bytes, size })
        }
    }

    /// The renderer's descriptor set.
    pub(crate) fn scene(&self, uniform: &HostBuffer) -> Result<Scene> {
        let kind = vk::DescriptorType::UNIFORM_BUFFER;
        let bindings = [vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(kind)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::FRAGMENT)];
        let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: 1 }];
        let infos = [vk::DescriptorBufferInfo { buffer: uniform.buffer, offset: 0, range: vk::WHOLE_SIZE }];
        // SAFETY: plain parameters.
        unsafe {
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let layout = self.device.create_descriptor_set_layout(&info, None)?;
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = self.device.create_descriptor_pool(&info, None)?;
            let layouts = [layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            let set = self.device.allocate_descriptor_sets(&info)?[0];
            let write = vk::WriteDescriptorSet::default().dst_set(set).descriptor_type(kind).buffer_info(&infos);
            self.device.update_descriptor_sets(&[write], &[]);
            Ok(Scene { layout, set, pool })
        }
    }

    /// Destroys what was made by the functions above; nothing is in use any more.
    pub(crate) fn destroy(&self, pictures: Vec<Picture>, buffers: Vec<HostBuffer>, scene: Scene) {
        // SAFETY: our caller has waited.
        unsafe {
            for picture in pictures {
                self.device.destroy_image_view(picture.view, None);
                self.device.destroy_image(picture.image, None);
                self.device.free_memory(picture.memory, None);
            }
            for buffer in buffers {
                self.device.destroy_buffer(buffer.buffer, None);
                self.device.free_memory(buffer.memory, None);
            }
            self.device.destroy_descriptor_pool(scene.pool, None);
            self.device.destroy_descriptor_set_layout(scene.layout, None);
        }
    }
}

impl HostBuffer {
    /// Its bytes, which the device must not use meanwhile.
    pub(crate) fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: the memory is mapped, of that size, and lent out once at a time.
        unsafe { std::slice::from_raw_parts_mut(self.bytes, self.size) }
    }
}

impl Drop for Vulkan {
    /// The library's objects are gone by now. It has destroyed nothing of this.
    fn drop(&mut self) {
        // SAFETY: nothing is in use, children go first.
        unsafe {
            let _ = self.device.device_wait_idle();
            self.device.destroy_device(None);
            if let Some((functions, messenger)) = &self.messenger {
                functions.destroy_debug_utils_messenger(*messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}

/// All of an image.
pub(crate) fn range(format: vk::Format) -> vk::ImageSubresourceRange {
    let aspect = if format == DEPTH { vk::ImageAspectFlags::DEPTH } else { vk::ImageAspectFlags::COLOR };
    vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1)
}

unsafe fn create_instance(entry: &ash::Entry, validation: bool) -> Result<ash::Instance> {
    let application = vk::ApplicationInfo::default().application_name(c"embed").api_version(vk::API_VERSION_1_3);
    let (mut layers, mut extensions): (Vec<*const c_char>, Vec<*const c_char>) = (Vec::new(), Vec::new());
    let checks = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&checks);
    if validation {
        layers.push(c"VK_LAYER_KHRONOS_validation".as_ptr());
        extensions.extend([ext::debug_utils::NAME.as_ptr(), ext::validation_features::NAME.as_ptr()]);
    }
    let mut info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_layer_names(&layers)
        .enabled_extension_names(&extensions);
    if validation {
        info = info.push_next(&mut features);
    }
    // SAFETY: all structures live across the call.
    Ok(unsafe { entry.create_instance(&info, None) }?)
}

/// The device whose number or a part of whose name is in `OSCULATE_DEVICE`, or else the first.
unsafe fn choose(instance: &ash::Instance) -> Result<vk::PhysicalDevice> {
    let wanted = std::env::var("OSCULATE_DEVICE").unwrap_or_default().to_lowercase();
    // SAFETY: the instance is alive, and the devices come from it.
    let (devices, name) = unsafe {
        let name = |one: &vk::PhysicalDevice| instance.get_physical_device_properties(*one).device_name;
        (instance.enumerate_physical_devices()?, name)
    };
    let fits = |one: &vk::PhysicalDevice| {
        let name: Vec<u8> = name(one).iter().map(|&c| c as u8).take_while(|&c| c != 0).collect();
        String::from_utf8_lossy(&name).to_lowercase().contains(&wanted)
    };
    let by_number = wanted.parse().ok().and_then(|number: usize| devices.get(number).copied());
    by_number.or_else(|| devices.into_iter().find(fits)).ok_or_else(|| "no Vulkan device of that name".into())
}

unsafe fn create_device(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    family: u32,
    enabled: &Enabled,
) -> Result<ash::Device> {
    let names = enabled.extension_names();
    let (mut vulkan12, mut vulkan13) = (enabled.vulkan12, enabled.vulkan13);
    let mut feedback = enabled.transform_feedback;
    let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
    let mut info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&names)
        .enabled_features(&enabled.core)
        .push_next(&mut vulkan12)
        .push_next(&mut vulkan13);
    if enabled.extensions.contains(&ext::transform_feedback::NAME) {
        info = info.push_next(&mut feedback);
    }
    // SAFETY: all structures live across the call, and the device has what is asked for.
    Ok(unsafe { instance.create_device(physical, &info, None) }?)
}

fn messenger_info(messages: &Mutex<Vec<String>>) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
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
    // The evaluation stages have outputs that not every fragment shader reads.
    if let Ok(mut messages) = log.lock()
        && !text.contains("OutputNotConsumed")
    {
        messages.push(text.into_owned());
    }
    vk::FALSE
}
