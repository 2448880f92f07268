//! Vulkan for osculate: device, memory, pipelines, passes with derived barriers. The only crate with unsafe code.
//!
//! It knows no geometry. What it knows:
//!
//! * [`Device`] is opened by [`DeviceDesc`]; [`Buffer`], [`Image`], [`Shader`], [`ComputePipeline`] and [`GraphicsPipeline`] are
//!   made from it. All are cheap to clone, and go when the last clone is dropped.
//! * A [`Recording`] is a plan: plain data, nothing happens. [`Device::submit`] checks it, derives its barriers from what the
//!   shaders declare, and hands it to the GPU. A [`Submission`] keeps alive what it uses. What runs again and again, as the
//!   frames of an animation do, is checked and encoded once by [`Device::prepare`].
//! * Layouts are read from the shaders ([`Reflection`]): buffers of descriptor set 0, pushed with every pass, and push constants.
//!   `readonly` and `writeonly` in GLSL spare barriers.
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
mod query;
mod recording;
mod rect;
mod reflect;
mod resource;
mod sampler;
mod select;
mod shader;
mod submission;
mod texture;

pub use bindings::Bindings;
pub use buffer::{Buffer, BufferDesc, BufferUsage, Memory};
pub use device::{Device, DeviceDesc, devices};
pub use error::{DeviceError, GpuError};
pub use format::{Format, Numbers};
pub use graphics::{
    Blend, Compare, Cull, DepthBias, DepthState, FrontFace, GraphicsPipeline, GraphicsPipelineDesc, PolygonMode,
    Tessellation, Topology,
};
pub use image::{Image, ImageDesc, ImageRegion, ImageUsage};
pub use info::{DeviceInfo, DeviceKind, Features, Limits};
pub use memory::MemoryUse;
pub use messages::MessageLog;
pub use pipeline::{ComputePipeline, ComputePipelineDesc};
pub use prepared::{Prepared, Workload};
pub use query::{PassStatistics, Report};
pub use recording::{
    CapturePass, ColorTarget, ComputePass, DepthTarget, Draw, Measure, Recording, RenderPass, Vertices,
};
pub use rect::Rect;
pub use reflect::{Extent, ReflectError, Reflection, ResourceBinding, ResourceKind, SpecConstant, Stage, reflect};
pub use sampler::{Filter, Sampler, SamplerDesc, Wrap};
pub use shader::Shader;
pub use submission::Submission;
