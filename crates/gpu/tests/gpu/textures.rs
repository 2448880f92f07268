//! Sampled images: uploads, filters, levels, formats; storage images.

use bytemuck::Pod;
use osculate_gpu::{
    Bindings, Buffer, BufferUsage, ColorTarget, ComputePipeline, DepthTarget, Device, Draw, Filter, Format,
    GraphicsPipelineDesc, Image, ImageDesc, ImageRegion, ImageUsage, Recording, Rect, RenderPass, Sampler, SamplerDesc,
    Wrap,
};

use crate::harness::{compute_pass, compute_pipeline, shader, target, with_device};

/// Looks up `sampled` at four points of level `w` that the host gives.
const LOOK_UP: &str = "
layout(local_size_x = 4) in;
layout(binding = 0) uniform sampler2D sampled;
layout(binding = 1) readonly buffer Points { vec4 points[]; };
layout(binding = 2) writeonly buffer Found { vec4 found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    found[i] = textureLod(sampled, points[i].xy, points[i].w);
}";

const SAMPLED: ImageUsage = ImageUsage::SAMPLED;

fn nearest(device: &Device) -> Sampler {
    let filter = Filter::Nearest;
    let desc = SamplerDesc {
        name: "nearest",
        magnify: filter,
        minify: filter,
        levels: Some(filter),
        ..SamplerDesc::default()
    };
    device.sampler(&desc).unwrap()
}

fn desc(name: &str, size: [u32; 2], format: Format) -> ImageDesc<'_> {
    ImageDesc { name, size, format, usage: SAMPLED, ..ImageDesc::default() }
}

/// What the look-up finds at points `(u, v)` of a level.
fn look_up(device: &Device, image: &Image, sampler: &Sampler, level: f32, points: [[f32; 2]; 4]) -> [[f32; 4]; 4] {
    let pipeline = compute_pipeline(device, "look_up.comp", LOOK_UP);
    let points = points.map(|[u, v]| [u, v, 0.0, level]);
    let points = device.upload("points", BufferUsage::STORAGE, &points).unwrap();
    let found = device.upload("found", BufferUsage::STORAGE, &[[9.0f32; 4]; 4]).unwrap();
    let bindings = Bindings::new().with_texture(0, image, sampler).with(1, &points).with(2, &found);
    let mut recording = Recording::new();
    recording.compute(compute_pass(&pipeline, bindings, 4));
    device.run(&recording).unwrap();
    device.download::<[f32; 4]>(&found, ..).unwrap().try_into().unwrap()
}

/// The centres of the texels of a 2 x 2 image, row by row.
const CENTRES: [[f32; 2]; 4] = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];

/// Uploads four texels, looks each of them up, and expects them up to the rounding of normalized numbers.
fn round_trip<T: Pod>(device: &Device, format: Format, texels: &[T], expected: [[f32; 4]; 4]) {
    let image = device.upload_image(&desc("texels", [2, 2], format), texels).unwrap();
    let found = look_up(device, &image, &nearest(device), 0.0, CENTRES);
    let pairs = || found.as_flattened().iter().zip(expected.as_flattened());
    assert!(pairs().all(|(a, b)| (a - b).abs() < 1e-6), "{format:?}: {found:?}, not {expected:?}");
}

