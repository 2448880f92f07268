//! Compute passes: arithmetic, barriers, push constants, specialization, ranges, copies.

use osculate_gpu::{Bindings, BufferDesc, BufferUsage, ComputePass, ComputePipelineDesc, Memory, Recording};

use crate::harness::{bind, compute_pass, compute_pipeline, shader, with_device};

const ADD: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer A { float a[]; };
layout(binding = 1) readonly buffer B { float b[]; };
layout(binding = 2) writeonly buffer Sum { float sum[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < sum.length()) sum[i] = a[i] + b[i];
}";

const DOUBLE: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) buffer Values { float values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < values.length()) values[i] *= 2.0;
}";

#[test]
fn two_buffers_are_added() {
    with_device(|device| {
        let count = 1000;
        let a: Vec<f32> = (0..count).map(|i| i as f32).collect();
        let b: Vec<f32> = (0..count).map(|i| 0.5 * i as f32).collect();
        let a = device.upload("a", BufferUsage::STORAGE, &a).unwrap();
        let b = device.upload("b", BufferUsage::STORAGE, &b).unwrap();
        let sum = device.upload("sum", BufferUsage::STORAGE, &vec![0.0f32; count]).unwrap();
        let pipeline = compute_pipeline(device, "add.comp", ADD);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&pipeline, bind(&[&a, &b, &sum]), count as u32));
        device.run(&recording).unwrap();
        let expected: Vec<f32> = (0..count).map(|i| 1.5 * i as f32).collect();
        assert_eq!(device.download::<f32>(&sum, ..).unwrap(), expected);
    });
}

/// Synchronization validation would report every missing barrier: write after read, read after write, write after write.
#[test]
fn passes_see_what_earlier_ones_wrote() {
    with_device(|device| {
        let count = 100_000;
        let x = device.upload("x", BufferUsage::STORAGE, &vec![1.0f32; count]).unwrap();
        let y = device.upload("y", BufferUsage::STORAGE, &vec![0.0f32; count]).unwrap();
        let double = compute_pipeline(device, "double.comp", DOUBLE);
        let add = compute_pipeline(device, "add.comp", ADD);
        let readback = device
            .buffer(&BufferDesc {
                name: "result",
                size: y.size(),
                usage: BufferUsage::empty(),
                memory: Memory::Readback,
            })
            .unwrap();
        let mut recording = Recording::new();
        for _ in 0..5 {
            recording.compute(compute_pass(&double, bind(&[&x]), count as u32));
            recording.compute(compute_pass(&add, bind(&[&x, &x, &y]), count as u32));
            recording.compute(compute_pass(&double, bind(&[&y]), count as u32));
        }
        recording.copy_buffer(&y, 0..y.size(), &readback, 0);
        // Twice without waiting in between: the second submission continues where the first one ends.
        let first = device.submit(&recording).unwrap();
        let second = device.submit(&recording).unwrap();
        second.wait().unwrap();
        assert!(first.is_done().unwrap());
        assert!(readback.read::<f32>(..).unwrap().iter().all(|&value| value == 4096.0));
    });
}

#[test]
fn push_constants_and_specialization_reach_the_shader() {
    with_device(|device| {
        let shader = shader(
            device,
            "affine.comp",
            "layout(local_size_x = 32) in;
             layout(constant_id = 3) const int OFFSET = 1;
             layout(constant_id = 4) const float SCALE = 1.0;
             layout(push_constant) uniform Push { int start; int count; };
             layout(binding = 7) buffer Values { float values[]; };
             void main() {
                 int i = int(gl_GlobalInvocationID.x);
                 if (i < count) values[start + i] = SCALE * float(i) + float(OFFSET);
             }",
        );
        let specialization = &[(4, 0.5f32.to_bits()), (99, 1), (3, 10)];
        let pipeline =
            device.compute_pipeline(&ComputePipelineDesc { name: "affine", shader: &shader, specialization }).unwrap();
        let values = device.upload("values", BufferUsage::STORAGE, &[0.0f32; 6]).unwrap();
        let mut recording = Recording::new();
        recording.compute(ComputePass {
            name: "affine".to_owned(),
            groups: pipeline.groups_for(3),
            pipeline,
            bindings: Bindings::new().with(7, &values),
            push: [2i32, 3].iter().flat_map(|word| word.to_ne_bytes()).collect(),
        });
        device.run(&recording).unwrap();
        assert_eq!(device.download::<f32>(&values, ..).unwrap(), [0.0, 0.0, 10.0, 10.5, 11.0, 0.0]);
    });
}

