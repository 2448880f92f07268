//! Devices that belong to somebody else, and work in command buffers of theirs.

mod own;

use osculate_gpu::{
    Attachments, Bindings, BufferDesc, BufferUsage, CallerSet, CallerSetLayout, CapturePass, Device, DeviceError, Draw,
    Enabled, EncodeDraws, Features, Filter, Format, GpuError, GraphicsPipeline, GraphicsPipelineDesc, ImageDesc,
    ImageUsage, Memory, Recording, SamplerDesc, ash::vk,
};

use crate::harness::{bind, compute_pass, compute_pipeline, shader, spirv};
use own::{Own, SIZE};

const DOUBLE: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer From { float from[]; };
layout(binding = 1) writeonly buffer To { float to[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < to.length()) to[i] = 2.0 * from[i];
}";

/// A triangle that covers everything.
const EVERYWHERE: &str = "
void main() { gl_Position = vec4(4.0 * (gl_VertexIndex & 1) - 1.0, 2.0 * (gl_VertexIndex & 2) - 1.0, 0.5, 1.0); }";

fn lent(test: impl FnOnce(&Own, &Device)) {
    let own = Own::new(|enabled| enabled);
    let device = own.lend().unwrap();
    test(&own, &device);
}

fn buffer(device: &Device, name: &str, size: u64, memory: Memory) -> osculate_gpu::Buffer {
    let usage = BufferUsage::STORAGE | BufferUsage::UNIFORM;
    device.buffer(&BufferDesc { name, size, usage, memory }).unwrap()
}

/// The library's objects go before the caller's device does, and leave nothing behind; what the library submits itself works
/// as ever.
#[test]
fn a_lent_device_does_everything_and_stays_the_callers() {
    let own = Own::new(|enabled| enabled);
    let device = own.lend().unwrap();
    assert_eq!(device.info().features, own.enabled.features());
    let numbers = device.upload("numbers", BufferUsage::STORAGE, &[3.0f32; 64]).unwrap();
    let doubled = buffer(&device, "doubled", 256, Memory::Device);
    let pipeline = compute_pipeline(&device, "double.comp", DOUBLE);
    let mut recording = Recording::new();
    recording.compute(compute_pass(&pipeline, bind(&[&numbers, &doubled]), 64));
    device.run(&recording).unwrap();
    assert_eq!(device.download::<f32>(&doubled, ..).unwrap(), [6.0; 64]);
    drop((numbers, doubled, pipeline, recording, device));
    // The device is alive: this would be a message, or a crash.
    own.wait(own.submit(own.begin()));
}

#[test]
fn what_is_not_switched_on_is_named() {
    type Change = fn(&mut Enabled);
    let off: [(&str, Change); 3] = [
        ("robustBufferAccess", |enabled| enabled.core.robust_buffer_access = vk::FALSE),
        ("timelineSemaphore", |enabled| enabled.vulkan12.timeline_semaphore = vk::FALSE),
        ("VK_KHR_push_descriptor", |enabled| enabled.extensions.clear()),
    ];
    for (name, change) in off {
        let mut own = Own::new(|enabled| enabled);
        change(&mut own.enabled);
        match own.lend().unwrap_err() {
            DeviceError::NotEnabled { feature, .. } => assert_eq!(feature, name),
            error => panic!("{error}"),
        }
    }
    let own = Own::new(|enabled| enabled);
    // SAFETY: refused before anything is used.
    let error =
        unsafe { Device::from_raw(osculate_gpu::RawDeviceDesc { queue_family: 99, ..own.desc() }) }.unwrap_err();
    assert!(error.to_string().contains("queue family 99"), "{error}");
}

#[test]
fn optional_features_that_are_off_are_absent() {
    let own = Own::new(|enabled| enabled.without(Features::ALL));
    let device = own.lend().unwrap();
    assert_eq!(device.info().features, Features::default());
    assert_eq!(device.info().limits.max_patch_vertices, 0);
}

