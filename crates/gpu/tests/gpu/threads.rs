//! Objects shared between threads.

use std::{
    sync::atomic::{AtomicBool, Ordering},
    thread,
};

use osculate_gpu::{Buffer, BufferDesc, BufferUsage, Device, Memory, Recording};

use crate::harness::{bind, compute_pass, compute_pipeline, with_device};

/// Words of a short buffer.
const WORDS: usize = 1 << 19;
/// Short buffers in a long one. Its copies take so long that unguarded access by the host would fall into them.
const COPIES: usize = 4;
const ROUNDS: usize = 60;

fn buffer(device: &Device, name: &str, words: usize, memory: Memory) -> Buffer {
    let size = 4 * words as u64;
    device.buffer(&BufferDesc { name, size, usage: BufferUsage::empty(), memory }).unwrap()
}

/// Fills a buffer with copies of another one.
fn copies(source: &Buffer, target: &Buffer) -> Recording {
    let mut recording = Recording::new();
    for copy in 0..target.size() / source.size() {
        recording.copy_buffer(source, 0..source.size(), target, copy * source.size());
    }
    recording
}

/// Writes one number everywhere, again and again until `done`.
fn fill(buffer: &Buffer, number: u32, done: &AtomicBool) {
    let data = vec![number; WORDS];
    while !done.load(Ordering::Relaxed) {
        buffer.write(0, &data).unwrap();
        thread::yield_now();
    }
}

/// Sets the flag when dropped: at the end of its scope, or when an assertion fails there.
struct Raise<'a>(&'a AtomicBool);

impl Drop for Raise<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Reads a buffer, which must hold one number everywhere.
fn read_whole(buffer: &Buffer) {
    let data: Vec<u32> = buffer.read(..).unwrap();
    let first = data[0];
    let other = data.iter().position(|&word| word != first);
    assert_eq!(other, None, "word 0 is {first}, the named one is of another write");
}

#[test]
fn a_device_is_shared() {
    with_device(|device| {
        let double = compute_pipeline(
            device,
            "double.comp",
            "layout(local_size_x = 64) in;
             layout(binding = 0) buffer Values { float values[]; };
             void main() { values[gl_GlobalInvocationID.x] *= 2.0; }",
        );
        thread::scope(|scope| {
            for thread in 0..4 {
                let double = &double;
                scope.spawn(move || {
                    let values = device.upload("values", BufferUsage::STORAGE, &[thread as f32; 256]).unwrap();
                    let mut recording = Recording::new();
                    recording.compute(compute_pass(double, bind(&[&values]), 256));
                    for _ in 0..10 {
                        device.run(&recording).unwrap();
                    }
                    assert_eq!(device.download::<f32>(&values, ..).unwrap(), [1024.0 * thread as f32; 256]);
                });
            }
        });
    });
}

/// A submission sees every write by the host as a whole or not at all, and writes do not mix.
#[test]
fn writes_by_the_host_are_whole() {
    with_device(|device| {
        let (source, done) = (buffer(device, "source", WORDS, Memory::Upload), AtomicBool::new(false));
        source.write(0, &vec![0u32; WORDS]).unwrap();
        thread::scope(|scope| {
            for number in 1..=3 {
                let (source, done) = (&source, &done);
                scope.spawn(move || fill(source, number, done));
            }
            let _done = Raise(&done);
            let target = buffer(device, "target", COPIES * WORDS, Memory::Readback);
            let recording = copies(&source, &target);
            for _ in 0..ROUNDS {
                device.run(&recording).unwrap();
                read_whole(&target);
            }
        });
    });
}

/// A read by the host sees every submission as a whole or not at all.
#[test]
fn reads_by_the_host_are_whole() {
    with_device(|device| {
        let target = buffer(device, "target", COPIES * WORDS, Memory::Readback);
        let recordings = [1u32, 2].map(|number| {
            copies(&device.upload("numbers", BufferUsage::empty(), &vec![number; WORDS]).unwrap(), &target)
        });
        device.run(&recordings[0]).unwrap();
        thread::scope(|scope| {
            scope.spawn(|| (0..ROUNDS).for_each(|_| read_whole(&target)));
            for recording in recordings.iter().cycle().take(ROUNDS) {
                device.run(recording).unwrap();
            }
        });
    });
}

/// Submissions that use the same buffers in opposite order, and writes to both of them: nobody may wait for ever.
#[test]
fn locks_are_taken_in_one_order() {
    with_device(|device| {
        let ([a, b], done) =
            (["a", "b"].map(|name| buffer(device, name, WORDS, Memory::Upload)), AtomicBool::new(false));
        thread::scope(|scope| {
            for (number, buffer) in [(1, &a), (2, &b)] {
                let done = &done;
                scope.spawn(move || fill(buffer, number, done));
            }
            let _done = Raise(&done);
            let submit = |source, target| {
                let recording = copies(source, target);
                (0..ROUNDS).for_each(|_| drop(device.run(&recording).unwrap()));
            };
            thread::scope(|scope| {
                scope.spawn(|| submit(&a, &b));
                scope.spawn(|| submit(&b, &a));
            });
        });
    });
}
