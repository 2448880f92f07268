//! Wrong use is an error that names what is wrong, not undefined behaviour and not a validation message.

use osculate_gpu::{
    Bindings, Buffer, BufferDesc, BufferUsage, CapturePass, ColorTarget, ComputePass, ComputePipelineDesc, DepthState,
    DepthTarget, Device, Draw, Format, GpuError, GraphicsPipeline, GraphicsPipelineDesc, ImageDesc, ImageUsage, Memory,
    Recording, Rect, RenderPass, SamplerDesc, Topology, Vertices,
};

use crate::harness::{bind, compute_pass, compute_pipeline, open, shader, spirv, target, with_device};

const COPY: &str = "
layout(push_constant) uniform Push { uint count; };
layout(binding = 0) readonly buffer Source { uint source[]; };
layout(binding = 1) writeonly buffer Target { uint target[]; };
void main() { if (gl_GlobalInvocationID.x < count) target[gl_GlobalInvocationID.x] = source[gl_GlobalInvocationID.x]; }";

fn recorded(record: impl FnOnce(&mut Recording)) -> Recording {
    let mut recording = Recording::new();
    record(&mut recording);
    recording
}

/// Submits what `record` records, which must fail with all of `parts` in the message.
fn refused(device: &Device, parts: &[&str], record: impl FnOnce(&mut Recording)) {
    let error = device.submit(&recorded(record)).expect_err("this must be refused").to_string();
    assert!(parts.iter().all(|part| error.contains(part)), "{parts:?} in {error:?}");
}

fn words(device: &Device, name: &str, usage: BufferUsage) -> Buffer {
    device.upload(name, usage, &[0u32; 64]).unwrap()
}

#[test]
fn bindings_and_push_constants_are_checked() {
    with_device(|device| {
        let pipeline = compute_pipeline(device, "copy.comp", COPY);
        let (storage, index) =
            (words(device, "words", BufferUsage::STORAGE), words(device, "indices", BufferUsage::INDEX));
        let pass = |bindings: Bindings, push: Vec<u8>| ComputePass {
            push,
            name: "step".to_owned(),
            ..compute_pass(&pipeline, bindings, 1)
        };
        let good = vec![0; 4];
        let missing = pass(Bindings::new().with(0, &storage), good.clone());
        refused(device, &["\"step\"", "\"copy.comp\"", "binding 1", "\"Target\""], |r| r.compute(missing));
        let short = pass(bind(&[&storage, &storage]), vec![]);
        refused(device, &["\"step\"", "0 bytes", "declares 4"], |r| r.compute(short));
        let unfit = pass(bind(&[&storage, &index]), good.clone());
        refused(device, &["\"indices\"", "binding 1"], |r| r.compute(unfit));
        let beyond = pass(bind(&[&storage]).with_range(1, &storage, 0..1000), good.clone());
        refused(device, &["\"words\"", "256 bytes", "0..1000"], |r| r.compute(beyond));
        let empty = pass(bind(&[&storage]).with_range(1, &storage, 8..8), good.clone());
        refused(device, &["binding 1", "empty"], |r| r.compute(empty));
        let many = ComputePass { groups: [u32::MAX, 1, 1], ..pass(bind(&[&storage, &storage]), good) };
        if device.info().limits.max_work_groups[0] < u32::MAX {
            refused(device, &["work groups", "\"step\""], |r| r.compute(many));
        }
    });
}

#[test]
fn objects_of_another_device_are_refused() {
    with_device(|device| {
        let other = open(false);
        let theirs = words(&other, "theirs", BufferUsage::STORAGE);
        let ours = words(device, "ours", BufferUsage::STORAGE);
        refused(device, &["\"theirs\"", "another device"], |r| r.copy_buffer(&ours, 0..4, &theirs, 0));
        let pipeline = compute_pipeline(&other, "nothing.comp", "void main() {}");
        refused(device, &["\"nothing.comp\"", "another device"], |r| r.compute(compute_pass(&pipeline, bind(&[]), 1)));
        let shader = shader(&other, "theirs.comp", "void main() {}");
        let desc = ComputePipelineDesc { name: "mixed", shader: &shader, specialization: &[] };
        assert!(matches!(device.compute_pipeline(&desc), Err(GpuError::PipelineDesc { .. })));
    });
}

