//! Render passes: clears, triangles, depth, blending, multisampling, indices, tessellation.

use osculate_gpu::{
    Bindings, Blend, BufferUsage, ColorTarget, DepthState, DepthTarget, Device, Draw, Format, GpuError,
    GraphicsPipeline, GraphicsPipelineDesc, Image, PolygonMode, Recording, Rect, RenderPass, Tessellation, Topology,
    Vertices,
};

use crate::harness::{shader, target, with_device};

/// A triangle that covers the left half of the picture: its long side runs down the middle.
const TRIANGLE: &str = "
layout(push_constant) uniform Push { vec4 color; float depth; };
void main() {
    vec2 corners[3] = vec2[](vec2(0.0, -3.0), vec2(-3.0, 0.0), vec2(0.0, 3.0));
    gl_Position = vec4(corners[gl_VertexIndex], depth, 1.0);
}";

const FLAT: &str = "
layout(push_constant) uniform Push { vec4 color; float depth; };
layout(location = 0) out vec4 result;
void main() { result = color; }";

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 0.5];

fn push(color: [f32; 4], depth: f32) -> Vec<u8> {
    color.into_iter().chain([depth]).flat_map(f32::to_ne_bytes).collect()
}

fn draw(pipeline: &GraphicsPipeline, color: [f32; 4], depth: f32) -> Draw {
    Draw {
        pipeline: pipeline.clone(),
        bindings: Bindings::new(),
        push: push(color, depth),
        vertices: (0..3).into(),
        instances: 0..1,
        attributes: None,
        scissor: None,
    }
}

/// A pipeline for the triangle, completed by `change`.
fn pipeline(device: &Device, change: impl Fn(&mut GraphicsPipelineDesc<'_>)) -> GraphicsPipeline {
    let vertex = shader(device, "triangle.vert", TRIANGLE);
    let fragment = shader(device, "flat.frag", FLAT);
    let mut desc = GraphicsPipelineDesc::new("triangle", &vertex);
    desc.fragment = Some(&fragment);
    desc.color_format = Some(Format::Rgba8Unorm);
    change(&mut desc);
    device.graphics_pipeline(&desc).unwrap()
}

fn pass(color: ColorTarget, depth: Option<DepthTarget>, draws: Vec<Draw>) -> RenderPass {
    RenderPass { name: "picture".to_owned(), color: Some(color), depth, viewport: [16, 16].into(), area: None, draws }
}

/// Renders one pass and reads the texels at (4, 8) and (12, 8) of `result`.
fn texels(device: &Device, pass: RenderPass, result: &Image) -> [[u8; 4]; 2] {
    let mut recording = Recording::new();
    recording.render(pass);
    device.run(&recording).unwrap();
    read_texels(device, result)
}

fn read_texels(device: &Device, result: &Image) -> [[u8; 4]; 2] {
    let buffer = device.upload("texels", BufferUsage::empty(), &vec![0u8; result.byte_size() as usize]).unwrap();
    let mut recording = Recording::new();
    recording.copy_image_to_buffer(result, &buffer);
    device.run(&recording).unwrap();
    let texels: Vec<[u8; 4]> = device.download(&buffer, ..).unwrap();
    [texels[8 * 16 + 4], texels[8 * 16 + 12]]
}

fn cleared(image: &Image, resolve: Option<&Image>) -> ColorTarget {
    ColorTarget { image: image.clone(), clear: Some([0.0, 0.0, 1.0, 1.0]), resolve: resolve.cloned() }
}

#[test]
fn a_triangle_covers_its_half() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |_| {});
        let pass = pass(cleared(&image, None), None, vec![draw(&pipeline, RED, 0.0)]);
        assert_eq!(texels(device, pass, &image), [[255, 0, 0, 255], [0, 0, 255, 255]]);
    });
}

