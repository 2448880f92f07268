//! Vulkan for osculate: device, memory, pipelines, passes with derived barriers. The only crate with unsafe code.
//!
//! It knows no geometry. What it knows:
//!
//! * [`Device`] is opened by [`DeviceDesc`]; [`Buffer`], [`Image`], [`Shader`], [`ComputePipeline`] and [`GraphicsPipeline`] are
//!   made from it. All are cheap to clone, and go when the last clone is dropped.
//! * A [`Recording`] is a plan: plain data, nothing happens. [`Device::submit`] checks it, derives its barriers from what the
//!   shaders declare, and hands it to the GPU. A [`Submission`] keeps alive what it uses. What runs again and again, as the
//!   frames of an animation do, is checked and encoded once by [`Device::prepare`].
//! * Layouts are read from the shaders ([`Reflection`]): buffers and images of descriptor set 0, pushed with every pass, and
//!   push constants. `readonly` and `writeonly` in GLSL spare barriers.
//!
//! ```no_run
//! # fn spirv() -> Vec<u32> { Vec::new() }
//! use osculate_gpu::*;
//! let device = Device::new(&DeviceDesc { application: "example".into(), ..Default::default() })?;
//! let numbers = device.upload("numbers", BufferUsage::STORAGE, &[1.0f32; 1000])?;
//! let shader = device.shader("double.comp", &spirv())?;
//! let pipeline = device.compute_pipeline(&ComputePipelineDesc { name: "double", shader: &shader, specialization: &[] })?;
//! let mut recording = Recording::new();
//! recording.compute(ComputePass {
//!     name: "double".into(),
//!     groups: pipeline.groups_for(1000),
//!     pipeline,
//!     bindings: Bindings::new().with(0, &numbers),
//!     push: vec![],
//! });
//! device.run(&recording)?;
//! let doubled: Vec<f32> = device.download(&numbers, ..)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Images
//! [`Device::upload_image`] makes an image from texels of the host, with smaller levels if wanted, and [`Device::write_image`]
//! replaces some of them. Shaders look it up through a [`Sampler`]: what is `layout(binding = 1) uniform sampler2D picture` in
//! GLSL is bound by [`Bindings::with_texture`]. Layouts of images follow from how passes use them; so a pass can sample what
//! an earlier one has drawn. Storage images, `image2D`, are bound by [`Bindings::with_storage_image`].
//!
//! ```no_run
//! # use osculate_gpu::*;
//! # fn example(device: &Device, draw: Draw, texels: &[[u8; 4]]) -> Result<(), GpuError> {
//! let size = [256, 256];
//! let picture = device.upload_image(
//!     &ImageDesc {
//!         name: "picture",
//!         size,
//!         format: Format::Rgba8Srgb,
//!         levels: Image::full_levels(size),
//!         usage: ImageUsage::SAMPLED,
//!         ..ImageDesc::default()
//!     },
//!     texels,
//! )?;
//! let sampler = device.sampler(&SamplerDesc { wrap: [Wrap::Repeat; 2], ..SamplerDesc::default() })?;
//! let bindings = Bindings::new().with_texture(1, &picture, &sampler);
//! // Only these texels of the targets may change.
//! let scissor = Some(Rect { origin: [10, 20], size: [300, 200] });
//! let draw = Draw { bindings, scissor, ..draw };
//! # Ok(()) }
//! ```
//!
//! # Windows
//! A device opened with [`DeviceDesc::windows`] draws to windows of any library that implements the traits of
//! `raw-window-handle`, such as winit. A [`Presenter`] hands out frames, whose images are targets like any other. Changes of
//! the window are no errors: the caller is told, says the new size, and goes on.
//!
//! ```no_run
//! # use osculate_gpu::{raw_window_handle::*, *};
//! # use std::sync::Arc;
//! # trait SizedWindow { fn pixels(&self) -> [u32; 2]; }
//! # fn example<W>(window: Arc<W>, record: impl Fn(&Image) -> Recording) -> Result<(), Box<dyn std::error::Error>>
//! # where W: HasWindowHandle + HasDisplayHandle + SizedWindow + Send + Sync + 'static {
//! let windows = Some(WindowSystem::of(&*window)?);
//! let device = Device::new(&DeviceDesc { application: "example".into(), windows, ..Default::default() })?;
//! let desc = PresenterDesc { size: window.pixels(), ..Default::default() };
//! let mut presenter = device.presenter(Arc::clone(&window), &desc)?;
//! // Pipelines that draw to frames have `color_format: Some(presenter.format())`.
//! let mut running = None;
//! loop {
//!     match presenter.acquire()? {
//!         Acquired::Frame(frame) => {
//!             // Dropping the submission of the frame before waits for its end.
//!             running = Some(device.submit(&record(frame.image()))?);
//!             if presenter.present(frame)? == Presented::OutOfDate {
//!                 presenter.resize(window.pixels());
//!             }
//!         }
//!         Acquired::OutOfDate => presenter.resize(window.pixels()),
//!         // Wait for events of the window.
//!         Acquired::Hidden | Acquired::Timeout => break,
//!     }
//! }
//! # drop(running);
//! # Ok(()) }
//! ```
//!
//! # Validation
//! [`DeviceDesc::validation`] switches on the Khronos layer with synchronization checks; [`Device::validation_messages`] lists
//! what it says. The layer is found by the Vulkan loader, which the environment can direct: `VK_DRIVER_FILES` (or
//! `VK_ICD_FILENAMES`) names the drivers to offer, `VK_LAYER_PATH` the folder of the layers.
//!
//! # Safety
//! Every function is safe to call; wrong use is an error. Two things are trusted: the drivers, and the SPIR-V given to
//! [`Device::shader`], which must be valid. Buffer accesses of shaders beyond a buffer's end are harmless (`robustBufferAccess`).

