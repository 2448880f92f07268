//! Damaged files: whatever bytes change, the answer is a cage or a message.

use serde_json::json;

use super::{File, bytes, read_gltf, square};
use crate::gltf;
use crate::random::Random;
use crate::{ReadDesc, ReadError};

#[test]
fn damaged_files_never_panic() {
    let mut file = square();
    let uv = file.uv(&[[0.0, 0.0]; 4]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
    let (at, values) = (file.view(&[1]), file.view(&bytes(&[1.0, 0.0, 0.0])));
    file.json["accessors"][0]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    file.json["nodes"] = json!([{"children": [1], "scale": [1, 2, 3]}, {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]);
    let whole = file.glb();
    assert!(read_gltf(&whole, "whole.glb", None).is_ok());
    let mut random = Random::new(3);
    let mut read = 0;
    for _ in 0..20_000 {
        let mut damaged = whole.clone();
        for _ in 0..1 + random.below(3) {
            random.damage(&mut damaged, b"0123456789,:[]{}\"-e.\0\x01\xff");
        }
        read += usize::from(read_gltf(&damaged, "damaged.glb", None).is_ok());
    }
    assert!((500..19_500).contains(&read), "damage must hit some and spare some, but {read} of 20000 were read");
}

/// A file with everything that is read: skin, targets, animation, sparse and quantised accessors, textures, marked polygons.
fn everything() -> File {
    let mut file = square();
    let joints = file.accessor("VEC4", 5121, 4, &[0, 1, 0, 0].repeat(4));
    let weights = file.accessor("VEC4", 5126, 4, &bytes(&[0.5, 0.5, 0.0, 0.0].repeat(4)));
    let mut matrix = [0.0; 16];
    [0, 5, 10, 15].into_iter().for_each(|k| matrix[k] = 1.0);
    let inverse = file.accessor("MAT4", 5126, 2, &bytes(&matrix.repeat(2)));
    let offsets = file.positions(&[[0.5; 3]; 4]);
    let (at, values) = (file.view(&[1, 3]), file.view(&bytes(&[0.25; 6])));
    file.json["accessors"][offsets]["sparse"] =
        json!({"count": 2, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    let uv = file.accessor("VEC2", 5123, 4, &[9; 16]);
    let times = file.accessor("SCALAR", 5126, 2, &bytes(&[0.0, 1.0]));
    let moves = file.accessor("VEC3", 5126, 2, &bytes(&[0.0; 6]));
    let blends = file.accessor("SCALAR", 5126, 6, &bytes(&[0.0; 6]));
    let image = file.view(b"\x89PNG");
    let primitive = &mut file.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = json!({"POSITION": 0, "JOINTS_0": joints, "WEIGHTS_0": weights, "TEXCOORD_0": uv});
    primitive["targets"] = json!([{"POSITION": offsets}]);
    primitive["material"] = json!(0);
    primitive["extensions"] = json!({"FB_ngon_encoding": {}});
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    file.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": inverse}]);
    file.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"children": [2]}, {"translation": [1, 0, 0]}]);
    file.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    file.json["animations"] = json!([{
        "samplers": [{"input": times, "output": moves}, {"input": times, "output": blends, "interpolation": "CUBICSPLINE"}],
        "channels": [
            {"sampler": 0, "target": {"node": 2, "path": "translation"}}, {"sampler": 1, "target": {"node": 0, "path": "weights"}}
        ]
    }]);
    file
}

fn read(bytes: &[u8]) -> Result<crate::Cage, ReadError> {
    gltf::read_gltf(bytes, "damaged.glb", None, &ReadDesc::default())
}

#[test]
fn no_flipped_bit_panics() {
    let whole = everything().glb();
    let cage = read(&whole).unwrap_or_else(|error| panic!("{error}"));
    assert!(cage.rig().is_some_and(|rig| rig.animations.len() == 1) && cage.appearance().is_some());
    let mut refused = 0;
    for at in 0..whole.len() {
        for bit in [0, 3, 7] {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << bit;
            if let Ok(cage) = read(&damaged) {
                // What was read can be used.
                if let Some(rig) = cage.rig() {
                    (0..rig.animations.len()).for_each(|a| drop(rig.positions(&rig.pose(a, 0.5))));
                }
            } else {
                refused += 1;
            }
        }
    }
    assert!(refused > whole.len(), "only {refused} were refused");
}

#[test]
fn no_damage_to_a_rig_panics() {
    let whole = everything().glb();
    let mut random = Random::new(17);
    let mut good = 0;
    for _ in 0..10_000 {
        let mut damaged = whole.clone();
        for _ in 0..1 + random.below(3) {
            random.damage(&mut damaged, b"0123456789,:[]{}\"-e.\0\x01\xff");
        }
        good += usize::from(read(&damaged).is_ok());
    }
    assert!((100..9_900).contains(&good), "damage must hit some and spare some, but {good} of 10000 were read");
}

#[test]
fn small_files_that_ask_for_much() {
    // Thousands of targets that all use one accessor.
    let mut file = square();
    let targets = vec![json!({"POSITION": 0}); 2000];
    file.json["meshes"][0]["primitives"][0]["targets"] = json!(targets);
    let nodes: Vec<_> = (0..12_000).map(|_| json!({"mesh": 0})).collect();
    file.json["scenes"] = json!([{"nodes": (0..nodes.len()).collect::<Vec<_>>()}]);
    file.json["nodes"] = json!(nodes);
    // 96 million offsets would take more memory than they are worth.
    let message = file.refused();
    assert_eq!(
        message,
        "test.glb: more than 67108864 numbers in joints, morph targets, uv sets and animations; that is no control cage"
    );
    // Keys that no bytes stand behind.
    let mut file = square();
    let times = file.push("accessors", json!({"componentType": 5126, "count": 4_000_000_000_u32, "type": "SCALAR"}));
    file.json["animations"] = json!([{
        "samplers": [{"input": times, "output": times}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]
    }]);
    assert!(file.refused().contains("accessor 2 holds SCALAR of F32"), "{}", file.refused());
    file.json["accessors"][2]["type"] = json!("VEC3");
    assert!(file.refused().contains("more than 67108864 numbers"), "{}", file.refused());
}

#[test]
fn small_files_that_ask_for_much_work() {
    // A mesh at every node of a long chain that is animated at its root.
    let mut file = square();
    let depth = 30_000;
    let mut nodes: Vec<_> = (1..depth).map(|child| json!({"mesh": 0, "children": [child]})).collect();
    nodes.push(json!({"mesh": 0}));
    file.json["nodes"] = json!(nodes);
    let times = file.accessor("SCALAR", 5126, 1, &[0; 4]);
    let values = file.accessor("VEC3", 5126, 1, &[0; 12]);
    file.json["animations"] = json!([{
        "samplers": [{"input": times, "output": values}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]
    }]);
    assert_eq!(file.read().face_count(), 2 * depth);
    // Empty primitives, many times in many places.
    let mut file = square();
    let nothing = file.indices(&[]);
    let empty = json!({"attributes": {"POSITION": 0}, "indices": nothing});
    file.json["meshes"][0]["primitives"] = json!(vec![empty; 3000]);
    file.json["nodes"] = json!(vec![json!({"mesh": 0}); 3000]);
    file.json["scenes"] = json!([{"nodes": (0..3000).collect::<Vec<_>>()}]);
    assert!(file.refused().contains("more than 67108864 numbers"), "{}", file.refused());
}

#[test]
fn deeply_nested_json_is_refused_or_passed_over() {
    let nested = "[".repeat(200_000) + &"]".repeat(200_000);
    let with = |path: &str, key: &str| {
        let mut file = square();
        file.json.pointer_mut(path).expect("a place")[key] = json!("NESTED");
        let text = file.with_uri("data:;base64,").to_vec();
        let text = String::from_utf8(text).expect("JSON").replace("\"NESTED\"", &nested);
        read_gltf(text.as_bytes(), "nested.gltf", None).expect_err("it has no bytes").to_string()
    };
    let no_bytes = "nested.gltf: buffer 0 has 0 of the 56 bytes it announces";
    // What is not looked at may be nested; what is has a limit.
    for (path, key) in [("/meshes/0", "extras"), ("/meshes/0", "unknown"), ("", "unknown"), ("/asset", "extras")] {
        assert_eq!(with(path, key), no_bytes, "{path} {key}");
    }
    for (path, key) in [("/nodes/0", "children"), ("/meshes/0", "extensions"), ("", "extensionsRequired")] {
        let message = with(path, key);
        assert!(message.starts_with("nested.gltf: not readable as glTF 2.0: "), "{path} {key}: {message}");
    }
    // Names of morph targets are looked for in extras.
    let mut file = square();
    let lift = file.positions(&[[0.0; 3]; 4]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": lift}]);
    file.json["meshes"][0]["extras"] = json!("NESTED");
    let glb = file.glb();
    let at = glb.windows(8).position(|bytes| bytes == b"\"NESTED\"").expect("the mark");
    let start = glb.windows(4).rposition(|bytes| bytes == b"BIN\0").expect("the binary part") - 4;
    let mut json = [&glb[20..at], nested.as_bytes(), &glb[at + 8..start]].concat();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |n: usize| u32::try_from(n).expect("a small file").to_le_bytes();
    let chunks = [&word(json.len()), b"JSON", &json[..], &glb[start..]].concat();
    let glb = [&b"glTF"[..], &word(2), &word(12 + chunks.len()), &chunks].concat();
    let cage = read(&glb).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(cage.rig().expect("a rig").morph_sets[0].targets[0].name, "target 0");
}
