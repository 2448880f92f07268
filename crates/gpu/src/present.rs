//! Windows: images that are drawn like any other, and then shown.
//!
//! A [`Presenter`] hands out [`Frame`]s. Acquiring one lets the queue wait until the image is free: the wait goes along with the
//! next submission, whatever that is, and orders all later ones. Presenting submits the change to the layout that windows want,
//! after everything so far. So recordings, prepared or not, need not know that a target belongs to a window.

mod choice;
mod surface;
mod swapchain;

use std::sync::Arc;

use ash::vk;
use raw_window_handle::{HasDisplayHandle, HasWindowHandle};

use crate::{Device, Format, GpuError, Image, device::Queue, owned::Owned, submission::Commands};
use surface::Surface;

pub use choice::PresentMode;
pub(crate) use surface::WindowFunctions;
pub use surface::WindowSystem;
pub(crate) use swapchain::Swapchain;

/// Frames that the host may be ahead of the GPU.
const FRAMES_AHEAD: usize = 3;

/// How long [`Presenter::acquire`] waits for the window, in nanoseconds.
const PATIENCE: u64 = 1_000_000_000;

/// How to draw to a window.
#[derive(Clone, Copy, Debug)]
pub struct PresenterDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// Width and height of the window in pixels; zero while it is minimised.
    pub size: [u32; 2],
    /// Formats, best first: the first one that the window takes is chosen, or else any.
    pub formats: &'a [Format],
    /// When frames are shown.
    pub mode: PresentMode,
}

impl Default for PresenterDesc<'_> {
    /// Formats of 8 bits, sRGB first, shown with the screen's refresh.
    fn default() -> Self {
        const FORMATS: [Format; 4] = [Format::Bgra8Srgb, Format::Rgba8Srgb, Format::Bgra8Unorm, Format::Rgba8Unorm];
        Self { name: "window", size: [0, 0], formats: &FORMATS, mode: PresentMode::Fifo }
    }
}

/// What [`Presenter::acquire`] finds.
#[derive(Debug)]
pub enum Acquired {
    /// An image to draw to, and then to [`Presenter::present`].
    Frame(Frame),
    /// The window has no pixels, as when it is minimised: wait for a [`Presenter::resize`].
    Hidden,
    /// The window has changed: tell its size by [`Presenter::resize`], and acquire again.
    OutOfDate,
    /// No image became free within a second, as when the system does not show the window: try again later.
    Timeout,
}

/// What [`Presenter::present`] did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub enum Presented {
    /// The frame is shown, or will be.
    Shown,
    /// The window has changed, and the frame is perhaps not shown: tell the window's size by [`Presenter::resize`]; the next
    /// frame will fit.
    OutOfDate,
}

/// An image of a window, to be drawn and shown. What is in it is undefined. One that is dropped is handed out again.
#[derive(Debug)]
pub struct Frame {
    image: Image,
    index: usize,
}

impl Frame {
    /// The image to draw to: a target of one sample, and where the system can, copied from and to. Once the frame is presented,
    /// recordings that use it are refused until the image is handed out again.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.image.size()
    }
}

/// Draws to a window, which it keeps. Made by [`Device::presenter`].
pub struct Presenter {
    device: Device,
    surface: Arc<Surface>,
    name: String,
    format: vk::SurfaceFormatKHR,
    modes: Vec<PresentMode>,
    mode: PresentMode,
    /// Size of the window, as the caller knows it.
    size: [u32; 2],
    chain: Option<Chain>,
    /// The chain does not fit the window any more.
    stale: bool,
    forced: bool,
    slots: [Slot; FRAMES_AHEAD],
    next_slot: usize,
}

/// A swapchain with what goes with each of its images.
struct Chain {
    images: Vec<Image>,
    /// For each image: everything is drawn.
    drawn: Vec<Owned<vk::Semaphore>>,
    /// The image that is handed out, and the slot of its frame.
    acquired: Option<(usize, usize)>,
    swapchain: Arc<Swapchain>,
}

/// What a frame on its way uses.
struct Slot {
    /// The image is free.
    free: Owned<vk::Semaphore>,
    /// Commands of the last frame in this slot, and the value of the timeline when they are done.
    commands: Option<Commands>,
    timeline_value: u64,
}