#[test]
fn a_picture_is_kept_and_drawn_upon_in_later_passes_and_submissions() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |_| {});
        let blank = texels(device, pass(cleared(&image, None), None, vec![]), &image);
        assert_eq!(blank, [[0, 0, 255, 255]; 2]);
        let kept = ColorTarget { image: image.clone(), clear: None, resolve: None };
        let found = texels(device, pass(kept, None, vec![draw(&pipeline, RED, 0.0)]), &image);
        assert_eq!(found, [[255, 0, 0, 255], [0, 0, 255, 255]]);
    });
}

/// All texels of the picture as characters, row by row: what is red, green, blue (cleared) or black (left as it was).
fn drawing(device: &Device, passes: impl IntoIterator<Item = RenderPass>, result: &Image) -> Vec<String> {
    let buffer = device.upload("texels", BufferUsage::empty(), &vec![0u8; result.byte_size() as usize]).unwrap();
    let mut recording = Recording::new();
    passes.into_iter().for_each(|pass| recording.render(pass));
    recording.copy_image_to_buffer(result, &buffer);
    device.run(&recording).unwrap();
    let letter = |texel: &[u8; 4]| match texel {
        [255, 0, 0, _] => 'r',
        [0, 255, 0, _] => 'g',
        [0, 0, 255, _] => 'b',
        [0, 0, 0, 0] => '.',
        other => panic!("{other:?}"),
    };
    let texels: Vec<[u8; 4]> = device.download(&buffer, ..).unwrap();
    texels.chunks(16).map(|row| row.iter().map(letter).collect()).collect()
}

fn rect(x: u32, y: u32, width: u32, height: u32) -> Rect {
    Rect { origin: [x, y], size: [width, height] }
}

/// A pass that makes all texels black, with nothing in alpha.
fn blank(image: &Image) -> RenderPass {
    pass(ColorTarget { image: image.clone(), clear: Some([0.0; 4]), resolve: None }, None, vec![])
}

#[test]
fn scissors_cut_single_draws() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |_| {});
        let solid_green = [0.0, 1.0, 0.0, 1.0];
        let cut = |color, scissor| Draw { scissor: Some(scissor), ..draw(&pipeline, color, 0.0) };
        // The second draw reaches beyond the picture, the third has no texels, the fourth is not cut: it covers columns 0 to 7.
        let draws = vec![cut(RED, rect(2, 1, 3, 2)), cut(solid_green, rect(6, 14, 90, 90)), cut(RED, rect(3, 3, 0, 9))];
        let rows = drawing(device, [pass(cleared(&image, None), None, draws.clone())], &image);
        let background = "b".repeat(16);
        let expected = |y| match y {
            1 | 2 => "bbrrrbbbbbbbbbbb",
            14 | 15 => "bbbbbbggbbbbbbbb",
            _ => background.as_str(),
        };
        assert_eq!(rows, (0..16).map(expected).collect::<Vec<_>>());
        let whole = [draws, vec![draw(&pipeline, RED, 0.0)]].concat();
        let rows = drawing(device, [pass(cleared(&image, None), None, whole)], &image);
        assert_eq!(rows, vec!["rrrrrrrrbbbbbbbb"; 16]);
    });
}

#[test]
fn passes_draw_side_by_side_in_their_viewports() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |_| {});
        let side =
            |viewport| RenderPass { viewport, ..pass(cleared(&image, None), None, vec![draw(&pipeline, RED, 0.0)]) };
        let passes = [blank(&image), side(rect(0, 0, 8, 6)), side(rect(10, 2, 6, 10))];
        let rows = drawing(device, passes, &image);
        let row = |y| match y {
            0..2 => "rrrrbbbb........",
            2..6 => "rrrrbbbb..rrrbbb",
            6..12 => "..........rrrbbb",
            _ => "................",
        };
        assert_eq!(rows, (0..16).map(row).collect::<Vec<_>>());
    });
}

