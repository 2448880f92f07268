//! Capture passes: transform feedback of tessellated patches.

use osculate_gpu::{
    Bindings, BufferDesc, BufferUsage, CapturePass, ComputePass, Device, Draw, GpuError, GraphicsPipeline,
    GraphicsPipelineDesc, Measure, Memory, Recording, Tessellation, Topology,
};

use crate::harness::{bind, compute_pipeline, shader, with_device};

const LEVEL: usize = 4;
/// Two triangles per cell of the grid.
const TRIANGLES: usize = 2 * LEVEL * LEVEL;

/// Patches of four points in the plane z = patch, read from a buffer.
fn pipeline(device: &Device) -> GraphicsPipeline {
    pipeline_at(device, LEVEL)
}

fn pipeline_at(device: &Device, level: usize) -> GraphicsPipeline {
    let vertex = shader(
        device,
        "patch.vert",
        "layout(binding = 0) readonly buffer Points { vec4 points[]; };
         layout(location = 0) out vec3 point;
         void main() { point = points[gl_VertexIndex].xyz; }",
    );
    let control = shader(
        device,
        "patch.tesc",
        "layout(vertices = 4) out;
         layout(constant_id = 0) const float LEVEL = 1.0;
         layout(location = 0) in vec3 point[];
         layout(location = 0) out vec3 corner[];
         void main() {
             corner[gl_InvocationID] = point[gl_InvocationID];
             gl_TessLevelOuter = float[](LEVEL, LEVEL, LEVEL, LEVEL);
             gl_TessLevelInner = float[](LEVEL, LEVEL);
         }",
    );
    let evaluation = shader(
        device,
        "patch.tese",
        "layout(quads, equal_spacing, cw) in;
         layout(location = 0) in vec3 corner[];
         layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 20) out vec3 position;
         layout(location = 1, xfb_buffer = 0, xfb_offset = 12) out vec2 uv;
         void main() {
             uv = gl_TessCoord.xy;
             position = mix(mix(corner[0], corner[1], uv.x), mix(corner[3], corner[2], uv.x), uv.y);
         }",
    );
    let desc = GraphicsPipelineDesc {
        tessellation: Some(Tessellation { control: &control, evaluation: &evaluation, patch_points: 4 }),
        topology: Topology::Patches,
        specialization: &[(0, (level as f32).to_bits())],
        rasterizer_discard: true,
        ..GraphicsPipelineDesc::new("patch", &vertex)
    };
    device.graphics_pipeline(&desc).unwrap()
}

/// The corners of `count` unit squares, one above the other.
fn squares(count: usize) -> Vec<[f32; 4]> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    (0..count).flat_map(|patch| corners.map(|[x, y]| [x, y, patch as f32, 0.0])).collect()
}

fn capture_buffer(device: &Device, size: usize) -> osculate_gpu::Buffer {
    let usage = BufferUsage::CAPTURE | BufferUsage::STORAGE;
    device.buffer(&BufferDesc { name: "captured", size: size as u64, usage, memory: Memory::Device }).unwrap()
}

/// One draw per range of patches: the first, and the one after the last.
fn draws(pipeline: &GraphicsPipeline, bindings: &Bindings, patches: &[[u32; 2]]) -> Vec<Draw> {
    let draw = |&[first, end]: &[u32; 2]| Draw {
        pipeline: pipeline.clone(),
        bindings: bindings.clone(),
        push: vec![],
        vertices: (4 * first..4 * end).into(),
        instances: 0..1,
        attributes: None,
        scissor: None,
    };
    patches.iter().map(draw).collect()
}

#[test]
fn captured_triangles_tile_every_patch() {
    with_device(|device| {
        let pipeline = pipeline(device);
        assert_eq!(pipeline.capture_stride(), Some(20));
        let points = device.upload("points", BufferUsage::STORAGE, &squares(3)).unwrap();
        let captured = capture_buffer(device, 8 + 3 * TRIANGLES * 60);
        let mut recording = Recording::new();
        recording.measure(Measure { statistics: true, timings: false });
        recording.capture(CapturePass {
            name: "capture".to_owned(),
            buffer: captured.clone(),
            offset: 8,
            draws: draws(&pipeline, &bind(&[&points]), &[[0, 1], [1, 3]]),
        });
        let report = device.run(&recording).unwrap();
        assert_eq!(report.captures, [("capture".to_owned(), 3 * TRIANGLES as u64)]);
        if device.info().features.pipeline_statistics {
            assert_eq!(report.statistics[0].1.control_patches, 3);
        }
        let vertices: Vec<[f32; 5]> = device.download(&captured, 8..).unwrap();
        for (patch, vertices) in vertices.chunks(3 * TRIANGLES).enumerate() {
            assert!(vertices.iter().all(|&[x, y, z, u, v]| z == patch as f32 && [x, y] == [u, v]));
            // Twice the signed area of each triangle: all of one sign, and adding up to the square, so that they tile it.
            let areas = vertices.chunks(3).map(|corners| {
                let [a, b, c] = [corners[0], corners[1], corners[2]];
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            });
            let areas: Vec<f32> = areas.collect();
            assert!(areas.iter().all(|&area| area * areas[0] > 0.0));
            assert!((areas.iter().sum::<f32>().abs() - 2.0).abs() < 1e-4, "patch {patch}");
        }
    });
}