#[test]
fn the_local_size_can_be_specialized() {
    with_device(|device| {
        let source = "layout(local_size_x_id = 0, local_size_y = 2) in;
             layout(binding = 0) buffer Count { uint count; };
             void main() { atomicAdd(count, 1); }";
        let shader = shader(device, "count.comp", source);
        let pipeline = device
            .compute_pipeline(&ComputePipelineDesc { name: "count", shader: &shader, specialization: &[(0, 16)] })
            .unwrap();
        assert_eq!(pipeline.local_size(), [16, 2, 1]);
        let count = device.upload("count", BufferUsage::STORAGE, &[0u32]).unwrap();
        let mut recording = Recording::new();
        recording.compute(compute_pass(&pipeline, bind(&[&count]), 33));
        device.run(&recording).unwrap();
        assert_eq!(device.download::<u32>(&count, ..).unwrap(), [3 * 32]);
    });
}

#[test]
fn a_part_of_a_buffer_can_be_bound() {
    with_device(|device| {
        let start = device.info().limits.storage_buffer_alignment.max(4);
        let words = start as usize / 4;
        let values = device.upload("values", BufferUsage::STORAGE, &vec![1.0f32; words + 8]).unwrap();
        let double = compute_pipeline(device, "double.comp", DOUBLE);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&double, Bindings::new().with_range(0, &values, start..start + 16), 64));
        device.run(&recording).unwrap();
        let result = device.download::<f32>(&values, ..).unwrap();
        assert!(result[..words].iter().chain(&result[words + 4..]).all(|&value| value == 1.0));
        assert_eq!(result[words..words + 4], [2.0; 4]);
    });
}

#[test]
fn uniform_buffers_are_read_and_upload_buffers_rewritten() {
    with_device(|device| {
        let usage = BufferUsage::UNIFORM;
        let uniforms = device.buffer(&BufferDesc { name: "scale", size: 16, usage, memory: Memory::Upload }).unwrap();
        let values = device.upload("values", BufferUsage::STORAGE, &[1.0f32, 2.0]).unwrap();
        let pipeline = compute_pipeline(
            device,
            "scale.comp",
            "layout(binding = 0) uniform Scale { vec4 scale; };
             layout(binding = 1) buffer Values { float values[]; };
             void main() { values[gl_WorkGroupID.x] *= scale.x; }",
        );
        let mut recording = Recording::new();
        recording.compute(compute_pass(&pipeline, bind(&[&uniforms, &values]), 2));
        for scale in [3.0f32, 5.0] {
            uniforms.write(0, &[scale, 0.0, 0.0, 0.0]).unwrap();
            let submission = device.submit(&recording).unwrap();
            // Waits for the submission, which must not see it.
            uniforms.write(0, &[-1.0f32]).unwrap();
            assert!(submission.is_done().unwrap());
        }
        assert_eq!(device.download::<f32>(&values, ..).unwrap(), [15.0, 30.0]);
    });
}

/// The way in where the host does not see the device's memory.
#[test]
fn host_bytes_reach_device_memory_by_a_copy() {
    with_device(|device| {
        let make =
            |name, memory| device.buffer(&BufferDesc { name, size: 32, usage: BufferUsage::STORAGE, memory }).unwrap();
        let (staging, values) = (make("staging", Memory::Upload), make("values", Memory::Device));
        staging.write(8, &[1u32, 2, 3]).unwrap();
        let mut recording = Recording::new();
        recording.copy_buffer(&staging, 8..20, &values, 16);
        device.run(&recording).unwrap();
        assert_eq!(device.download::<u32>(&values, 16..28).unwrap(), [1, 2, 3]);
    });
}

#[test]
fn empty_buffers_and_dispatches_do_no_harm() {
    with_device(|device| {
        let empty = device.upload::<f32>("empty", BufferUsage::STORAGE, &[]).unwrap();
        let double = compute_pipeline(device, "double.comp", DOUBLE);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&double, bind(&[&empty]), 0));
        recording.copy_buffer(&empty, 0..0, &empty, 0);
        device.run(&recording).unwrap();
        assert!(device.download::<f32>(&empty, ..).unwrap().is_empty());
        device.run(&Recording::new()).unwrap();
    });
}

#[test]
fn a_submission_keeps_what_it_uses() {
    with_device(|device| {
        let readback = {
            let size = 4 << 20;
            let values = device.upload("values", BufferUsage::STORAGE, &vec![1.0f32; size / 4]).unwrap();
            let memory = Memory::Readback;
            let desc = BufferDesc { name: "result", size: size as u64, usage: BufferUsage::empty(), memory };
            let readback = device.buffer(&desc).unwrap();
            let double = compute_pipeline(device, "double.comp", DOUBLE);
            let mut recording = Recording::new();
            recording.compute(compute_pass(&double, bind(&[&values]), size as u32 / 4));
            recording.copy_buffer(&values, 0..size as u64, &readback, 0);
            let submission = device.submit(&recording).unwrap();
            drop((values, double, recording));
            submission.wait().unwrap();
            readback
        };
        assert!(readback.read::<f32>(..).unwrap().iter().all(|&value| value == 2.0));
    });
}