/// Two pictures of one viewport, either side of a line: a wipe. With several samples the resolve keeps to the area, too.
#[test]
fn areas_cut_pictures_without_moving_them() {
    with_device(|device| {
        for samples in [1, 4] {
            let result = target(device, "picture", Format::Rgba8Unorm, 1);
            let drawn =
                if samples > 1 { target(device, "samples", Format::Rgba8Unorm, samples) } else { result.clone() };
            let resolve = (samples > 1).then_some(&result);
            let pipeline = pipeline(device, |desc| desc.samples = samples);
            let solid_green = [0.0, 1.0, 0.0, 1.0];
            let part = |area, color| RenderPass {
                area: Some(area),
                ..pass(cleared(&drawn, resolve), None, vec![draw(&pipeline, color, 0.0)])
            };
            let passes = [blank(&result), part(rect(0, 0, 5, 16), RED), part(rect(5, 4, 11, 12), solid_green)];
            let rows = drawing(device, passes, &result);
            let row = |y| if y < 4 { "rrrrr..........." } else { "rrrrrgggbbbbbbbb" };
            assert_eq!(rows, (0..16).map(row).collect::<Vec<_>>(), "{samples} samples");
        }
    });
}

#[test]
fn srgb_targets_encode() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Srgb, 1);
        let pipeline = pipeline(device, |desc| desc.color_format = Some(Format::Rgba8Srgb));
        let half = draw(&pipeline, [0.5, 0.5, 0.5, 0.5], 0.0);
        let [left, _] = texels(device, pass(cleared(&image, None), None, vec![half]), &image);
        // 188 by the definition; drivers may approximate it.
        assert!(left[..3].iter().all(|value| value.abs_diff(188) <= 1) && left[3] == 128, "{left:?}");
    });
}

#[test]
fn nearer_depths_win_in_any_order() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let depth = target(device, "depth", Format::Depth32Float, 1);
        let pipeline = pipeline(device, |desc| {
            desc.depth = Some(DepthState::default());
            desc.depth_format = Some(Format::Depth32Float);
        });
        for order in [[RED, GREEN], [GREEN, RED]] {
            let draws = order.map(|color| draw(&pipeline, color, if color == RED { 0.25 } else { 0.75 }));
            let depth = DepthTarget { image: depth.clone(), clear: Some(1.0) };
            let [left, _] = texels(device, pass(cleared(&image, None), Some(depth), draws.to_vec()), &image);
            assert_eq!(left, [255, 0, 0, 255]);
        }
        let depths = device.upload("depths", BufferUsage::empty(), &[0.0f32; 256]).unwrap();
        let mut recording = Recording::new();
        recording.copy_image_to_buffer(&depth, &depths);
        device.run(&recording).unwrap();
        let depths = device.download::<f32>(&depths, ..).unwrap();
        assert_eq!((depths[8 * 16 + 4], depths[8 * 16 + 12]), (0.25, 1.0));
    });
}

#[test]
fn alpha_is_blended() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |desc| desc.blend = Blend::Alpha);
        let [left, right] =
            texels(device, pass(cleared(&image, None), None, vec![draw(&pipeline, GREEN, 0.0)]), &image);
        assert!(left[1].abs_diff(128) <= 1 && left[2].abs_diff(128) <= 1, "{left:?}");
        assert_eq!(right, [0, 0, 255, 255]);
        let premultiplied = self::pipeline(device, |desc| desc.blend = Blend::Premultiplied);
        let [left, _] =
            texels(device, pass(cleared(&image, None), None, vec![draw(&premultiplied, GREEN, 0.0)]), &image);
        assert!(left[1] == 255 && left[2].abs_diff(128) <= 1 && left[3] == 255, "{left:?}");
    });
}

#[test]
fn samples_are_resolved() {
    with_device(|device| {
        let samples = target(device, "samples", Format::Rgba8Unorm, 4);
        let depth = target(device, "depth", Format::Depth32Float, 4);
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |desc| {
            desc.samples = 4;
            desc.depth = Some(DepthState::default());
            desc.depth_format = Some(Format::Depth32Float);
        });
        let depth = DepthTarget { image: depth, clear: Some(1.0) };
        let mut pass = pass(cleared(&samples, Some(&image)), Some(depth), vec![draw(&pipeline, RED, 0.5)]);
        assert_eq!(texels(device, pass.clone(), &image), [[255, 0, 0, 255], [0, 0, 255, 255]]);
        // The samples are kept as well: a second pass adds to them.
        let color = pass.color.as_mut().unwrap();
        color.clear = None;
        pass.draws = vec![draw(&pipeline, GREEN, 0.25)];
        assert_eq!(texels(device, pass, &image)[1], [0, 0, 255, 255]);
    });
}