#[test]
fn copies_are_checked() {
    with_device(|device| {
        let buffer = words(device, "words", BufferUsage::empty());
        refused(device, &["\"words\"", "256 bytes", "200..300"], |r| r.copy_buffer(&buffer, 200..300, &buffer, 0));
        refused(device, &["256 bytes", "250..258"], |r| r.copy_buffer(&buffer, 0..8, &buffer, 250));
        refused(device, &["overlaps"], |r| r.copy_buffer(&buffer, 0..8, &buffer, 4));
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        refused(device, &["\"words\"", "0..1024"], |r| r.copy_image_to_buffer(&image, &buffer));
        let large = device.upload("large", BufferUsage::empty(), &[0u8; 1024]).unwrap();
        refused(device, &["nothing was drawn"], |r| r.copy_image_to_buffer(&image, &large));
    });
}

#[test]
fn copies_of_texels_are_checked() {
    with_device(|device| {
        let usage = ImageUsage::SAMPLED | ImageUsage::COPY_DST | ImageUsage::COPY_SRC;
        let desc = ImageDesc { name: "sheet", size: [8, 8], usage, levels: 2, ..ImageDesc::default() };
        let image = device.image(&desc).unwrap();
        let buffer = words(device, "words", BufferUsage::empty());
        let region = |level, origin, size| image.region(level, Rect { origin, size });
        refused(device, &["\"words\"", "256 bytes", "4..260"], |r| r.copy_buffer_to_image(&buffer, 4, image.level(0)));
        refused(device, &["offset of 2 bytes"], |r| r.copy_buffer_to_image(&buffer, 2, image.level(1)));
        refused(device, &["level 2", "beyond"], |r| r.copy_buffer_to_image(&buffer, 0, region(2, [0, 0], [1, 1])));
        refused(device, &["level 1", "beyond"], |r| r.copy_buffer_to_image(&buffer, 0, region(1, [3, 0], [2, 1])));
        refused(device, &["level 0", "empty"], |r| r.copy_buffer_to_image(&buffer, 0, region(0, [3, 0], [0, 1])));
        refused(device, &["levels of sheet", "nothing was drawn"], |r| r.fill_levels(&image));
        let error = device.upload_image(&desc, &[0u8; 255]).unwrap_err().to_string();
        assert!(error.contains("255 bytes") && error.contains("256 are needed"), "{error}");
        let copied = device.image(&ImageDesc { usage: ImageUsage::SAMPLED | ImageUsage::STORAGE, ..desc }).unwrap();
        refused(device, &["\"sheet\"", "COPY_DST"], |r| r.copy_buffer_to_image(&buffer, 0, copied.level(0)));
    });
}

