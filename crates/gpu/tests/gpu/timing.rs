//! What a report measures.

use osculate_gpu::{BufferUsage, Measure, Recording};

use crate::harness::{bind, compute_pass, compute_pipeline, with_device};

#[test]
fn every_pass_has_a_time() {
    with_device(|device| {
        let values = device.upload("values", BufferUsage::STORAGE, &[1u32; 4096]).unwrap();
        let pipeline = compute_pipeline(
            device,
            "churn.comp",
            "layout(local_size_x = 64) in;
             layout(binding = 0) buffer Values { uint values[]; };
             void main() {
                 uint x = values[gl_GlobalInvocationID.x];
                 for (int i = 0; i < 1000; ++i) x = x * 1664525u + 1013904223u;
                 values[gl_GlobalInvocationID.x] = x;
             }",
        );
        let mut recording = Recording::new();
        recording.measure(Measure { timings: true, statistics: true });
        recording.compute(compute_pass(&pipeline, bind(&[&values]), 4096));
        recording.copy_buffer(&values, 0..8, &values, 8);
        let start = std::time::Instant::now();
        let report = device.run(&recording).unwrap();
        let wall = start.elapsed().as_nanos() as u64;
        let names: Vec<&str> = report.timings.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["churn.comp", "copy values to values"]);
        let total: u64 = report.timings.iter().map(|(_, ns)| ns).sum();
        assert!(total > 0 && total < wall, "{total} ns of {wall} ns");
        assert!(report.statistics.is_empty(), "there are no render passes");
        let alone: Vec<_> = recording.split().map(|pass| device.run(&pass).unwrap().timings).collect();
        assert_eq!(alone.iter().map(Vec::len).collect::<Vec<usize>>(), [1, 1]);
        assert_eq!([&alone[0][0].0, &alone[1][0].0], ["churn.comp", "copy values to values"]);
    });
}
