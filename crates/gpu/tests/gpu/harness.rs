//! What the tests share.

use osculate_gpu::{
    Bindings, Buffer, ComputePass, ComputePipeline, ComputePipelineDesc, Device, DeviceDesc, Format, Image, ImageDesc,
    ImageUsage, Shader,
};
use osculate_shader_compiler::{CompileDesc, compile};

/// Opens a device with validation, runs the test, closes the device, and fails if there was any message in between, complaints
/// about objects left over at the end among them.
pub(crate) fn with_device(test: impl FnOnce(&Device)) {
    let device = open(true);
    let log = device.message_log();
    test(&device);
    drop(device);
    assert!(log.all().is_empty(), "validation messages:\n{}", log.all().join("\n"));
}

/// Opens the device that the environment names, or the best one.
pub(crate) fn open(validation: bool) -> Device {
    let select = std::env::var("OSCULATE_DEVICE").ok();
    let device = Device::new(&DeviceDesc {
        select,
        validation,
        application: "osculate-gpu tests".to_owned(),
        ..DeviceDesc::default()
    });
    device.unwrap_or_else(|error| panic!("these tests need a Vulkan device and the validation layers: {error}"))
}

/// Compiles GLSL; the extension of `name` gives the stage.
pub(crate) fn spirv(name: &str, source: &str) -> Vec<u32> {
    let source = format!("#version 460\n{source}");
    compile(&CompileDesc::new(name, &source)).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn shader(device: &Device, name: &str, source: &str) -> Shader {
    device.shader(name, &spirv(name, source)).unwrap()
}

pub(crate) fn compute_pipeline(device: &Device, name: &str, source: &str) -> ComputePipeline {
    let shader = shader(device, name, source);
    device.compute_pipeline(&ComputePipelineDesc { name, shader: &shader, specialization: &[] }).unwrap()
}

/// A pass without push constants over so many invocations.
pub(crate) fn compute_pass(pipeline: &ComputePipeline, bindings: Bindings, invocations: u32) -> ComputePass {
    ComputePass {
        name: pipeline.name().to_owned(),
        groups: pipeline.groups_for(invocations),
        pipeline: pipeline.clone(),
        bindings,
        push: vec![],
    }
}

/// Buffers at the bindings 0, 1, ..
pub(crate) fn bind(buffers: &[&Buffer]) -> Bindings {
    (0..).zip(buffers).fold(Bindings::new(), |bindings, (number, buffer)| bindings.with(number, buffer))
}

pub(crate) fn target(device: &Device, name: &str, format: Format, samples: u32) -> Image {
    let copied = if samples == 1 { ImageUsage::COPY_SRC } else { ImageUsage::empty() };
    let usage = ImageUsage::TARGET | copied;
    device.image(&ImageDesc { name, size: [16, 16], format, samples, usage, ..ImageDesc::default() }).unwrap()
}