#[test]
fn images_in_bindings_are_checked() {
    with_device(|device| {
        let source = "layout(binding = 0) uniform sampler2D picture;
             layout(binding = 1, r32f) uniform image2D result;
             void main() { imageStore(result, ivec2(0), texture(picture, vec2(0.0))); }";
        let pipeline = compute_pipeline(device, "look.comp", source);
        let usage = ImageUsage::SAMPLED | ImageUsage::STORAGE;
        let desc = ImageDesc { name: "good", size: [4, 4], format: Format::R32Float, usage, ..ImageDesc::default() };
        let image = |desc: &ImageDesc<'_>| device.upload_image(desc, &[0u32; 16]).unwrap();
        let (good, result) = (image(&desc), image(&ImageDesc { name: "result", ..desc }));
        let sampler = device.sampler(&SamplerDesc { name: "mean", ..SamplerDesc::default() }).unwrap();
        let bound = |picture: &osculate_gpu::Image| Bindings::new().with_texture(0, picture, &sampler);
        let bindings = bound(&good).with_storage_image(1, &result);
        device.run(&recorded(|r| r.compute(compute_pass(&pipeline, bindings.clone(), 1)))).unwrap();
        let refused = |parts: &[&str], bindings: Bindings| {
            refused(device, parts, |r| r.compute(compute_pass(&pipeline, bindings, 1)));
        };
        refused(&["binding 1", "\"look.comp\"", "\"result\""], bound(&good));
        let words = words(device, "words", BufferUsage::STORAGE);
        refused(&["binding 0 is buffer \"words\"", "\"picture\" as a sampler2D"], bindings.clone().with(0, &words));
        refused(&["without a sampler", "as a sampler2D"], bindings.clone().with_storage_image(0, &good));
        refused(&["with a sampler", "storage image of R32Float"], bindings.clone().with_texture(1, &result, &sampler));
        let numbers = image(&ImageDesc { name: "numbers", format: Format::R32Uint, ..desc });
        refused(&["\"numbers\" of R32Uint", "as a sampler2D"], bindings.clone().with_texture(0, &numbers, &sampler));
        refused(&["\"numbers\" of R32Uint", "image of R32Float"], bindings.clone().with_storage_image(1, &numbers));
        let blank = device.image(&ImageDesc { name: "blank", ..desc }).unwrap();
        refused(&["samples image \"blank\""], bindings.clone().with_texture(0, &blank, &sampler));
        let unfit = image(&ImageDesc { name: "unfit", usage: ImageUsage::STORAGE, ..desc });
        refused(&["\"unfit\"", "SAMPLED"], bindings.clone().with_texture(0, &unfit, &sampler));
        refused(&["\"result\" in two roles"], bindings.clone().with_texture(0, &result, &sampler));
        let theirs = open(false).sampler(&SamplerDesc { name: "theirs", ..SamplerDesc::default() }).unwrap();
        refused(&["\"theirs\"", "another device"], bindings.with_texture(0, &good, &theirs));

        // Integers have no means: the sampler is what is wrong.
        let source = "layout(binding = 0) uniform usampler2D picture;
             layout(binding = 1) buffer Sum { uint sum; };
             void main() { sum = texture(picture, vec2(0.0)).r; }";
        let whole = compute_pipeline(device, "whole.comp", source);
        let mean = bound(&numbers).with(1, &words);
        let error = device.submit(&recorded(|r| r.compute(compute_pass(&whole, mean, 1)))).unwrap_err().to_string();
        assert!(error.contains("\"mean\"") && error.contains("R32Uint"), "{error}");
    });
}

#[test]
fn host_access_is_checked() {
    with_device(|device| {
        let make =
            |memory| device.buffer(&BufferDesc { name: "b", size: 10, usage: BufferUsage::STORAGE, memory }).unwrap();
        let upload = make(Memory::Upload);
        upload.write(2, &[1u16; 4]).unwrap();
        assert!(matches!(upload.write(3, &[1u16; 4]), Err(GpuError::OutOfBounds { .. })));
        assert!(matches!(upload.write(u64::MAX, &[1u16; 4]), Err(GpuError::OutOfBounds { .. })));
        assert!(matches!(upload.read::<u8>(..), Err(GpuError::BufferUsage { .. })));
        let readback = make(Memory::Readback);
        assert!(matches!(readback.write(0, &[1u8]), Err(GpuError::BufferUsage { .. })));
        assert_eq!(readback.read::<u32>(2..10).unwrap().len(), 2);
        assert!(matches!(readback.read::<u32>(..), Err(GpuError::BufferUsage { .. })), "ten bytes are no whole words");
        assert!(matches!(readback.read::<u8>(5..=10), Err(GpuError::OutOfBounds { .. })));
        let (start, end) = (7, 3);
        assert!(matches!(readback.read::<u8>(start..end), Err(GpuError::OutOfBounds { .. })));
        assert!(matches!(make(Memory::Device).write(0, &[1u8]), Err(GpuError::BufferUsage { .. })));
    });
}