/// Two frames are written before either runs: each has the data that it was written with.
#[test]
fn frames_under_way_have_data_of_their_own() {
    lent(|own, device| {
        let pipeline = compute_pipeline(device, "double.comp", DOUBLE);
        for count in [100u32, 50_000] {
            let size = u64::from(count) * 4;
            let [input, doubled] = ["input", "doubled"].map(|name| buffer(device, name, size, Memory::Device));
            let frames: Vec<_> = [1.0f32, 10.0]
                .map(|value| {
                    let output = buffer(device, "output", size, Memory::Readback);
                    let mut recording = Recording::new();
                    recording.write(&input, 0, &vec![value; count as usize]);
                    recording.write(&input, 8, &[value + 1.0]);
                    recording.compute(compute_pass(&pipeline, bind(&[&input, &doubled]), count));
                    recording.copy_buffer(&doubled, 0..size, &output, 0);
                    let commands = own.begin();
                    // SAFETY: submitted once, in this order, below; kept until then.
                    let encoded = unsafe { device.encode(commands, &recording) }.unwrap();
                    (commands, encoded, output, value)
                })
                .into();
            let fences: Vec<_> = frames.iter().map(|(commands, ..)| own.submit(*commands)).collect();
            for ((_, encoded, output, value), fence) in frames.into_iter().zip(fences) {
                assert!(matches!(output.read::<f32>(..), Err(GpuError::InUse { .. })), "it may not have run yet");
                own.wait(fence);
                drop(encoded);
                let found = output.read::<f32>(..).unwrap();
                assert_eq!(
                    [found[0], found[2], found[count as usize - 1]],
                    [2.0 * value, 2.0 * value + 2.0, 2.0 * value]
                );
            }
        }
    });
}

/// The host is kept off what commands read until they are done with, and is told what to do instead.
#[test]
fn held_buffers_are_not_written() {
    lent(|own, device| {
        let [input, output] = ["input", "output"].map(|name| buffer(device, name, 16, Memory::Upload));
        input.write(0, &[1.0f32; 4]).unwrap();
        let mut recording = Recording::new();
        recording.copy_buffer(&input, 0..16, &output, 0);
        let commands = own.begin();
        // SAFETY: never submitted.
        let encoded = unsafe { [device.encode(commands, &recording), device.encode(commands, &recording)] };
        for one in encoded {
            let error = input.write(0, &[2.0f32]).unwrap_err();
            assert!(matches!(&error, GpuError::InUse { name, .. } if name == "input"), "{error}");
            assert!(error.to_string().contains("Recording::write"), "{error}");
            drop(one.unwrap());
        }
        input.write(0, &[2.0f32]).unwrap();
    });
}

#[test]
fn writes_are_checked() {
    lent(|own, device| {
        let target = buffer(device, "target", 16, Memory::Device);
        let cases: [(u64, &[u8], &str); 3] =
            [(12, &[0; 8], "16 bytes"), (2, &[0; 4], "multiples of 4"), (0, &[0; 3], "multiples of 4")];
        for (offset, data, reason) in cases {
            let mut recording = Recording::new();
            recording.write(&target, offset, data);
            // SAFETY: never submitted.
            let error = unsafe { device.encode(own.begin(), &recording) }.unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
        let mut recording = Recording::new();
        recording.write::<u8>(&target, 16, &[]);
        device.run(&recording).unwrap();
    });
}

/// Captures count triangles, which nobody would read here.
#[test]
fn captures_are_refused() {
    lent(|own, device| {
        let usage = BufferUsage::CAPTURE;
        let buffer = device.buffer(&BufferDesc { name: "b", size: 64, usage, memory: Memory::Device }).unwrap();
        let mut recording = Recording::new();
        recording.capture(CapturePass { name: "mine".to_owned(), buffer, offset: 0, draws: vec![] });
        // SAFETY: never submitted.
        let error = unsafe { device.encode(own.begin(), &recording) }.unwrap_err().to_string();
        assert!(error.contains("\"mine\"") && error.contains("captures"), "{error}");
    });
}

/// Draws everything in what a fragment shader of the caller's says.
fn covering(
    device: &Device,
    fragment: &osculate_gpu::Shader,
    set: Option<CallerSetLayout>,
    colors: usize,
) -> GraphicsPipeline {
    let vertex = shader(device, "everywhere.vert", EVERYWHERE);
    let colors = vec![vk::Format::R8G8B8A8_UNORM; colors];
    let attachments = Some(Attachments { colors: &colors, ..Attachments::default() });
    let desc = GraphicsPipelineDesc {
        fragment: Some(fragment),
        attachments,
        caller_set: set,
        ..GraphicsPipelineDesc::new("covering", &vertex)
    };
    device.graphics_pipeline(&desc).unwrap()
}

fn draw(pipeline: &GraphicsPipeline, bindings: Bindings) -> Draw {
    let (pipeline, push) = (pipeline.clone(), vec![]);
    Draw { pipeline, bindings, push, vertices: (0..3).into(), attributes: None, instances: 0..1, scissor: None }
}

fn whole(draws: &[Draw]) -> EncodeDraws<'_> {
    let size = SIZE as f32;
    let viewport = vk::Viewport { width: size, height: size, max_depth: 1.0, ..vk::Viewport::default() };
    EncodeDraws { draws, viewport, area: [SIZE; 2].into(), caller_set: None }
}

