//! What can go wrong: [`DeviceError`] before there is a device, [`GpuError`] afterwards.

use ash::vk;

use crate::{ReflectError, ResourceKind, Stage};

/// Why no device could be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// The Vulkan loader library could not be opened.
    #[error(
        "no Vulkan loader ({reason}): install the loader (package libvulkan1) and a driver (package mesa-vulkan-drivers)"
    )]
    NoLoader {
        /// What the dynamic linker said.
        reason: String,
    },
    /// The loader works, but no driver offers a device.
    #[error(
        "Vulkan offers no device: install a driver (package mesa-vulkan-drivers also has one that runs on the CPU)"
    )]
    NoDevice,
    /// No device has the wanted index or a name that contains the wanted text.
    #[error("no Vulkan device matches {wanted:?}; there are: {}", available.join(", "))]
    NoMatch {
        /// What was asked for.
        wanted: String,
        /// Index and name of every device there is.
        available: Vec<String>,
    },
    /// The device lacks something that every use of this crate needs.
    #[error("device {device:?} lacks {feature}: choose another device or update its driver")]
    MissingFeature {
        /// Name of the device.
        device: String,
        /// The first missing feature, extension or version.
        feature: String,
    },
    /// The device has something that every use of this crate needs, but was created without it.
    #[error(
        "device {device:?} was created without {feature}: switch it on in vkCreateDevice, as gpu::Enabled::wanted says"
    )]
    NotEnabled {
        /// Name of the device.
        device: String,
        /// The first feature or extension that is off.
        feature: String,
    },
    /// Validation was asked for, but its layer is not installed.
    #[error(
        "the Vulkan validation layer is not installed: install it (package vulkan-validationlayers) or do without validation"
    )]
    NoValidationLayer,
    /// Vulkan shows nothing in the windows of this system.
    #[error("Vulkan cannot draw to windows here: no driver has {missing}")]
    NoPresentation {
        /// The instance extension that is missing, or what is wrong with the windows.
        missing: String,
    },
    /// The driver or the loader refused a call.
    #[error("{operation} failed: {result}")]
    Vulkan {
        /// What was tried.
        operation: &'static str,
        /// What Vulkan answered.
        result: vk::Result,
    },
}

