//! Buffers that shaders read as arrays of vectors.

use osculate_gpu::{Bindings, BufferUsage, Recording, TexelFormat};

use crate::harness::{compute_pass, compute_pipeline, with_device};

/// Every invocation reads a vector far from its neighbour's, from three arrays of different vectors.
const GATHER: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer triples;
layout(binding = 1) uniform usamplerBuffer quadruples;
layout(binding = 2) uniform usamplerBuffer pairs;
layout(binding = 3) uniform usamplerBuffer numbers;
layout(binding = 4) writeonly buffer Found { uint found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < 1000u) {
        int at = int(texelFetch(numbers, int(i)).x);
        vec3 triple = texelFetch(triples, at).xyz;
        uvec4 quadruple = texelFetch(quadruples, at);
        uvec2 pair = texelFetch(pairs, at).xy;
        uint all[9] = uint[9](
            floatBitsToUint(triple.x), floatBitsToUint(triple.y), floatBitsToUint(triple.z),
            quadruple.x, quadruple.y, quadruple.z, quadruple.w, pair.x, pair.y);
        for (uint k = 0u; k < 9u; ++k) found[9u * i + k] = all[k];
    }
}";

#[test]
fn vectors_of_all_formats_are_read_as_they_were_written() {
    with_device(|device| {
        let count = 1000u32;
        let word = |i: u32, k: u32| (16 * i + k).wrapping_mul(0x9e37_79b9);
        let words = |width: u32| (0..count).flat_map(|i| (0..width).map(move |k| word(i, k))).collect::<Vec<u32>>();
        let scattered: Vec<u32> = (0..count).map(|i| 7919 * i % count).collect();
        let texels = |name: &str, data: &[u32]| device.upload(name, BufferUsage::TEXELS, data).unwrap();
        let found = device.upload("found", BufferUsage::STORAGE, &vec![0u32; 9 * count as usize]).unwrap();
        let bindings = Bindings::new()
            .with_texels(0, &texels("triples", &words(3)), TexelFormat::Rgb32Float)
            .with_texels(1, &texels("quadruples", &words(4)), TexelFormat::Rgba32Uint)
            .with_texels(2, &texels("pairs", &words(2)), TexelFormat::Rg32Uint)
            .with_texels(3, &texels("numbers", &scattered), TexelFormat::R32Uint)
            .with(4, &found);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&compute_pipeline(device, "gather.comp", GATHER), bindings, count));
        device.run(&recording).unwrap();
        let of = |at: u32| [3, 4, 2].into_iter().flat_map(move |width| (0..width).map(move |k| word(at, k)));
        let expected: Vec<u32> = scattered.iter().flat_map(|&at| of(at)).collect();
        let found = device.download::<u32>(&found, ..).unwrap();
        for (i, (found, expected)) in found.chunks(9).zip(expected.chunks(9)).enumerate() {
            assert_eq!(found, expected, "invocation {i}");
        }
    });
}

/// The average of four, as the engine's kernels read points.
const AVERAGE: &str = "
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer points;
layout(binding = 1) uniform usamplerBuffer quads;
layout(binding = 2) writeonly buffer Found { float found[]; };
vec3 load_point(uint i) { return texelFetch(points, int(i)).xyz; }
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < 100u) {
        uvec4 q = texelFetch(quads, int(i));
        vec3 p[4] = vec3[](load_point(q.x), load_point(q.y), load_point(q.z), load_point(q.w));
        for (uint k = 0u; k < 12u; ++k) found[12u * i + k] = p[k / 3u][k % 3u];
    }
}";

#[test]
fn one_buffer_is_read_several_times() {
    with_device(|device| {
        let points: Vec<f32> = (0..300).map(|i| i as f32).collect();
        let quads: Vec<u32> = (0..400).map(|i| 37 * i % 100).collect();
        let expected: Vec<f32> = quads.iter().flat_map(|&q| (0..3).map(move |k| (3 * q + k) as f32)).collect();
        let found = device.upload("found", BufferUsage::STORAGE, &vec![0f32; 1200]).unwrap();
        let bindings = Bindings::new()
            .with_texels(0, &device.upload("points", BufferUsage::TEXELS, &points).unwrap(), TexelFormat::Rgb32Float)
            .with_texels(1, &device.upload("quads", BufferUsage::TEXELS, &quads).unwrap(), TexelFormat::Rgba32Uint)
            .with(2, &found);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&compute_pipeline(device, "average.comp", AVERAGE), bindings, 100));
        device.run(&recording).unwrap();
        let found = device.download::<f32>(&found, ..).unwrap();
        for (i, (found, expected)) in found.chunks(12).zip(expected.chunks(12)).enumerate() {
            assert_eq!(found, expected, "invocation {i}");
        }
    });
}

/// The buffer must have been made for it, hold what the shader reads, and be bound as what the shader declares.
#[test]
fn what_shaders_cannot_read_so_is_refused() {
    with_device(|device| {
        let pipeline = compute_pipeline(device, "average.comp", AVERAGE);
        let buffer = |usage| device.upload("words", usage, &[0u32; 1200]).unwrap();
        let (texels, found) = (buffer(BufferUsage::TEXELS), buffer(BufferUsage::STORAGE));
        let good = Bindings::new()
            .with_texels(0, &texels, TexelFormat::Rgb32Float)
            .with_texels(1, &texels, TexelFormat::Rgba32Uint)
            .with(2, &found);
        let run = |bindings| {
            let mut recording = Recording::new();
            recording.compute(compute_pass(&pipeline, bindings, 100));
            device.run(&recording).map(drop)
        };
        run(good.clone()).unwrap();
        let cases = [
            (good.clone().with_texels(0, &found, TexelFormat::Rgb32Float), "was not made with that usage"),
            (good.clone().with_texels(0, &texels, TexelFormat::R32Uint), "declares \"points\" as a samplerBuffer"),
            (good.clone().with(0, &texels), "declares \"points\" as a samplerBuffer"),
            (good.with_texels(2, &texels, TexelFormat::R32Uint), "as a storage buffer"),
        ];
        for (bindings, expected) in cases {
            let error = run(bindings).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    });
}

/// An empty buffer can be bound: there is nothing that a shader may read.
#[test]
fn an_empty_buffer_is_an_array_of_nothing() {
    with_device(|device| {
        let empty = device.upload::<u32>("empty", BufferUsage::TEXELS, &[]).unwrap();
        let found = device.upload("found", BufferUsage::STORAGE, &[0f32; 1200]).unwrap();
        let bindings = Bindings::new()
            .with_texels(0, &empty, TexelFormat::Rgb32Float)
            .with_texels(1, &empty, TexelFormat::Rgba32Uint)
            .with(2, &found);
        let mut recording = Recording::new();
        recording.compute(compute_pass(&compute_pipeline(device, "average.comp", AVERAGE), bindings, 100));
        device.run(&recording).unwrap();
    });
}