/// A descriptor set of the caller's with one uniform buffer.
struct Set {
    layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
}

fn set_of(own: &Own, buffer: vk::Buffer) -> Set {
    let kind = vk::DescriptorType::UNIFORM_BUFFER;
    let binding = vk::DescriptorSetLayoutBinding::default()
        .descriptor_type(kind)
        .descriptor_count(1)
        .stage_flags(vk::ShaderStageFlags::FRAGMENT);
    let (bindings, sizes) = ([binding], [vk::DescriptorPoolSize { ty: kind, descriptor_count: 1 }]);
    // SAFETY: plain parameters; destroyed by `destroy_set`.
    unsafe {
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let layout = own.device.create_descriptor_set_layout(&info, None).unwrap();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let pool = own.device.create_descriptor_pool(&info, None).unwrap();
        let layouts = [layout];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        let set = own.device.allocate_descriptor_sets(&info).unwrap()[0];
        let infos = [vk::DescriptorBufferInfo { buffer, offset: 0, range: vk::WHOLE_SIZE }];
        let write = vk::WriteDescriptorSet::default().dst_set(set).descriptor_type(kind).buffer_info(&infos);
        own.device.update_descriptor_sets(&[write], &[]);
        Set { layout, pool, set }
    }
}

fn destroy_set(own: &Own, set: Set) {
    // SAFETY: nothing is in flight.
    unsafe {
        own.device.destroy_descriptor_pool(set.pool, None);
        own.device.destroy_descriptor_set_layout(set.layout, None);
    }
}