#[test]
fn sizes_beyond_the_devices_limits_are_refused() {
    with_device(|device| {
        let size = u64::MAX;
        let desc = BufferDesc { name: "huge", size, usage: BufferUsage::STORAGE, memory: Memory::Device };
        assert!(matches!(device.buffer(&desc), Err(GpuError::Limit { .. })));
        let wide = ImageDesc {
            name: "wide",
            size: [1 << 24, 1],
            format: Format::Rgba8Unorm,
            usage: ImageUsage::TARGET,
            ..ImageDesc::default()
        };
        assert!(matches!(device.image(&wide), Err(GpuError::Limit { .. })));
        for odd in [
            ImageDesc { size: [0, 4], ..wide },
            ImageDesc { size: [4, 4], samples: 3, ..wide },
            ImageDesc { size: [4, 4], usage: ImageUsage::COPY_SRC, ..wide },
            ImageDesc { size: [4, 4], samples: 4, usage: ImageUsage::TARGET | ImageUsage::COPY_SRC, ..wide },
            ImageDesc { size: [4, 4], usage: ImageUsage::COPY_DST, ..wide },
            ImageDesc { size: [4, 4], levels: 0, ..wide },
            ImageDesc { size: [4, 4], levels: 4, ..wide },
            ImageDesc { size: [4, 4], levels: 2, samples: 4, ..wide },
            ImageDesc { size: [4, 4], format: Format::Rgba8Srgb, usage: ImageUsage::STORAGE, ..wide },
        ] {
            assert!(matches!(device.image(&odd), Err(GpuError::ImageUsage { .. })), "{odd:?}");
        }
    });
}

#[test]
fn shaders_in_the_wrong_place_are_refused() {
    with_device(|device| {
        let vertex = shader(device, "v.vert", "void main() { gl_Position = vec4(0.0); }");
        let desc = ComputePipelineDesc { name: "p", shader: &vertex, specialization: &[] };
        let error = device.compute_pipeline(&desc).unwrap_err().to_string();
        assert!(error.contains("wants a compute shader") && error.contains("\"v.vert\" is a vertex shader"), "{error}");
        let fragment = Some(&vertex);
        let desc = GraphicsPipelineDesc { fragment, ..GraphicsPipelineDesc::new("p", &vertex) };
        assert!(matches!(device.graphics_pipeline(&desc), Err(GpuError::WrongStage { .. })));
        assert!(matches!(device.shader("no", &[1, 2, 3]), Err(GpuError::Shader { .. })));
    });
}

#[test]
fn shaders_that_need_what_is_not_switched_on_are_refused() {
    with_device(|device| {
        let color = "layout(location = 0) out vec4 c;";
        let double = "layout(binding = 0) buffer B { float x; }; void main() { x = float(double(x) * 2.0lf); }";
        let long = "#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
             layout(binding = 0) buffer B { uint x; }; void main() { x = uint(uint64_t(x) >> 3); }";
        let primitive = format!("{color} void main() {{ c = vec4(gl_PrimitiveID); }}");
        let sample = format!("{color} void main() {{ c = vec4(gl_SampleID); }}");
        let clip = "out float gl_ClipDistance[1]; void main() { gl_ClipDistance[0] = 1.0; }";
        let writes = "layout(binding = 0) buffer Words { float word; };";
        let from_vertex = format!("{writes} void main() {{ word = 1.0; }}");
        let from_fragment = format!("{writes} {color} void main() {{ c = vec4(word); }}");
        for (name, source, parts) in [
            ("double.comp", double, ["capability Float64", "without"]),
            ("long.comp", long, ["capability Int64", "without"]),
            ("primitive.frag", &primitive, ["capability Geometry", "without"]),
            ("sample.frag", &sample, ["capability SampleRateShading", "without"]),
            ("clip.vert", clip, ["capability ClipDistance", "without"]),
            ("writes.vert", &from_vertex, ["\"Words\" can be written", "readonly in this vertex shader"]),
            ("reads.frag", &from_fragment, ["\"Words\" can be written", "readonly in this fragment shader"]),
        ] {
            let error = device.shader(name, &spirv(name, source)).unwrap_err().to_string();
            assert!(error.contains(name) && parts.iter().all(|part| error.contains(part)), "{error}");
        }
    });
}