impl Device {
    /// Prepares to draw to a window, which is kept until the presenter is gone. Needs a device opened with
    /// [`DeviceDesc::windows`](crate::DeviceDesc::windows). A window can have one presenter at a time.
    pub fn presenter<W>(&self, window: Arc<W>, desc: &PresenterDesc<'_>) -> Result<Presenter, GpuError>
    where
        W: HasWindowHandle + HasDisplayHandle + Send + Sync + 'static,
    {
        let surface = Surface::new(self, window, desc.name)?;
        let formats = surface.formats(self)?;
        let format = choice::format(&formats, desc.formats).ok_or_else(|| GpuError::Window {
            window: desc.name.to_owned(),
            reason: format!("it has none of the formats that this crate knows, but {formats:?}"),
        })?;
        let modes = surface.modes(self)?;
        Ok(Presenter {
            device: self.clone(),
            name: desc.name.to_owned(),
            format,
            mode: choice::mode(&modes, desc.mode),
            modes,
            size: desc.size,
            chain: None,
            stale: false,
            forced: false,
            slots: [self.slot(desc.name)?, self.slot(desc.name)?, self.slot(desc.name)?],
            next_slot: 0,
            surface: Arc::new(surface),
        })
    }

    fn slot(&self, name: &str) -> Result<Slot, GpuError> {
        Ok(Slot { free: self.semaphore(&format!("{name} is free"))?, commands: None, timeline_value: 0 })
    }

    fn semaphore(&self, name: &str) -> Result<Owned<vk::Semaphore>, GpuError> {
        // SAFETY: no preconditions.
        let raw = unsafe { self.raw().create_semaphore(&vk::SemaphoreCreateInfo::default(), None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating semaphore {name:?}"), result))?;
        Ok(Owned::new(&self.shared.raw, raw, name))
    }
}

impl Presenter {
    /// Format of the frames.
    pub fn format(&self) -> Format {
        // `choice::format` picked one of ours.
        Format::of_window(self.format.format).unwrap_or(Format::Bgra8Srgb)
    }

    /// Size of the latest frames; before the first one, what the caller has said.
    pub fn size(&self) -> [u32; 2] {
        self.chain.as_ref().and_then(|chain| chain.images.first()).map_or(self.size, Image::size)
    }

    /// The modes that the window offers; [`PresentMode::Fifo`] is always there.
    pub fn modes(&self) -> &[PresentMode] {
        &self.modes
    }

    /// When frames are shown.
    pub fn mode(&self) -> PresentMode {
        self.mode
    }

    /// Changes when frames are shown, from the next frame on; to [`PresentMode::Fifo`] if the window does not offer it.
    pub fn set_mode(&mut self, mode: PresentMode) {
        let mode = choice::mode(&self.modes, mode);
        self.stale |= mode != self.mode;
        self.mode = mode;
    }

    /// Tells the window's size in pixels; zero while it is minimised. Cheap if nothing has changed.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.stale |= size != self.size;
        self.size = size;
    }

    /// For tests: the next acquire or present finds the window changed.
    pub fn force_out_of_date(&mut self) {
        self.forced = true;
    }

    /// Hands out an image of the window. Waits until there is one, up to a second, and until at most two frames are still on
    /// their way.
    pub fn acquire(&mut self) -> Result<Acquired, GpuError> {
        if self.size.contains(&0) {
            return Ok(Acquired::Hidden);
        }
        if std::mem::take(&mut self.forced) {
            self.stale = true;
            return Ok(Acquired::OutOfDate);
        }
        if (self.stale || self.chain.is_none()) && !self.rebuild()? {
            return Ok(Acquired::Hidden);
        }
        let Some(chain) = &mut self.chain else { return Ok(Acquired::Hidden) };
        if let Some((index, _)) = chain.acquired {
            return Ok(Acquired::Frame(chain.frame(index)));
        }
        let slot = &mut self.slots[self.next_slot];
        slot.recycle(&self.device)?;
        match chain.swapchain.acquire(slot.free.raw, PATIENCE) {
            Ok((index, suboptimal)) => {
                self.stale |= suboptimal;
                let frame = chain.take(&self.device, index, self.next_slot, slot.free.raw);
                self.next_slot = (self.next_slot + 1) % FRAMES_AHEAD;
                Ok(Acquired::Frame(frame))
            }
            Err(vk::Result::TIMEOUT | vk::Result::NOT_READY) => Ok(Acquired::Timeout),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => {
                self.stale = true;
                Ok(Acquired::OutOfDate)
            }
            Err(result) => Err(self.failed("acquiring an image", result)),
        }
    }

    /// Shows a frame when everything submitted so far is done.
    pub fn present(&mut self, frame: Frame) -> Result<Presented, GpuError> {
        // A frame of an earlier swapchain went with it.
        let Some(chain) = &mut self.chain else { return Ok(Presented::OutOfDate) };
        let Some(slot) = chain.give(&frame) else { return Ok(Presented::OutOfDate) };
        let slot = &mut self.slots[slot];
        let drawn = chain.drawn[frame.index].raw;
        let mut queue = self.device.queue();
        slot.hand_over(&self.device, &mut queue, &frame.image, drawn)?;
        let shown = chain.swapchain.present(&queue, frame.index, drawn);
        drop(queue);
        let out_of_date = match shown {
            Ok(suboptimal) => suboptimal,
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => true,
            Err(result) => return Err(self.failed("presenting", result)),
        };
        self.stale |= out_of_date | std::mem::take(&mut self.forced);
        Ok(if self.stale { Presented::OutOfDate } else { Presented::Shown })
    }

    fn failed(&self, operation: &str, result: vk::Result) -> GpuError {
        GpuError::from_vulkan(format!("{operation} of {:?}", self.name), result)
    }

    /// Makes a chain that fits the window; says whether the window has pixels.
    fn rebuild(&mut self) -> Result<bool, GpuError> {
        let capabilities = self.surface.capabilities(&self.device)?;
        let Some(extent) = choice::extent(&capabilities, self.size) else { return Ok(false) };
        self.retire()?;
        let old = self.chain.take();
        let info = choice::swapchain(&capabilities, extent, self.format, self.mode)
            .old_swapchain(old.as_ref().map_or(vk::SwapchainKHR::null(), |old| old.swapchain.raw()));
        let swapchain = Swapchain::new(&self.device, &self.surface, info)
            .map_err(|result| self.failed("creating the swapchain", result))?;
        drop(old);
        self.chain = Some(Chain::new(&self.device, &self.name, self.format(), extent, info.image_usage, swapchain)?);
        self.stale = false;
        Ok(true)
    }

    /// Waits until the GPU and the window have finished with all frames.
    fn retire(&mut self) -> Result<(), GpuError> {
        let Some(chain) = &mut self.chain else { return Ok(()) };
        let mut queue = self.device.queue();
        // An image that was acquired, but not used, leaves a semaphore behind that must still be waited for.
        if !queue.waits.is_empty() {
            self.device.enqueue(&mut queue, &[])?;
        }
        chain.acquired = None;
        chain.images.iter().for_each(|image| image.set_layout(Image::WITH_WINDOW));
        // SAFETY: the lock makes the use of the queue exclusive. Work on the queue needs no lock to end.
        unsafe { self.device.raw().queue_wait_idle(queue.raw) }
            .map_err(|result| GpuError::from_vulkan(format!("waiting for the frames of {:?}", self.name), result))
    }
}

impl Drop for Presenter {
    fn drop(&mut self) {
        // Waiting fails only if the device is lost; Vulkan then lets go of everything.
        if let Err(error) = self.retire() {
            tracing::error!("a presenter ended with its device: {error}");
        }
        let commands = self.slots.iter_mut().filter_map(|slot| slot.commands.take());
        self.device.queue().idle.extend(commands);
    }
}

impl std::fmt::Debug for Presenter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Presenter");
        debug.field("name", &self.name).field("size", &self.size()).field("mode", &self.mode).finish_non_exhaustive()
    }
}

