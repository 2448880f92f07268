//! Prepared recordings: the same results as submitted ones, run after run, whatever happens to their images in between.

use osculate_gpu::{
    BufferDesc, BufferUsage, ColorTarget, Device, Format, Image, Measure, Memory, Recording, RenderPass,
};

use crate::harness::{bind, compute_pass, compute_pipeline, target, with_device};

const DOUBLE: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer From { float from[]; };
layout(binding = 1) writeonly buffer To { float to[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < to.length()) to[i] = 2.0 * from[i];
}";

fn buffer(device: &Device, name: &str, memory: Memory) -> osculate_gpu::Buffer {
    device.buffer(&BufferDesc { name, size: 400, usage: BufferUsage::STORAGE, memory }).unwrap()
}

#[test]
fn every_run_sees_what_the_host_wrote_before_it_and_makes_nothing() {
    with_device(|device| {
        let (input, doubled, output) = (
            buffer(device, "input", Memory::Upload),
            buffer(device, "doubled", Memory::Device),
            buffer(device, "output", Memory::Readback),
        );
        let pipeline = compute_pipeline(device, "double.comp", DOUBLE);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&pipeline, bind(&[&input, &doubled]), 100));
        recording.compute(compute_pass(&pipeline, bind(&[&doubled, &output]), 100));
        recording.copy_buffer(&doubled, 0..8, &input, 392);
        let mut prepared = device.prepare(&recording).unwrap();
        let load = prepared.workload();
        assert_eq!((load.passes, load.dispatches, load.draws, load.bytes_copied), (3, 2, 0, 8));
        assert_eq!(load.barriers, 3, "before the second dispatch, before the copy, and at the end");
        let before = device.memory_use();
        for run in 1..=4 {
            input.write(0, &[run as f32; 100]).unwrap();
            // Not waited for: reading waits.
            prepared.submit().unwrap();
            assert!(output.read::<f32>(..).unwrap().iter().all(|&value| value == 4.0 * run as f32));
        }
        let after = device.memory_use();
        assert_eq!((after.made, after.live, after.live_bytes), (before.made, before.live, before.live_bytes));
        assert_eq!(after.host_bytes_written - before.host_bytes_written, 4 * 400);
    });
}

#[test]
fn runs_follow_one_another_and_reports_are_those_of_the_last() {
    with_device(|device| {
        let values = device.upload("values", BufferUsage::STORAGE, &[1.0f32; 64]).unwrap();
        let other = device.upload("other", BufferUsage::STORAGE, &[0.0f32; 64]).unwrap();
        let pipeline = compute_pipeline(device, "double.comp", DOUBLE);
        let mut recording = Recording::new();
        recording.measure(Measure { timings: true, statistics: false });
        recording.compute(compute_pass(&pipeline, bind(&[&values, &other]), 64));
        recording.copy_buffer(&other, 0..256, &values, 0);
        let mut prepared = device.prepare(&recording).unwrap();
        assert!(prepared.wait().unwrap().timings.is_empty(), "it never ran");
        for _ in 0..5 {
            prepared.submit().unwrap();
        }
        assert_eq!(prepared.wait().unwrap().timings.len(), 2);
        assert_eq!(device.download::<f32>(&values, ..).unwrap(), [32.0; 64]);
        // What it uses lives as long as it does.
        drop((pipeline, values, other));
        prepared.run().unwrap();
    });
}

/// A pass that clears an image, or keeps what is there, and a copy of its texels.
fn painted(image: &Image, clear: Option<[f32; 4]>, texels: &osculate_gpu::Buffer) -> Recording {
    let mut recording = Recording::new();
    recording.render(RenderPass {
        name: "picture".to_owned(),
        color: Some(ColorTarget { image: image.clone(), clear, resolve: None }),
        depth: None,
        viewport: [16, 16].into(),
        area: None,
        draws: vec![],
    });
    recording.copy_image_to_buffer(image, texels);
    recording
}

/// A recording leaves its image to be copied from; another one leaves it to be drawn to.
#[test]
fn images_may_be_used_by_others_between_runs() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let desc = BufferDesc { name: "texels", size: 1024, usage: BufferUsage::STORAGE, memory: Memory::Readback };
        let texels = device.buffer(&desc).unwrap();
        let first = || texels.read::<u8>(..4).unwrap();
        let mut red = device.prepare(&painted(&image, Some([1.0, 0.0, 0.0, 1.0]), &texels)).unwrap();
        // The image has no layout before the first run, and has one from then on.
        red.run().unwrap();
        assert_eq!(first(), [255, 0, 0, 255]);
        red.run().unwrap();
        let mut kept = device.prepare(&painted(&image, None, &texels)).unwrap();
        let mut blue = Recording::new();
        blue.render(RenderPass {
            name: "blue".to_owned(),
            color: Some(ColorTarget { image: image.clone(), clear: Some([0.0, 0.0, 1.0, 1.0]), resolve: None }),
            depth: None,
            viewport: [16, 16].into(),
            area: None,
            draws: vec![],
        });
        device.run(&blue).unwrap();
        kept.run().unwrap();
        assert_eq!(first(), [0, 0, 255, 255]);
        red.run().unwrap();
        assert_eq!(first(), [255, 0, 0, 255]);
        kept.run().unwrap();
        assert_eq!(first(), [255, 0, 0, 255]);
    });
}

#[test]
fn what_is_wrong_is_found_when_it_is_prepared() {
    with_device(|device| {
        let image = target(device, "picture", Format::Rgba8Unorm, 1);
        let texels = buffer(device, "texels", Memory::Device);
        let error = device.prepare(&painted(&image, None, &texels)).unwrap_err();
        assert!(error.to_string().contains("nothing was drawn there yet"), "{error}");
    });
}