/// A compute shader that reads `count` buffers of a kind, from the second binding on, and writes the first.
fn sum_of(kind: &str, count: u32) -> String {
    let declare = |i| format!("layout(binding = {i}) {kind} B{i} {{ float b{i}; }};");
    let add = |i| format!("sum += b{i};");
    let (declarations, additions): (String, String) = (1..=count).map(|i| (declare(i), add(i))).unzip();
    format!("layout(binding = 0) buffer Sum {{ float sum; }}; {declarations} void main() {{ {additions} }}")
}

#[test]
fn pipelines_bind_as_many_buffers_as_the_device_takes() {
    with_device(|device| {
        let limits = &device.info().limits;
        let all = limits.max_push_descriptors.min(limits.max_stage_resources);
        let storage = all.min(limits.max_stage_storage_buffers).min(limits.max_pipeline_storage_buffers);
        let uniform = (all - 1).min(limits.max_stage_uniform_buffers).min(limits.max_pipeline_uniform_buffers);
        // The sum is a storage buffer, too.
        for (kind, most) in [("readonly buffer", storage - 1), ("uniform", uniform)] {
            let make = |count| {
                let shader = shader(device, "sum.comp", &sum_of(kind, count));
                device.compute_pipeline(&ComputePipelineDesc { name: "sum", shader: &shader, specialization: &[] })
            };
            make(most).unwrap();
            match make(most + 1).unwrap_err() {
                GpuError::Limit { what, value, limit } => {
                    assert!(what.contains("buffers") && what.contains("\"sum\"") && value == limit + 1, "{what}");
                }
                error => panic!("{error}"),
            }
        }
    });
}

/// SPIR-V in which every capture has the given stride. GLSL compilers have limits of their own, so it is put in afterwards.
fn with_stride(mut words: Vec<u32>, stride: u32) -> Vec<u32> {
    const OP_DECORATE: u32 = 71;
    const XFB_STRIDE: u32 = 37;
    let mut position = 5;
    while position < words.len() {
        if words[position] & 0xffff == OP_DECORATE && words[position + 2] == XFB_STRIDE {
            words[position + 3] = stride;
        }
        position += (words[position] >> 16) as usize;
    }
    words
}

#[test]
fn captures_wider_than_the_device_takes_are_refused() {
    with_device(|device| {
        let source = "layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 4) out float x;
             void main() { x = 1.0; }";
        let make = |stride| device.shader("wide.vert", &with_stride(spirv("wide.vert", source), stride));
        let most = device.info().limits.max_capture_stride / 4 * 4;
        let widest = make(most).unwrap();
        let plain = GraphicsPipelineDesc::new("widest", &widest);
        let pipeline = device.graphics_pipeline(&GraphicsPipelineDesc { rasterizer_discard: true, ..plain }).unwrap();
        assert_eq!(pipeline.capture_stride(), Some(most));
        let error = make(most + 4).unwrap_err().to_string();
        let wanted = format!("bytes per vertex that shader \"wide.vert\" captures: {} exceeds", most + 4);
        assert!(error.contains(&wanted), "{error}");
    });
}

#[test]
fn contradictory_pipelines_are_refused() {
    with_device(|device| {
        let vertex = shader(device, "v.vert", "void main() { gl_Position = vec4(0.0); }");
        let plain = GraphicsPipelineDesc::new("p", &vertex);
        for (desc, part) in [
            (GraphicsPipelineDesc { topology: Topology::Patches, ..plain }, "tessellation"),
            (GraphicsPipelineDesc { color_format: Some(Format::Depth32Float), ..plain }, "depth format"),
            (GraphicsPipelineDesc { depth_format: Some(Format::Rgba8Unorm), ..plain }, "depth format"),
            (GraphicsPipelineDesc { depth: Some(DepthState::default()), ..plain }, "depth state"),
            (GraphicsPipelineDesc { samples: 3, ..plain }, "3 samples"),
        ] {
            let error = device.graphics_pipeline(&desc).unwrap_err().to_string();
            assert!(error.contains("\"p\"") && error.contains(part), "{error}");
        }
        let huge = "layout(local_size_x_id = 0) in; void main() {}";
        let huge = shader(device, "huge.comp", huge);
        let desc = ComputePipelineDesc { name: "huge", shader: &huge, specialization: &[(0, 1 << 20)] };
        assert!(matches!(device.compute_pipeline(&desc), Err(GpuError::Limit { .. })));
    });
}