/// Two attachments; what is drawn comes half from a buffer of the library's, half from a descriptor set of the caller's.
#[test]
fn draws_go_into_the_callers_rendering_with_the_callers_set() {
    const FRAGMENT: &str = "
layout(binding = 3) uniform Ours { vec4 ours; };
layout(set = 1, binding = 0) uniform Theirs { vec4 theirs; };
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() { first = vec4(ours.rg, theirs.ba); second = vec4(1.0); }";
    lent(|own, device| {
        let theirs = own.shared(16, vk::BufferUsageFlags::UNIFORM_BUFFER);
        own.touch(&theirs, |bytes| bytes.copy_from_slice(bytemuck::bytes_of(&[0.0f32, 0.0, 0.4, 0.8])));
        let set = set_of(own, theirs.buffer);
        // SAFETY: the module needs nothing but what every device has, and the layout outlives the pipeline.
        let (fragment, layout) = unsafe {
            (device.caller_shader("f.frag", &spirv("f.frag", FRAGMENT)).unwrap(), CallerSetLayout::new(set.layout))
        };
        assert!(fragment.reflection().uses_caller_set);
        assert_eq!(fragment.reflection().resources.len(), 1);
        let pipeline = covering(device, &fragment, Some(layout), 2);
        let ours = buffer(device, "ours", 16, Memory::Device);
        let draws = [draw(&pipeline, Bindings::new().with(3, &ours))];
        let canvases = [own.canvas(), own.canvas()];
        let texels = own.shared(u64::from(SIZE * SIZE) * 4, vk::BufferUsageFlags::TRANSFER_DST);
        let commands = own.begin();
        let mut recording = Recording::new();
        recording.write(&ours, 0, &[0.2f32, 0.6, 0.0, 0.0]);
        // SAFETY: submitted once, below; both are kept until then.
        let update = unsafe { device.encode(commands, &recording) }.unwrap();
        own.begin_rendering(commands, &[&canvases[0], &canvases[1]]);
        // SAFETY: as above; the formats are those of the pipeline.
        let missing = unsafe { device.encode_draws(commands, &whole(&draws)) }.unwrap_err().to_string();
        assert!(missing.contains("descriptor set 1"), "{missing}");
        let caller_set = Some(CallerSet { set: set.set, dynamic_offsets: &[] });
        // SAFETY: as above.
        let drawn = unsafe { device.encode_draws(commands, &EncodeDraws { caller_set, ..whole(&draws) }) }.unwrap();
        own.end_rendering(commands, &canvases[0], &texels);
        own.wait(own.submit(commands));
        drop((update, drawn));
        let found = own.touch(&texels, |bytes| bytes.to_vec());
        assert!(found.chunks(4).all(|texel| texel == [51, 153, 102, 204]), "{:?}", &found[..4]);
        drop((draws, pipeline, fragment, ours));
        canvases.into_iter().for_each(|canvas| own.destroy(canvas));
        destroy_set(own, set);
        own.free(theirs);
        own.free(texels);
        assert_eq!(own.messages(), [""; 0]);
    });
}

/// Within one command buffer, what draws read is written only when they are done with it: synchronization validation would say so, and the colours would.
#[test]
fn updates_and_draws_take_turns_in_one_command_buffer() {
    const FRAGMENT: &str = "
layout(binding = 3) readonly buffer Ours { vec4 ours[]; };
layout(location = 0) out vec4 color;
void main() { color = ours[1]; }";
    lent(|own, device| {
        let fragment = shader(device, "f.frag", FRAGMENT);
        let pipeline = covering(device, &fragment, None, 1);
        let doubling = compute_pipeline(device, "double.comp", DOUBLE);
        let [input, ours] = ["input", "ours"].map(|name| buffer(device, name, 32, Memory::Device));
        let draws = [draw(&pipeline, Bindings::new().with(3, &ours))];
        let bytes = u64::from(SIZE * SIZE) * 4;
        let parts = [0.1f32, 0.3, 0.2]
            .map(|value| (value, own.canvas(), own.shared(bytes, vk::BufferUsageFlags::TRANSFER_DST)));
        let commands = own.begin();
        let mut kept = Vec::new();
        for (value, canvas, texels) in &parts {
            let mut recording = Recording::new();
            recording.write(&input, 0, &[*value; 8]);
            recording.compute(compute_pass(&doubling, bind(&[&input, &ours]), 8));
            // SAFETY: submitted once, below; everything is kept until then.
            kept.push(unsafe { device.encode(commands, &recording) }.unwrap());
            own.begin_rendering(commands, &[canvas]);
            // SAFETY: as above; the format is that of the pipeline.
            kept.push(unsafe { device.encode_draws(commands, &whole(&draws)) }.unwrap());
            own.end_rendering(commands, canvas, texels);
        }
        own.wait(own.submit(commands));
        drop(kept);
        for (value, canvas, texels) in parts {
            let expected = [(2.0 * value * 255.0).round() as u8; 4];
            let found = own.touch(&texels, |bytes| bytes.to_vec());
            assert!(found.chunks(4).all(|texel| texel == expected), "{:?}, not {expected:?}", &found[..4]);
            own.destroy(canvas);
            own.free(texels);
        }
    });
}