#[test]
fn indices_choose_vertices() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let vertex = shader(
            device,
            "points.vert",
            "layout(binding = 4) readonly buffer Points { vec2 points[]; };
             void main() { gl_Position = vec4(points[gl_VertexIndex] + vec2(gl_InstanceIndex), 0.0, 1.0); }",
        );
        let fragment =
            shader(device, "red.frag", "layout(location = 0) out vec4 c; void main() { c = vec4(1, 0, 0, 1); }");
        let desc = GraphicsPipelineDesc { fragment: Some(&fragment), ..GraphicsPipelineDesc::new("indexed", &vertex) };
        let desc = GraphicsPipelineDesc { color_format: Some(Format::Rgba8Unorm), ..desc };
        let pipeline = device.graphics_pipeline(&desc).unwrap();
        let points: [[f32; 2]; 5] = [[9.0, 9.0], [-1.0, -3.0], [-4.0, -1.0], [-1.0, 1.0], [9.0, 9.0]];
        let points = device.upload("points", BufferUsage::STORAGE, &points).unwrap();
        let indices = device.upload("indices", BufferUsage::INDEX, &[0u32, 0, 1, 2, 3]).unwrap();
        let draw = Draw {
            pipeline,
            bindings: Bindings::new().with(4, &points),
            push: vec![],
            vertices: Vertices::Indexed { indices, range: 2..5 },
            // The instance moves it into the picture's left half.
            instances: 1..2,
            attributes: None,
            scissor: None,
        };
        assert_eq!(texels(device, pass(cleared(&image, None), None, vec![draw]), &image)[0], [255, 0, 0, 255]);
    });
}

#[test]
fn a_tessellated_quad_fills_its_square_solid_and_as_wires() {
    with_device(|device| {
        let vertex = shader(
            device,
            "quad.vert",
            "void main() {
                 gl_Position = vec4((gl_VertexIndex & 1) * 0.98 - 0.99, (gl_VertexIndex >> 1) * 1.98 - 0.99, 0.0, 1.0);
             }",
        );
        let control = shader(
            device,
            "quad.tesc",
            "layout(vertices = 4) out;
             void main() {
                 gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
                 gl_TessLevelOuter = float[](1.0, 1.0, 1.0, 1.0);
                 gl_TessLevelInner = float[](1.0, 1.0);
             }",
        );
        let evaluation = shader(
            device,
            "quad.tese",
            "layout(quads, equal_spacing, cw) in;
             void main() {
                 vec4 low = mix(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_TessCoord.x);
                 vec4 high = mix(gl_in[2].gl_Position, gl_in[3].gl_Position, gl_TessCoord.x);
                 gl_Position = mix(low, high, gl_TessCoord.y);
             }",
        );
        let fragment =
            shader(device, "red.frag", "layout(location = 0) out vec4 c; void main() { c = vec4(1, 0, 0, 1); }");
        let render = |polygon_mode: PolygonMode, name: &str| {
            let desc = GraphicsPipelineDesc {
                tessellation: Some(Tessellation { control: &control, evaluation: &evaluation, patch_points: 4 }),
                fragment: Some(&fragment),
                topology: Topology::Patches,
                polygon_mode,
                color_format: Some(Format::Rgba8Unorm),
                ..GraphicsPipelineDesc::new(name, &vertex)
            };
            let pipeline = device.graphics_pipeline(&desc)?;
            let bindings = Bindings::new();
            let draw = Draw {
                pipeline,
                bindings,
                push: vec![],
                vertices: (0..4).into(),
                attributes: None,
                instances: 0..1,
                scissor: None,
            };
            let image = target(device, name, Format::Rgba8Unorm, 1);
            Ok::<_, GpuError>(texels(device, pass(cleared(&image, None), None, vec![draw]), &image))
        };
        let (red, blue) = ([255, 0, 0, 255], [0, 0, 255, 255]);
        assert_eq!(render(PolygonMode::Fill, "solid").unwrap(), [red, blue]);
        let wires = render(PolygonMode::Line, "wires");
        if device.info().features.wireframe {
            // The texel at (4, 8) is on neither a side nor the diagonal.
            assert_eq!(wires.unwrap(), [blue, blue]);
        } else {
            assert!(matches!(wires, Err(GpuError::MissingFeature { .. })));
        }
    });
}