fn simple_pipeline(device: &Device, color: Option<Format>, discard: bool) -> GraphicsPipeline {
    let vertex = shader(device, "v.vert", "void main() { gl_Position = vec4(0.0); }");
    let plain = GraphicsPipelineDesc::new("simple", &vertex);
    let desc = GraphicsPipelineDesc { color_format: color, rasterizer_discard: discard, ..plain };
    device.graphics_pipeline(&desc).unwrap()
}

fn draw(pipeline: &GraphicsPipeline, vertices: Vertices) -> Draw {
    Draw {
        pipeline: pipeline.clone(),
        bindings: Bindings::new(),
        push: vec![],
        vertices,
        instances: 0..1,
        attributes: None,
        scissor: None,
    }
}

#[test]
fn targets_are_checked() {
    with_device(|device| {
        let color = target(device, "color", Format::Rgba8Unorm, 1);
        let other = target(device, "other", Format::Rgba32Float, 1);
        let samples = target(device, "samples", Format::Rgba8Unorm, 4);
        let depth = target(device, "depth", Format::Depth32Float, 1);
        let clear = Some([0.0; 4]);
        let pass = |image: &osculate_gpu::Image| RenderPass {
            name: "draw".to_owned(),
            color: Some(ColorTarget { image: image.clone(), clear, resolve: None }),
            depth: None,
            viewport: [16, 16].into(),
            area: None,
            draws: vec![],
        };
        refused(device, &["\"draw\"", "neither"], |r| r.render(RenderPass { color: None, ..pass(&color) }));
        refused(device, &["beyond a target"], |r| r.render(RenderPass { viewport: [17, 1].into(), ..pass(&color) }));
        refused(device, &["beyond a target"], |r| r.render(RenderPass { viewport: [0, 1].into(), ..pass(&color) }));
        let outside = Rect { origin: [12, 0], size: [5, 16] };
        refused(device, &["viewport", "beyond a target"], |r| {
            r.render(RenderPass { viewport: outside, ..pass(&color) });
        });
        refused(device, &["area", "beyond a target"], |r| r.render(RenderPass { area: Some(outside), ..pass(&color) }));
        refused(device, &["depth image"], |r| r.render(pass(&depth)));
        let depth = |image| Some(DepthTarget { image, clear: Some(1.0) });
        let mixed = target(device, "depth4", Format::Depth32Float, 4);
        refused(device, &["differ in samples"], |r| r.render(RenderPass { depth: depth(mixed), ..pass(&color) }));
        let resolve = |image: &osculate_gpu::Image, resolve: &osculate_gpu::Image| {
            let target = ColorTarget { image: image.clone(), clear, resolve: Some(resolve.clone()) };
            RenderPass { color: Some(target), ..pass(image) }
        };
        refused(device, &["resolve"], |r| r.render(resolve(&color, &color)));
        refused(device, &["resolve"], |r| r.render(resolve(&samples, &other)));
        let kept = ColorTarget { image: color.clone(), clear: None, resolve: None };
        refused(device, &["\"color\"", "nothing was drawn"], |r| {
            r.render(RenderPass { color: Some(kept), ..pass(&color) });
        });
        let pipeline = simple_pipeline(device, Some(Format::Rgba8Unorm), false);
        let draws = vec![draw(&pipeline, (0..3).into())];
        refused(device, &["\"simple\"", "other targets"], |r| r.render(RenderPass { draws, ..pass(&other) }));
        let indices = words(device, "indices", BufferUsage::INDEX);
        let draws = vec![draw(&pipeline, Vertices::Indexed { indices, range: 60..65 })];
        refused(device, &["\"indices\"", "240..260"], |r| r.render(RenderPass { draws, ..pass(&color) }));
    });
}

