//! The Vulkan loader and instance.

use std::{
    ffi::{CStr, CString, c_char},
    sync::Arc,
};

use ash::{ext, khr, vk};

use crate::{DeviceError, MessageLog, WindowSystem};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// An instance with its messenger. Field order is destruction order, after `Drop::drop`: the log outlives the messenger that
/// writes to it, and the loader's library outlives every function called through it.
pub(crate) struct Instance {
    pub(crate) raw: ash::Instance,
    /// Whether object names and labels can be set.
    pub(crate) debug_utils: bool,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    pub(crate) messages: MessageLog,
    /// Whether it belongs to somebody else, who destroys it.
    is_borrowed: bool,
    pub(crate) entry: ash::Entry,
}

impl Instance {
    /// Opens the loader and makes an instance, with core and synchronization validation if `validation` is set, and with the
    /// extensions that windows need.
    pub(crate) fn new(
        application: &str,
        validation: bool,
        windows: Option<&WindowSystem>,
    ) -> Result<Arc<Self>, DeviceError> {
        // SAFETY: loading the Vulkan loader runs its initialisers, which it is made for.
        let entry =
            unsafe { ash::Entry::load() }.map_err(|error| DeviceError::NoLoader { reason: error.to_string() })?;
        let available = extensions(&entry, None)?;
        let has = |name: &CStr| available.iter().any(|found| found == name);
        let validation_extensions = if validation { validation_extensions(&entry)? } else { Vec::new() };
        let debug_utils =
            has(ext::debug_utils::NAME) || validation_extensions.iter().any(|name| name == ext::debug_utils::NAME);

        let mut names: Vec<*const c_char> = Vec::new();
        if debug_utils {
            names.push(ext::debug_utils::NAME.as_ptr());
        }
        if validation {
            names.push(ext::validation_features::NAME.as_ptr());
        }
        let portability = has(khr::portability_enumeration::NAME);
        if portability {
            names.push(khr::portability_enumeration::NAME.as_ptr());
        }
        for name in windows.into_iter().flat_map(WindowSystem::extensions) {
            if !has(name) {
                return Err(DeviceError::NoPresentation { missing: name.to_string_lossy().into_owned() });
            }
            names.push(name.as_ptr());
        }
        let layers: Vec<*const c_char> = if validation { vec![VALIDATION_LAYER.as_ptr()] } else { Vec::new() };

        let messages = MessageLog::default();
        let raw = create(&entry, application, &layers, &names, portability, validation.then_some(&messages))?;
        let mut instance = Self { raw, debug_utils, messenger: None, messages, is_borrowed: false, entry };
        if validation && debug_utils {
            instance.add_messenger()?;
        }
        Ok(Arc::new(instance))
    }

    /// An instance of somebody else's, who collects its messages and destroys it.
    pub(crate) fn borrowed(entry: ash::Entry, raw: ash::Instance, debug_utils: bool) -> Arc<Self> {
        let messages = MessageLog::default();
        Arc::new(Self { raw, debug_utils, messenger: None, messages, is_borrowed: true, entry })
    }

    /// Starts to collect messages.
    fn add_messenger(&mut self) -> Result<(), DeviceError> {
        let functions = ext::debug_utils::Instance::new(&self.entry, &self.raw);
        // SAFETY: the log that the messenger points to lives in self, which destroys the messenger before it.
        let messenger = unsafe { functions.create_debug_utils_messenger(&self.messages.messenger_info(), None) }
            .map_err(|result| DeviceError::Vulkan { operation: "creating the debug messenger", result })?;
        self.messenger = Some((functions, messenger));
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some((functions, messenger)) = self.messenger.take() {
            // SAFETY: created from this instance, destroyed once.
            unsafe { functions.destroy_debug_utils_messenger(messenger, None) }
        }
        if self.is_borrowed {
            return;
        }
        // SAFETY: devices hold an Arc of self, so none is left.
        unsafe { self.raw.destroy_instance(None) }
    }
}

/// Creates the instance; with a log, its own creation and destruction are watched too.
fn create(
    entry: &ash::Entry,
    application: &str,
    layers: &[*const c_char],
    extensions: &[*const c_char],
    portability: bool,
    validation: Option<&MessageLog>,
) -> Result<ash::Instance, DeviceError> {
    // A name with a NUL inside is cut there: it only shows up in tools.
    let name: Vec<u8> = application.bytes().take_while(|&byte| byte != 0).collect();
    let name = CString::new(name).unwrap_or_default();
    let application = vk::ApplicationInfo::default()
        .application_name(&name)
        .engine_name(c"osculate")
        .api_version(vk::API_VERSION_1_3);
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    let mut messenger = validation.map(MessageLog::messenger_info).unwrap_or_default();
    let flags =
        if portability { vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR } else { vk::InstanceCreateFlags::empty() };
    let mut info = vk::InstanceCreateInfo::default()
        .flags(flags)
        .application_info(&application)
        .enabled_layer_names(layers)
        .enabled_extension_names(extensions);
    if validation.is_some() {
        info = info.push_next(&mut features).push_next(&mut messenger);
    }
    // SAFETY: all strings and structures live across the call; the layers and extensions were found to be there.
    unsafe { entry.create_instance(&info, None) }.map_err(|result| match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => DeviceError::NoDevice,
        vk::Result::ERROR_LAYER_NOT_PRESENT => DeviceError::NoValidationLayer,
        result => DeviceError::Vulkan { operation: "creating the Vulkan instance", result },
    })
}

/// The instance extensions that the validation layer brings, or an error if it is not installed.
fn validation_extensions(entry: &ash::Entry) -> Result<Vec<CString>, DeviceError> {
    // SAFETY: a global command without preconditions.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .map_err(|result| DeviceError::Vulkan { operation: "listing the Vulkan layers", result })?;
    if !layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
        return Err(DeviceError::NoValidationLayer);
    }
    extensions(entry, Some(VALIDATION_LAYER))
}

/// The names of the instance extensions of a layer, or of the loader and the drivers.
fn extensions(entry: &ash::Entry, layer: Option<&CStr>) -> Result<Vec<CString>, DeviceError> {
    // SAFETY: a global command; the layer, if any, is there.
    let properties = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .map_err(|result| DeviceError::Vulkan { operation: "listing the instance extensions", result })?;
    Ok(properties.iter().filter_map(|one| one.extension_name_as_c_str().ok().map(CStr::to_owned)).collect())
}