mod barrier;
mod bindings;
mod buffer;
mod cache;
mod device;
mod embed;
mod encode;
mod error;
mod execute;
mod format;
mod graphics;
mod image;
mod info;
mod instance;
mod layout;
mod memory;
mod messages;
mod owned;
mod pipeline;
mod plan;
mod prepared;
mod present;
mod query;
mod recording;
mod rect;
mod reflect;
mod requirements;
mod resource;
mod sampler;
mod select;
mod shader;
mod submission;
mod texels;
mod texture;

/// Vulkan as this crate is built upon it, for programs that have objects of their own.
pub use ash;
pub use bindings::Bindings;
pub use buffer::{Buffer, BufferDesc, BufferUsage, Memory};
pub use device::{Device, DeviceDesc, devices};
pub use embed::RawDeviceDesc;
pub use encode::{CallerSet, EncodeDraws, Encoded};
pub use error::{DeviceError, GpuError};
pub use format::{Format, Numbers};
pub use graphics::{
    Attachments, Blend, Compare, Cull, DepthBias, DepthState, FrontFace, GraphicsPipeline, GraphicsPipelineDesc,
    PolygonMode, Tessellation, Topology,
};
pub use image::{Image, ImageDesc, ImageRegion, ImageUsage};
pub use info::{DeviceInfo, DeviceKind, Features, Limits};
pub use layout::CallerSetLayout;
pub use memory::MemoryUse;
pub use messages::MessageLog;
pub use pipeline::{ComputePipeline, ComputePipelineDesc};
pub use prepared::{Prepared, Workload};
pub use present::{Acquired, Frame, PresentMode, Presented, Presenter, PresenterDesc, WindowSystem};
pub use query::{PassStatistics, Report};
pub use raw_window_handle;
pub use recording::{
    CapturePass, ColorTarget, ComputePass, DepthTarget, Draw, Measure, Recording, RenderPass, Vertices,
};
pub use rect::Rect;
pub use reflect::{
    Extent, ReflectError, Reflection, ResourceBinding, ResourceKind, SpecConstant, Stage, VertexInput, reflect,
};
pub use requirements::Enabled;
pub use sampler::{Filter, Sampler, SamplerDesc, Wrap};
pub use shader::Shader;
pub use submission::Submission;
pub use texels::TexelFormat;