#[test]
fn captures_are_checked() {
    with_device(|device| {
        let plain = words(device, "plain", BufferUsage::STORAGE);
        let buffer = words(device, "captured", BufferUsage::CAPTURE | BufferUsage::STORAGE);
        let pass = |buffer: &Buffer, draws: Vec<Draw>| CapturePass {
            name: "capture".to_owned(),
            buffer: buffer.clone(),
            offset: 0,
            draws,
        };
        refused(device, &["\"plain\"", "usage"], |r| r.capture(pass(&plain, vec![])));
        refused(device, &["offset"], |r| r.capture(CapturePass { offset: 2, ..pass(&buffer, vec![]) }));
        refused(device, &["offset"], |r| r.capture(CapturePass { offset: 256, ..pass(&buffer, vec![]) }));
        let drawing = simple_pipeline(device, Some(Format::Rgba8Unorm), false);
        refused(device, &["\"simple\"", "other targets"], |r| {
            r.capture(pass(&buffer, vec![draw(&drawing, (0..3).into())]));
        });
        let silent = simple_pipeline(device, None, true);
        refused(device, &["\"simple\"", "nothing to capture"], |r| {
            r.capture(pass(&buffer, vec![draw(&silent, (0..3).into())]));
        });
        let vertex = shader(
            device,
            "echo.vert",
            "layout(binding = 0) readonly buffer Words { float words[]; };
             layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 4) out float result;
             void main() { result = words[gl_VertexIndex]; }",
        );
        let plain = GraphicsPipelineDesc::new("echo", &vertex);
        let echo = device.graphics_pipeline(&GraphicsPipelineDesc { rasterizer_discard: true, ..plain }).unwrap();
        let draws = vec![Draw { bindings: bind(&[&buffer]), ..draw(&echo, (0..3).into()) }];
        refused(device, &["captures into a buffer that its draws use"], |r| r.capture(pass(&buffer, draws)));
    });
}

#[test]
fn attributes_are_checked() {
    with_device(|device| {
        let color = target(device, "color", Format::Rgba8Unorm, 1);
        let vertex = "layout(location = 0) in vec3 p; void main() { gl_Position = vec4(p, 1.0); }";
        let vertex = shader(device, "taking.vert", vertex);
        let desc = GraphicsPipelineDesc::new("taking", &vertex);
        let taking = GraphicsPipelineDesc { color_format: Some(Format::Rgba8Unorm), ..desc };
        let taking = device.graphics_pipeline(&taking).unwrap();
        let plain = simple_pipeline(device, Some(Format::Rgba8Unorm), false);
        let triangle = device.upload("triangle", BufferUsage::VERTEX, &[[0.0f32; 3]; 3]).unwrap();
        let storage = device.upload("storage", BufferUsage::STORAGE, &[[0.0f32; 3]; 3]).unwrap();
        let clear = Some([0.0; 4]);
        let pass =
            |pipeline: &GraphicsPipeline, attributes: Option<&osculate_gpu::Buffer>, vertices: Vertices| RenderPass {
                name: "draw".to_owned(),
                color: Some(ColorTarget { image: color.clone(), clear, resolve: None }),
                depth: None,
                viewport: [16, 16].into(),
                area: None,
                draws: vec![Draw { attributes: attributes.cloned(), ..draw(pipeline, vertices) }],
            };
        refused(device, &["\"taking\"", "12 bytes", "none"], |r| r.render(pass(&taking, None, (0..3).into())));
        refused(device, &["\"simple\"", "no attributes"], |r| r.render(pass(&plain, Some(&triangle), (0..3).into())));
        refused(device, &["\"storage\"", "usage"], |r| r.render(pass(&taking, Some(&storage), (0..3).into())));
        refused(device, &["\"triangle\""], |r| r.render(pass(&taking, Some(&triangle), (1..4).into())));
    });
}