/// Captures go on where the pipeline changes, without gaps and in order, whatever each draw adds.
#[test]
fn captures_of_several_pipelines_follow_each_other() {
    with_device(|device| {
        let [coarse, fine] = [1, LEVEL].map(|level| pipeline_at(device, level));
        let points = device.upload("points", BufferUsage::STORAGE, &squares(5)).unwrap();
        let bindings = bind(&[&points]);
        let captured = capture_buffer(device, (3 * 2 + 2 * TRIANGLES) * 60);
        let parts = [(&coarse, [[0, 1], [1, 2]]), (&fine, [[2, 3], [3, 4]]), (&coarse, [[4, 5], [5, 5]])];
        let draws = parts.iter().flat_map(|(pipeline, patches)| draws(pipeline, &bindings, patches)).collect();
        let mut recording = Recording::new();
        recording.capture(CapturePass { name: "capture".to_owned(), buffer: captured.clone(), offset: 0, draws });
        let report = device.run(&recording).unwrap();
        assert_eq!(report.captures, [("capture".to_owned(), 6 + 2 * TRIANGLES as u64)]);
        let vertices: Vec<[f32; 5]> = device.download(&captured, ..).unwrap();
        let patches: Vec<f32> = vertices.chunks(3).map(|triangle| triangle[0][2]).collect();
        let expected = [(0, 2), (1, 2), (2, TRIANGLES), (3, TRIANGLES), (4, 2)];
        let expected: Vec<f32> = expected.iter().flat_map(|&(patch, count)| vec![patch as f32; count]).collect();
        assert_eq!(patches, expected);
    });
}

/// The dependencies of capture: on the pass that makes its input, and of the pass that reads its output.
#[test]
fn capture_is_ordered_against_compute() {
    with_device(|device| {
        let pipeline = pipeline(device);
        let points = device.upload("points", BufferUsage::STORAGE, &squares(1)).unwrap();
        let captured = capture_buffer(device, TRIANGLES * 60);
        let sums = device.upload("sums", BufferUsage::STORAGE, &[0.0f32; 4]).unwrap();
        let raise = compute_pipeline(
            device,
            "raise.comp",
            "layout(local_size_x = 4) in;
             layout(binding = 0) buffer Points { vec4 points[]; };
             void main() { points[gl_GlobalInvocationID.x].z += 2.5; }",
        );
        let sum = compute_pipeline(
            device,
            "sum.comp",
            "layout(binding = 0) readonly buffer Captured { float captured[]; };
             layout(binding = 1) buffer Sums { float sums[]; };
             void main() { for (int i = 2; i < captured.length(); i += 5) sums[0] += captured[i]; }",
        );
        let pass = |pipeline: &osculate_gpu::ComputePipeline, bindings| ComputePass {
            name: pipeline.name().to_owned(),
            pipeline: pipeline.clone(),
            bindings,
            push: vec![],
            groups: [1, 1, 1],
        };
        let mut recording = Recording::new();
        for _ in 0..2 {
            recording.compute(pass(&raise, bind(&[&points])));
            recording.capture(CapturePass {
                name: "capture".to_owned(),
                buffer: captured.clone(),
                offset: 0,
                draws: draws(&pipeline, &bind(&[&points]), &[[0, 1]]),
            });
            recording.compute(pass(&sum, bind(&[&captured, &sums])));
        }
        device.run(&recording).unwrap();
        let vertices = 3.0 * TRIANGLES as f32;
        assert_eq!(device.download::<f32>(&sums, ..4).unwrap(), [(2.5 + 5.0) * vertices]);
    });
}

#[test]
fn a_capture_without_draws_writes_nothing() {
    with_device(|device| {
        let buffer = capture_buffer(device, 4);
        let mut recording = Recording::new();
        recording.capture(CapturePass { name: "nothing".to_owned(), buffer, offset: 0, draws: vec![] });
        assert_eq!(device.run(&recording).unwrap().captures, [("nothing".to_owned(), 0)]);
    });
}

#[test]
fn a_capture_that_does_not_fit_is_an_error() {
    with_device(|device| {
        let pipeline = pipeline(device);
        let points = device.upload("points", BufferUsage::STORAGE, &squares(1)).unwrap();
        let mut recording = Recording::new();
        recording.capture(CapturePass {
            name: "capture".to_owned(),
            buffer: capture_buffer(device, (TRIANGLES - 1) * 60),
            offset: 0,
            draws: draws(&pipeline, &bind(&[&points]), &[[0, 1]]),
        });
        match device.run(&recording).unwrap_err() {
            GpuError::CaptureOverflow { pass, needed, written } => {
                assert_eq!((pass.as_str(), needed, written), ("capture", TRIANGLES as u64, TRIANGLES as u64 - 1));
            }
            error => panic!("{error}"),
        }
    });
}