/// A texture is brought into its layout when it is first used, and stays there while commands rely on it.
#[test]
fn textures_keep_their_layout_while_commands_use_them() {
    const FRAGMENT: &str = "
layout(binding = 1) uniform sampler2D picture;
layout(location = 0) out vec4 color;
void main() { color = texelFetch(picture, ivec2(0), 0); }";
    lent(|own, device| {
        let usage = ImageUsage::SAMPLED | ImageUsage::COPY_DST;
        let desc =
            ImageDesc { name: "picture", size: [1, 1], format: Format::Rgba8Unorm, usage, ..ImageDesc::default() };
        let picture = device.upload_image(&desc, &[[9u8, 8, 7, 6]]).unwrap();
        let nearest = SamplerDesc { magnify: Filter::Nearest, minify: Filter::Nearest, ..SamplerDesc::default() };
        let sampler = device.sampler(&nearest).unwrap();
        let fragment = shader(device, "f.frag", FRAGMENT);
        let pipeline = covering(device, &fragment, None, 1);
        let draws = [draw(&pipeline, Bindings::new().with_texture(1, &picture, &sampler))];
        let canvas = own.canvas();
        let texels = own.shared(u64::from(SIZE * SIZE) * 4, vk::BufferUsageFlags::TRANSFER_DST);
        for expected in [[9, 8, 7, 6], [1, 2, 3, 4]] {
            device.write_image(picture.level(0), &[expected]).unwrap();
            let commands = own.begin();
            own.begin_rendering(commands, &[&canvas]);
            // SAFETY: submitted once, below, and kept until then.
            let drawn = unsafe { device.encode_draws(commands, &whole(&draws)) }.unwrap();
            own.end_rendering(commands, &canvas, &texels);
            let error = device.write_image(picture.level(0), &[[0u8; 4]]).unwrap_err();
            assert!(matches!(&error, GpuError::InUse { name, .. } if name == "picture"), "{error}");
            own.wait(own.submit(commands));
            drop(drawn);
            let found = own.touch(&texels, |bytes| bytes.to_vec());
            assert!(found.chunks(4).all(|texel| texel == expected), "{:?}", &found[..4]);
        }
        drop((draws, pipeline));
        own.destroy(canvas);
        own.free(texels);
    });
}

/// A shader with a set 1 goes nowhere without a layout, and not through the door of safe shaders.
#[test]
fn set_1_is_for_callers_who_say_so() {
    const FRAGMENT: &str = "
layout(set = 1, binding = 0) uniform Theirs { vec4 theirs; };
layout(location = 0) out vec4 color;
void main() { color = theirs; }";
    lent(|_, device| {
        let words = spirv("f.frag", FRAGMENT);
        let error = device.shader("f.frag", &words).unwrap_err().to_string();
        assert!(error.contains("descriptor set 1"), "{error}");
        // SAFETY: the module needs nothing but what every device has.
        let fragment = unsafe { device.caller_shader("f.frag", &words) }.unwrap();
        let vertex = shader(device, "v.vert", EVERYWHERE);
        let colors = [vk::Format::R8G8B8A8_UNORM];
        let attachments = Some(Attachments { colors: &colors, ..Attachments::default() });
        let desc =
            GraphicsPipelineDesc { fragment: Some(&fragment), attachments, ..GraphicsPipelineDesc::new("p", &vertex) };
        let error = device.graphics_pipeline(&desc).unwrap_err().to_string();
        assert!(error.contains("descriptor set 1"), "{error}");
        let depth = Some(Attachments { depth: vk::Format::R8G8B8A8_UNORM, ..Attachments::default() });
        let desc = GraphicsPipelineDesc { attachments: depth, ..GraphicsPipelineDesc::new("p", &vertex) };
        let error = device.graphics_pipeline(&desc).unwrap_err().to_string();
        assert!(error.contains("R8G8B8A8_UNORM"), "{error}");
    });
}
