//! The surface of a window.

use std::{
    ffi::{CStr, c_char},
    sync::Arc,
};

use ash::{khr, vk};
use raw_window_handle::{HasDisplayHandle, HasWindowHandle};

use super::PresentMode;
use crate::{Device, DeviceError, GpuError, instance::Instance, owned::RawDevice};

/// A system of windows, such as X11, Wayland or that of Windows: what Vulkan needs to draw to its windows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WindowSystem {
    /// Instance extensions.
    extensions: Vec<&'static CStr>,
}

impl WindowSystem {
    /// The system of a display: of winit's event loop, for example.
    pub fn of(display: &(impl HasDisplayHandle + ?Sized)) -> Result<Self, DeviceError> {
        let unknown = |error: &dyn std::fmt::Display| DeviceError::NoPresentation {
            missing: format!("support for these windows ({error})"),
        };
        let handle = display.display_handle().map_err(|error| unknown(&error))?;
        let names = ash_window::enumerate_required_extensions(handle.as_raw()).map_err(|error| unknown(&error))?;
        Ok(Self { extensions: names.iter().map(|&name| extension_name(name)).collect() })
    }

    pub(crate) fn extensions(&self) -> impl Iterator<Item = &'static CStr> + '_ {
        self.extensions.iter().copied()
    }
}

fn extension_name(name: *const c_char) -> &'static CStr {
    // SAFETY: ash-window returns pointers to the constants in which ash holds the names of extensions.
    unsafe { CStr::from_ptr(name) }
}

/// The functions of the extensions that windows need.
pub(crate) struct WindowFunctions {
    /// The system that the instance's extensions are for.
    system: WindowSystem,
    pub(super) surface: khr::surface::Instance,
    pub(super) swapchain: khr::swapchain::Device,
}

impl WindowFunctions {
    /// Only for an instance and a device on which the extensions are switched on.
    pub(crate) fn new(system: WindowSystem, instance: &Instance, device: &RawDevice) -> Self {
        Self {
            system,
            surface: khr::surface::Instance::new(&instance.entry, &instance.raw),
            swapchain: khr::swapchain::Device::new(&instance.raw, &device.raw),
        }
    }
}

/// What Vulkan draws windows with.
trait Window: HasWindowHandle + HasDisplayHandle + Send + Sync {}

impl<W: HasWindowHandle + HasDisplayHandle + Send + Sync> Window for W {}

/// A window's surface; the window lives at least as long.
pub(super) struct Surface {
    raw: vk::SurfaceKHR,
    functions: khr::surface::Instance,
    name: String,
    _window: Arc<dyn Window>,
    _instance: Arc<Instance>,
}

impl Surface {
    pub(super) fn new<W>(device: &Device, window: Arc<W>, name: &str) -> Result<Self, GpuError>
    where
        W: HasWindowHandle + HasDisplayHandle + Send + Sync + 'static,
    {
        let refuse = |reason: String| GpuError::Window { window: name.to_owned(), reason };
        let Some(functions) = &device.shared.windows else {
            return Err(refuse("the device was opened without DeviceDesc::windows".to_owned()));
        };
        let failed = |result| GpuError::from_vulkan(format!("creating the surface of {name:?}"), result);
        let instance = &device.shared.instance;
        let raw = {
            let display = window.display_handle().map_err(|error| refuse(error.to_string()))?.as_raw();
            let handle = window.window_handle().map_err(|error| refuse(error.to_string()))?.as_raw();
            let system = WindowSystem::of(&*window).map_err(|error| refuse(error.to_string()))?;
            if functions.system != system {
                return Err(refuse(format!("the device was opened for other windows, not for {system:?}")));
            }
            // SAFETY: the handles are valid now, and as long as the window, which the surface keeps; the extensions that the
            // kind of window needs are switched on.
            unsafe { ash_window::create_surface(&instance.entry, &instance.raw, display, handle, None) }
                .map_err(failed)?
        };
        let surface = Self {
            raw,
            functions: functions.surface.clone(),
            name: name.to_owned(),
            _window: window,
            _instance: Arc::clone(instance),
        };
        surface.check_support(device)?;
        Ok(surface)
    }

    /// Fails unless the device's queue can present to the surface.
    fn check_support(&self, device: &Device) -> Result<(), GpuError> {
        let family = device.queue().family;
        // SAFETY: device and surface belong to one instance.
        let supported =
            unsafe { self.functions.get_physical_device_surface_support(device.shared.physical, family, self.raw) }
                .map_err(|result| self.failed(result))?;
        if supported {
            return Ok(());
        }
        let reason = format!("device {:?} cannot show anything in it; choose another device", device.info().name);
        Err(GpuError::Window { window: self.name.clone(), reason })
    }

    pub(super) fn raw(&self) -> vk::SurfaceKHR {
        self.raw
    }

    pub(super) fn capabilities(&self, device: &Device) -> Result<vk::SurfaceCapabilitiesKHR, GpuError> {
        // SAFETY: as in `check_support`, which has found the device able to present.
        unsafe { self.functions.get_physical_device_surface_capabilities(device.shared.physical, self.raw) }
            .map_err(|result| self.failed(result))
    }

    pub(super) fn formats(&self, device: &Device) -> Result<Vec<vk::SurfaceFormatKHR>, GpuError> {
        // SAFETY: as above.
        unsafe { self.functions.get_physical_device_surface_formats(device.shared.physical, self.raw) }
            .map_err(|result| self.failed(result))
    }

    pub(super) fn modes(&self, device: &Device) -> Result<Vec<PresentMode>, GpuError> {
        // SAFETY: as above.
        let modes =
            unsafe { self.functions.get_physical_device_surface_present_modes(device.shared.physical, self.raw) }
                .map_err(|result| self.failed(result))?;
        Ok(PresentMode::ALL.into_iter().filter(|mode| modes.contains(&mode.raw())).collect())
    }

    fn failed(&self, result: vk::Result) -> GpuError {
        GpuError::from_vulkan(format!("asking about window {:?}", self.name), result)
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: swapchains keep an Arc of self, so none is left.
        unsafe { self.functions.destroy_surface(self.raw, None) }
    }
}