#[test]
fn texels_of_every_format_are_found_where_they_were_put() {
    with_device(|device| {
        let bytes: [[u8; 4]; 4] = [[255, 0, 0, 255], [0, 255, 0, 0], [0, 0, 51, 255], [255, 255, 255, 255]];
        let colors = bytes.map(|texel| texel.map(|byte| f32::from(byte) / 255.0));
        round_trip(device, Format::Rgba8Unorm, &bytes, colors);
        round_trip(device, Format::Bgra8Unorm, &bytes.map(|[r, g, b, a]| [b, g, r, a]), colors);
        let floats: [[f32; 4]; 4] = [[0.5, -2.0, 1e6, 1.0], [0.0; 4], [1.0; 4], [-0.25; 4]];
        round_trip(device, Format::Rgba32Float, &floats, floats);
        let red = |values: [f32; 4]| values.map(|value| [value, 0.0, 0.0, 1.0]);
        round_trip(device, Format::R32Float, &[0.5f32, -2.0, 1e6, 3.0], red([0.5, -2.0, 1e6, 3.0]));
        round_trip(device, Format::R8Unorm, &[0u8, 51, 255, 102], red([0.0, 0.2, 1.0, 0.4]));
        round_trip(device, Format::R16Unorm, &[0u16, 13107, 65535, 26214], red([0.0, 0.2, 1.0, 0.4]));
        // 1, -2, 0.5 and the largest half float.
        round_trip(device, Format::R16Float, &[0x3c00u16, 0xc000, 0x3800, 0x7bff], red([1.0, -2.0, 0.5, 65504.0]));
        round_trip(device, Format::Rgba16Float, &[[0x3c00u16, 0xc000, 0x3800, 0]; 4], [[1.0, -2.0, 0.5, 0.0]; 4]);
    });
}

#[test]
fn srgb_is_decoded_but_for_alpha() {
    with_device(|device| {
        let texels = [[188u8, 0, 255, 128]; 4];
        for (format, order) in [(Format::Rgba8Srgb, [0, 1, 2]), (Format::Bgra8Srgb, [2, 1, 0])] {
            let image = device.upload_image(&desc("texels", [2, 2], format), &texels).unwrap();
            let found = look_up(device, &image, &nearest(device), 0.0, CENTRES)[0];
            let colors = order.map(|channel| found[channel]);
            assert!((colors[0] - 0.5).abs() < 0.01 && colors[1] == 0.0 && (colors[2] - 1.0).abs() < 1e-6, "{found:?}");
            assert!((found[3] - 128.0 / 255.0).abs() < 1e-6, "{found:?}");
        }
    });
}

#[test]
fn samplers_filter_and_wrap_as_told() {
    with_device(|device| {
        let image = device.upload_image(&desc("ramp", [2, 1], Format::R8Unorm), &[0u8, 255]).unwrap();
        let at = |sampler: &Sampler| {
            let points = [[0.5, 0.5], [-0.2, 0.5], [1.0, 0.5], [1.3, 0.5]];
            look_up(device, &image, sampler, 0.0, points).map(|texel| texel[0])
        };
        let make = |wrap: Wrap| device.sampler(&SamplerDesc { wrap: [wrap; 2], ..SamplerDesc::default() }).unwrap();
        let near = |found: [f32; 4], wanted: [f32; 4]| {
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.01), "{found:?}, not {wanted:?}");
        };
        near(at(&make(Wrap::Clamp)), [0.5, 0.0, 1.0, 1.0]);
        // The texel centres lie at 0.25 and 0.75; a unit step of u is two texels.
        near(at(&make(Wrap::Repeat)), [0.5, 0.9, 0.5, 0.1]);
        near(at(&make(Wrap::Mirror)), [0.5, 0.0, 1.0, 0.9]);
        assert_eq!(at(&nearest(device))[1..], [0.0, 1.0, 1.0]);
        let mixed = SamplerDesc { wrap: [Wrap::Repeat, Wrap::Clamp], ..SamplerDesc::default() };
        near(at(&device.sampler(&mixed).unwrap()), [0.5, 0.9, 0.5, 0.1]);
    });
}

#[test]
fn levels_are_means_of_the_ones_before() {
    with_device(|device| {
        // 8 x 4: a column of texels has its number, so that each level is linear again.
        let texels: Vec<f32> = (0..32).map(|i| (i % 8) as f32).collect();
        let full = Image::full_levels([8, 4]);
        let desc = ImageDesc { levels: full, ..desc("columns", [8, 4], Format::R32Float) };
        let image = device.upload_image(&desc, &texels).unwrap();
        assert_eq!((full, image.level_size(2), image.level_size(3)), (4, [2, 1], [1, 1]));
        let middle = |level: f32| look_up(device, &image, &nearest(device), level, [[0.01, 0.5]; 4])[0][0];
        assert_eq!([0.0, 1.0, 2.0, 3.0].map(middle), [0.0, 0.5, 1.5, 3.5]);
        let linear = device.sampler(&SamplerDesc::default()).unwrap();
        let between = look_up(device, &image, &linear, 2.5, [[0.0, 0.5]; 4])[0][0];
        assert!((between - 2.5).abs() < 0.01, "{between}");
        let first = device.sampler(&SamplerDesc { levels: None, ..SamplerDesc::default() }).unwrap();
        assert_eq!(look_up(device, &image, &first, 3.0, [[0.0, 0.5]; 4])[0][0], 0.0);
    });
}