/// Why an operation on a device failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is not enough memory, on the device or on the host.
    #[error("out of memory for {what} ({bytes} bytes)")]
    OutOfMemory {
        /// The object that did not fit.
        what: String,
        /// The size it needed, in bytes; 0 if unknown.
        bytes: u64,
    },
    /// The device stopped answering: every later call will fail too.
    #[error("the device was lost during {during}")]
    DeviceLost {
        /// What was tried.
        during: String,
    },
    /// A window cannot be drawn to.
    #[error("window {window:?} cannot be drawn to: {reason}")]
    Window {
        /// Name of the presenter.
        window: String,
        /// Why not.
        reason: String,
    },
    /// An image of a window was used while it belongs to the window.
    #[error("image {image:?} belongs to its window: acquire a frame, and use its image until it is presented")]
    NotAcquired {
        /// Name of the image.
        image: String,
    },
    /// Commands in a caller's command buffer use it, and may not have run yet.
    #[error(
        "{name:?} is in use by encoded commands: drop their gpu::Encoded once they have run, or change it by commands too ({instead})"
    )]
    InUse {
        /// Name of the buffer or image.
        name: String,
        /// How to do without waiting.
        instead: &'static str,
    },
    /// The driver refused a call.
    #[error("{operation} failed: {result}")]
    Vulkan {
        /// What was tried, and on what.
        operation: String,
        /// What Vulkan answered.
        result: vk::Result,
    },
    /// The device lacks a feature that is optional in this crate.
    #[error("{what} needs {feature}, which device {device:?} lacks")]
    MissingFeature {
        /// What needs the feature.
        what: String,
        /// The feature.
        feature: &'static str,
        /// Name of the device.
        device: String,
    },
    /// A value exceeds a limit of the device.
    #[error("{what}: {value} exceeds the device's limit of {limit}")]
    Limit {
        /// What the value is.
        what: String,
        /// The value.
        value: u64,
        /// The most that the device takes.
        limit: u64,
    },
    /// An access reaches beyond the end of a buffer.
    #[error("buffer {buffer:?} has {size} bytes, {what} needs bytes {start}..{end}")]
    OutOfBounds {
        /// Name of the buffer.
        buffer: String,
        /// Its size in bytes.
        size: u64,
        /// The access.
        what: String,
        /// First byte of the access.
        start: u64,
        /// One past its last byte.
        end: u64,
    },
    /// A buffer was asked for something its memory or usage does not allow.
    #[error("buffer {buffer:?} cannot be used for {what}: {reason}")]
    BufferUsage {
        /// Name of the buffer.
        buffer: String,
        /// The use.
        what: String,
        /// Why not, and what to do.
        reason: &'static str,
    },
    /// An image was asked for something its format, samples or usage do not allow.
    #[error("image {image:?} cannot be used for {what}: {reason}")]
    ImageUsage {
        /// Name of the image.
        image: String,
        /// The use.
        what: String,
        /// Why not, and what to do.
        reason: String,
    },
    /// A shader could not be reflected.
    #[error("shader {shader:?}: {source}")]
    Shader {
        /// Name of the shader.
        shader: String,
        /// What is wrong with it.
        source: ReflectError,
    },
    /// A shader was put in the place of another stage.
    #[error("pipeline {pipeline:?} wants a {wanted} shader, but {shader:?} is a {found} shader")]
    WrongStage {
        /// Name of the pipeline.
        pipeline: String,
        /// Name of the shader.
        shader: String,
        /// The stage the place is for.
        wanted: Stage,
        /// The stage of the shader.
        found: Stage,
    },
    /// Two stages of a pipeline declare one binding differently.
    #[error(
        "pipeline {pipeline:?}: binding {binding} is a {first_kind} in {first:?} but a {second_kind} in {second:?}"
    )]
    BindingConflict {
        /// Name of the pipeline.
        pipeline: String,
        /// The binding number.
        binding: u32,
        /// The shader that declares it first.
        first: String,
        /// What it declares.
        first_kind: ResourceKind,
        /// The shader that declares it otherwise.
        second: String,
        /// What that one declares.
        second_kind: ResourceKind,
    },
    /// A pipeline's description contradicts itself.
    #[error("pipeline {pipeline:?}: {reason}")]
    PipelineDesc {
        /// Name of the pipeline.
        pipeline: String,
        /// The contradiction.
        reason: String,
    },
    /// A pass does not bind a buffer or image that a shader reads or writes.
    #[error("pass {pass:?} binds nothing to binding {binding}, which shader {shader:?} declares as {name:?}")]
    MissingBinding {
        /// Name of the pass.
        pass: String,
        /// Name of the shader.
        shader: String,
        /// The binding number.
        binding: u32,
        /// The shader's name for it.
        name: String,
    },
    /// A pass gives a pipeline the wrong number of push constant bytes.
    #[error("pass {pass:?} gives {given} bytes of push constants, pipeline {pipeline:?} declares {wanted}")]
    PushConstants {
        /// Name of the pass.
        pass: String,
        /// Name of the pipeline.
        pipeline: String,
        /// Bytes given.
        given: usize,
        /// Bytes declared.
        wanted: u32,
    },
    /// A pass contradicts itself or its pipelines.
    #[error("pass {pass:?}: {reason}")]
    Pass {
        /// Name of the pass.
        pass: String,
        /// The contradiction.
        reason: String,
    },
    /// A captured stream did not fit its buffer; what was written is incomplete.
    #[error("pass {pass:?} captured {needed} primitives, but its buffer took only {written}")]
    CaptureOverflow {
        /// Name of the pass.
        pass: String,
        /// Primitives that would have been written into a large enough buffer.
        needed: u64,
        /// Primitives written.
        written: u64,
    },
    /// The pipeline cache could not be read or written.
    #[error("pipeline cache {path}: {source}")]
    PipelineCache {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
}

impl GpuError {
    /// Sorts a Vulkan result into the variants that callers tell apart.
    pub(crate) fn from_vulkan(operation: impl Into<String>, result: vk::Result) -> Self {
        let operation = operation.into();
        match result {
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost { during: operation },
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
                Self::OutOfMemory { what: operation, bytes: 0 }
            }
            result => Self::Vulkan { operation, result },
        }
    }
}