#[test]
fn attributes_are_read_in_order_of_their_locations() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let vertex = shader(
            device,
            "attributes.vert",
            "layout(location = 5) in uint red; layout(location = 0) in vec2 corner; layout(location = 1) in ivec2 shift;
             layout(location = 0) out flat uint color;
             void main() { gl_Position = vec4(corner + vec2(shift), 0.0, 1.0); color = red; }",
        );
        let fragment = shader(
            device,
            "attributes.frag",
            "layout(location = 0) in flat uint color; layout(location = 0) out vec4 c;
             void main() { c = vec4(float(color) / 255.0, 0, 0, 1); }",
        );
        let desc =
            GraphicsPipelineDesc { fragment: Some(&fragment), ..GraphicsPipelineDesc::new("attributes", &vertex) };
        let desc = GraphicsPipelineDesc { color_format: Some(Format::Rgba8Unorm), ..desc };
        let pipeline = device.graphics_pipeline(&desc).unwrap();
        // Corner, shift and colour of three vertices that cover the left half, and one that is not drawn.
        let vertex = |corner: [f32; 2], shift: [i32; 2]| {
            [corner[0].to_bits(), corner[1].to_bits(), shift[0] as u32, shift[1] as u32, 200]
        };
        let vertices = [
            vertex([9.0; 2], [0; 2]),
            vertex([1.0, -2.0], [-1; 2]),
            vertex([-2.0, 1.0], [-1; 2]),
            vertex([0.0, 3.0], [0; 2]),
        ];
        let usage = BufferUsage::VERTEX | BufferUsage::STORAGE;
        let attributes = device.upload("vertices", usage, &[[0u32; 5]; 4]).unwrap();
        // Written by a pass before, so that a barrier must stand between.
        let source = device.upload("source", BufferUsage::empty(), &vertices).unwrap();
        let indices = device.upload("indices", BufferUsage::INDEX, &[1u32, 2, 3]).unwrap();
        let indexed = Vertices::Indexed { indices, range: 0..3 };
        for vertices in [indexed, (1..4).into()] {
            let draw = Draw {
                pipeline: pipeline.clone(),
                bindings: Bindings::new(),
                push: vec![],
                vertices,
                attributes: Some(attributes.clone()),
                instances: 0..1,
                scissor: None,
            };
            let mut recording = Recording::new();
            recording.copy_buffer(&source, 0..source.size(), &attributes, 0);
            recording.render(pass(cleared(&image, None), None, vec![draw]));
            device.run(&recording).unwrap();
            assert_eq!(read_texels(device, &image), [[200, 0, 0, 255], [0, 0, 255, 255]]);
        }
    });
}

/// Draws that follow each other may have the same push constants, which are set once, or others.
#[test]
fn draws_have_the_push_constants_that_they_were_given() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let pipeline = pipeline(device, |_| {});
        let row = |y, color| {
            let scissor = Some(Rect { origin: [0, y], size: [16, 4] });
            Draw { scissor, ..draw(&pipeline, color, 0.0) }
        };
        let draws = vec![row(0, RED), row(4, RED), row(8, [0.0, 1.0, 0.0, 1.0]), row(12, RED)];
        let found = drawing(device, [pass(cleared(&image, None), None, draws)], &image);
        let colors: Vec<char> = [1, 5, 9, 13].iter().map(|&y: &usize| found[y].chars().nth(2).unwrap()).collect();
        assert_eq!(colors, ['r', 'r', 'g', 'r']);
    });
}
