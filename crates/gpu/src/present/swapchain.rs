//! Swapchains: the images of a window of one size.

use std::sync::Arc;

use ash::{khr, prelude::VkResult, vk};

use super::Surface;
use crate::{Device, device::Queue, owned::RawDevice};

/// A swapchain; its images live as long. Field order is destruction order, after `Drop::drop`.
pub(crate) struct Swapchain {
    raw: vk::SwapchainKHR,
    functions: khr::swapchain::Device,
    _surface: Arc<Surface>,
    _device: Arc<RawDevice>,
}

impl Swapchain {
    /// Makes a swapchain for a surface, which replaces that of `info`.
    pub(super) fn new(device: &Device, surface: &Arc<Surface>, info: vk::SwapchainCreateInfoKHR<'_>) -> VkResult<Self> {
        // Without them there is no surface.
        let functions =
            device.shared.windows.as_ref().ok_or(vk::Result::ERROR_EXTENSION_NOT_PRESENT)?.swapchain.clone();
        // SAFETY: the parameters are chosen from what the surface supports; the presenter has the surface to itself, and the
        // old swapchain, if any, belongs to it too.
        let raw = unsafe { functions.create_swapchain(&info.surface(surface.raw()), None) }?;
        let _device = Arc::clone(&device.shared.raw);
        Ok(Self { raw, functions, _surface: Arc::clone(surface), _device })
    }

    pub(super) fn raw(&self) -> vk::SwapchainKHR {
        self.raw
    }

    pub(super) fn images(&self) -> VkResult<Vec<vk::Image>> {
        // SAFETY: the swapchain is alive.
        unsafe { self.functions.get_swapchain_images(self.raw) }
    }

    /// The next image, which is free when the semaphore is signalled, and whether the window would like another chain.
    pub(super) fn acquire(&self, free: vk::Semaphore, patience: u64) -> VkResult<(usize, bool)> {
        // SAFETY: only the presenter, which is borrowed exclusively, uses the swapchain; the semaphore has no operation pending,
        // since the frame that used it last is done.
        let found = unsafe { self.functions.acquire_next_image(self.raw, patience, free, vk::Fence::null()) };
        found.map(|(index, suboptimal)| (index as usize, suboptimal))
    }

    /// Shows an image once the semaphore is signalled; whether the window would like another chain.
    pub(super) fn present(&self, queue: &Queue, index: usize, drawn: vk::Semaphore) -> VkResult<bool> {
        let (swapchains, indices, semaphores) = ([self.raw], [index as u32], [drawn]);
        let info =
            vk::PresentInfoKHR::default().swapchains(&swapchains).image_indices(&indices).wait_semaphores(&semaphores);
        // SAFETY: the queue is locked; the image is acquired and in the layout of presentation; the signal of the semaphore
        // was submitted before.
        unsafe { self.functions.queue_present(queue.raw, &info) }
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        // SAFETY: images hold an Arc of self, and submissions hold the images that they use; the presenter has waited for the
        // end of all frames before it let go.
        unsafe { self.functions.destroy_swapchain(self.raw, None) }
    }
}