/// Reads texels through a buffer.
fn read_region<T: Pod>(device: &Device, region: ImageRegion) -> Vec<T> {
    let texels = device.upload("texels", BufferUsage::empty(), &vec![0u8; region.byte_size() as usize + 8]).unwrap();
    let mut recording = Recording::new();
    recording.copy_region_to_buffer(region.clone(), &texels, 8);
    device.run(&recording).unwrap();
    device.download(&texels, 8..8 + region.byte_size()).unwrap()
}

#[test]
fn texels_of_any_level_are_written_and_read_alone() {
    with_device(|device| {
        let usage = SAMPLED | ImageUsage::COPY_SRC | ImageUsage::COPY_DST;
        let desc = ImageDesc { levels: 2, usage, ..desc("sheet", [4, 4], Format::R32Uint) };
        let image = device.upload_image(&desc, &(0..16).collect::<Vec<u32>>());
        let image = match image {
            // Integers have no means, so that levels must be copied.
            Err(error) => {
                assert!(error.to_string().contains("cannot average texels of R32Uint"), "{error}");
                device.image(&desc).unwrap()
            }
            Ok(_) => panic!("integers were averaged"),
        };
        device.write_image(image.level(0), &(0..16).collect::<Vec<u32>>()).unwrap();
        device.write_image(image.level(1), &[100u32, 101, 102, 103]).unwrap();
        let rect = Rect { origin: [1, 2], size: [2, 1] };
        device.write_image(image.region(0, rect), &[50u32, 51]).unwrap();
        assert_eq!(read_region::<u32>(device, image.level(0)), [0, 1, 2, 3, 4, 5, 6, 7, 8, 50, 51, 11, 12, 13, 14, 15]);
        assert_eq!(read_region::<u32>(device, image.level(1)), [100, 101, 102, 103]);
        assert_eq!(read_region::<u32>(device, image.region(0, Rect { origin: [3, 1], size: [1, 2] })), [7, 11]);
    });
}

/// A fragment shader looks a picture up that an earlier pass of the same recording has drawn, depths among them.
#[test]
fn what_one_pass_draws_the_next_one_samples() {
    with_device(|device| {
        let usage = ImageUsage::TARGET | SAMPLED;
        let size = [16, 16];
        let make = |name, format| device.image(&ImageDesc { usage, ..desc(name, size, format) }).unwrap();
        let (color, depth) = (make("color", Format::Rgba8Unorm), make("depth", Format::Depth32Float));
        let result = target(device, "result", Format::Rgba8Unorm, 1);
        let vertex = shader(
            device,
            "cover.vert",
            "void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1); }",
        );
        let fragment = shader(
            device,
            "both.frag",
            "layout(binding = 3) uniform sampler2D color;
             layout(binding = 1) uniform sampler2D depth;
             layout(location = 0) out vec4 c;
             void main() {
                 vec2 uv = gl_FragCoord.xy / vec2(textureSize(color, 0));
                 c = vec4(texture(color, uv).rg, texture(depth, uv).r, 1.0);
             }",
        );
        let plain = GraphicsPipelineDesc::new("both", &vertex);
        let plain = GraphicsPipelineDesc { fragment: Some(&fragment), color_format: Some(Format::Rgba8Unorm), ..plain };
        let pipeline = device.graphics_pipeline(&plain).unwrap();
        let sampler = nearest(device);
        let bindings = Bindings::new().with_texture(3, &color, &sampler).with_texture(1, &depth, &sampler);
        let draw = Draw {
            pipeline,
            bindings,
            push: vec![],
            vertices: (0..3).into(),
            attributes: None,
            instances: 0..1,
            scissor: None,
        };
        let pass = |image: &Image, clear, depth, draws| RenderPass {
            name: "pass".to_owned(),
            color: Some(ColorTarget { image: image.clone(), clear: Some(clear), resolve: None }),
            depth,
            viewport: size.into(),
            area: None,
            draws,
        };
        for (red, near) in [(1.0, 0.2), (0.2, 1.0)] {
            let mut recording = Recording::new();
            let depth = Some(DepthTarget { image: depth.clone(), clear: Some(near) });
            recording.render(pass(&color, [red, 0.4, 0.0, 1.0], depth, vec![]));
            // Two draws look the same image up.
            recording.render(pass(&result, [0.0; 4], None, vec![draw.clone(), draw.clone()]));
            device.run(&recording).unwrap();
            let texel = [red, 0.4, near, 1.0].map(|value: f32| (value * 255.0).round() as u8);
            assert_eq!(read_region::<[u8; 4]>(device, result.level(0)), [texel; 256]);
        }
    });
}