impl Chain {
    fn new(
        device: &Device,
        name: &str,
        format: Format,
        extent: vk::Extent2D,
        usage: vk::ImageUsageFlags,
        swapchain: Swapchain,
    ) -> Result<Self, GpuError> {
        let swapchain = Arc::new(swapchain);
        let raw_images = swapchain
            .images()
            .map_err(|result| GpuError::from_vulkan(format!("listing the images of {name:?}"), result))?;
        let (size, usage) = ([extent.width, extent.height], choice::image_usage(usage));
        let (mut images, mut drawn) = (Vec::new(), Vec::new());
        for (index, raw) in raw_images.into_iter().enumerate() {
            let name = format!("{name} {index}");
            let desc = crate::ImageDesc { name: &name, size, format, usage, ..Default::default() };
            images.push(device.window_image(&desc, raw, &swapchain)?);
            drawn.push(device.semaphore(&format!("{name} is drawn"))?);
        }
        Ok(Self { images, drawn, acquired: None, swapchain })
    }

    /// Takes note of an acquired image, on which the queue waits from now on.
    fn take(&mut self, device: &Device, index: usize, slot: usize, free: vk::Semaphore) -> Frame {
        let mut queue = device.queue();
        queue.waits.push(free);
        self.images[index].set_layout(vk::ImageLayout::UNDEFINED);
        self.acquired = Some((index, slot));
        self.frame(index)
    }

    fn frame(&self, index: usize) -> Frame {
        Frame { image: self.images[index].clone(), index }
    }

    /// Takes a frame back; its slot, unless it is of another chain or was presented before.
    fn give(&mut self, frame: &Frame) -> Option<usize> {
        let (_, slot) = self.acquired.filter(|(index, _)| self.images[*index] == frame.image)?;
        self.acquired = None;
        Some(slot)
    }
}

impl Slot {
    /// Waits until the last frame in this slot is done.
    fn recycle(&mut self, device: &Device) -> Result<(), GpuError> {
        device.wait_for(self.timeline_value, "waiting for a frame")?;
        device.queue().idle.extend(self.commands.take());
        Ok(())
    }

    /// Submits the image's change of layout after everything so far, and lets `drawn` be signalled.
    fn hand_over(
        &mut self,
        device: &Device,
        queue: &mut Queue,
        image: &Image,
        drawn: vk::Semaphore,
    ) -> Result<(), GpuError> {
        let commands = device.begin(queue)?;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .old_layout(image.layout())
            .new_layout(Image::WITH_WINDOW)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image.raw())
            .subresource_range(image.range())];
        // SAFETY: `begin` put the command buffer into the recording state, and nobody else has it; the image is acquired and
        // in the named layout, since layouts change only while the queue is locked.
        unsafe {
            let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
            device.raw().cmd_pipeline_barrier2(commands.buffer, &info);
        }
        device.end(&commands)?;
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(commands.buffer)];
        self.timeline_value = device.enqueue_and_signal(queue, &buffers, Some(drawn))?;
        self.commands = Some(commands);
        image.set_layout(Image::WITH_WINDOW);
        Ok(())
    }
}