/// Steps of an image pass: each texel becomes the sum of its neighbours to the left and right, from one image to the other.
#[test]
fn storage_images_are_read_and_written_in_turn() {
    const SUM: &str = "
    layout(local_size_x = 8) in;
    layout(binding = 0, FORMAT) uniform readonly image2D before;
    layout(binding = 1, FORMAT) uniform writeonly image2D after;
    void main() {
        ivec2 at = ivec2(gl_GlobalInvocationID.xy);
        imageStore(after, at, imageLoad(before, at - ivec2(1, 0)) + imageLoad(before, at + ivec2(1, 0)));
    }";
    with_device(|device| {
        let run = |name: &str, format: Format, pipeline: &ComputePipeline, texels: &Buffer| {
            let usage = ImageUsage::STORAGE | ImageUsage::COPY_DST | ImageUsage::COPY_SRC | SAMPLED;
            let images = ["a", "b"].map(|one| {
                let name = format!("{name} {one}");
                device.image(&ImageDesc { usage, ..desc(&name, [8, 1], format) }).unwrap()
            });
            let mut recording = Recording::new();
            recording.copy_buffer_to_image(texels, 0, images[0].level(0));
            for step in 0..4 {
                let (from, to) = (&images[step % 2], &images[(step + 1) % 2]);
                let bindings = Bindings::new().with_storage_image(0, from).with_storage_image(1, to);
                recording.compute(compute_pass(pipeline, bindings, 8));
            }
            device.run(&recording).unwrap();
            let found =
                look_up(device, &images[0], &nearest(device), 0.0, [1, 3, 4, 5].map(|x| [(x as f32 + 0.5) / 8.0, 0.5]));
            found.map(|texel| texel[0])
        };
        // A single one in the fourth texel spreads as the binomials 1 4 6 4 1, two texels apart; the left end meets the border.
        let expected = [4.0, 6.0, 0.0, 4.0];
        for (name, format, one) in [
            ("rgba32f", Format::Rgba32Float, bytemuck::bytes_of(&[1.0f32, 0.0, 0.0, 0.0]).to_vec()),
            ("rgba16f", Format::Rgba16Float, bytemuck::bytes_of(&[0x3c00u16, 0, 0, 0]).to_vec()),
            ("r32f", Format::R32Float, bytemuck::bytes_of(&1.0f32).to_vec()),
        ] {
            let pipeline = compute_pipeline(device, "sum.comp", &SUM.replace("FORMAT", name));
            let mut bytes = vec![0u8; 8 * one.len()];
            bytes[3 * one.len()..4 * one.len()].copy_from_slice(&one);
            let texels = device.upload("texels", BufferUsage::empty(), &bytes).unwrap();
            let found = run(name, format, &pipeline, &texels);
            assert_eq!(found, expected, "{name}");
        }
    });
}
