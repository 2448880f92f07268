//! Small files that announce two thousand million elements, read with little memory: a reader that made room for what it is told
//! would be ended by the system.
#![cfg(target_os = "linux")]

use crate::support::{Ran, command};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

/// Runs the command with at most 1 GiB of addresses. Two thousand million bytes do not fit.
fn confined(folder: &Path, arguments: &[&str]) -> Ran {
    let own = command(folder, arguments);
    let mut shell = Command::new("sh");
    shell.args(["-c", "ulimit -v 1048576 && exec \"$0\" \"$@\""]).arg(own.get_program()).args(own.get_args());
    Ran::new(arguments, shell.current_dir(folder).output().unwrap())
}

#[track_caller]
fn refused(name: &str, bytes: impl AsRef<[u8]>, message: &str) {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join(name), bytes).unwrap();
    confined(folder.path(), &["inspect", name]).fails(3, &format!("error: {name}{message}"));
}

#[test]
fn what_is_there_is_read() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("a.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap();
    confined(folder.path(), &["inspect", "a.off"]).exits(0);
}

#[test]
fn counts_of_text_files() {
    refused("a.off", "OFF\n2147483648 1 0\n0 0 0\n", ":3: the file ends after 1 of 2147483648 vertices");
    refused("a.off", "OFF\n1 2147483648 0\n0 0 0\n", ":3: the file ends after 0 of 2147483648 faces");
    refused("a.off", "OFF\n1 1 0\n0 0 0\n2147483648 0\n", ":4: a face announces 2147483648 corners but has 1");
    refused("a.obj", "v 0 0 0\nf 1 1 2147483648\n", ":2: vertex index 2147483648 is out of range");
    refused("a.obj", "v 0 0 0\nt crease 2147483648/1/0 0\n", ":2: tag crease announces 2147483649 arguments but has 1");
}

#[test]
fn counts_of_ply_files() {
    let ply = |format: &str, vertices: u32, faces: u32, data: &[u8]| {
        let header = format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
             element face {faces}\nproperty list uint int vertex_indices\nend_header\n"
        );
        [header.as_bytes(), data].concat()
    };
    let many = 1 << 31;
    refused("a.ply", ply("ascii", many, 1, b"0 0 0\n"), ": the file ends in vertex 1 of 2147483648");
    refused("a.ply", ply("binary_little_endian", many, 1, &[0; 24]), ": the file ends in vertex 2 of 2147483648");
    refused("a.ply", ply("binary_little_endian", 1, many, &[0; 24]), ": the file ends in face 3 of 2147483648");
    refused(
        "a.ply",
        ply("binary_big_endian", 1, 1, &[&[0; 12], &many.to_be_bytes()[..]].concat()),
        ": the file ends in face 0 of 1",
    );
}

/// A triangle, changed by `change`.
fn gltf(change: impl FnOnce(&mut Value)) -> String {
    let mut json = json!({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 0, "componentType": 5125, "count": 3, "type": "SCALAR"}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": format!("data:;base64,{}", "A".repeat(48))}]
    });
    change(&mut json);
    json.to_string()
}

#[test]
fn counts_of_gltf_files() {
    let many = 1_u64 << 31;
    let set = |path: &'static str| move |json: &mut Value| *json.pointer_mut(path).unwrap() = json!(many);
    let view = "accessor 0 needs 25769803776 bytes of a view with 36";
    refused("a.gltf", gltf(set("/accessors/0/count")), &format!(": mesh 0 primitive 0, POSITION: {view}"));
    refused("a.gltf", gltf(set("/buffers/0/byteLength")), ": buffer 0 has 36 of the 2147483648 bytes it announces");
    let view = "accessor 0 uses view 0, which leaves its buffer";
    refused("a.gltf", gltf(set("/bufferViews/0/byteLength")), &format!(": mesh 0 primitive 0, POSITION: {view}"));
    // Elements without any bytes behind them are zeros.
    let zeros = gltf(|json| json["accessors"][1] = json!({"componentType": 5125, "count": many, "type": "SCALAR"}));
    refused("a.gltf", zeros, ": mesh 0 primitive 0 has 2147483648 corners, which are no whole triangles");
    let zeros = gltf(|json| json["accessors"][1] = json!({"componentType": 5125, "count": many + 1, "type": "SCALAR"}));
    refused("a.gltf", zeros, ": more than 67108864 triangle corners");
    let sparse = gltf(|json| {
        let view = json!({"bufferView": 0, "componentType": 5125});
        json["accessors"][0]["sparse"] = json!({"count": many, "indices": view, "values": {"bufferView": 0}});
    });
    let needed = "accessor 0 needs 8589934592 bytes of a view with 36";
    refused("a.gltf", sparse, &format!(": mesh 0 primitive 0, POSITION: {needed}"));
}

#[test]
fn lengths_of_binary_files() {
    let json = gltf(|json| json["buffers"] = json!([{"byteLength": 36}])).into_bytes();
    let word = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    let glb =
        |length: usize, chunk: usize| [&b"glTF"[..], &word(2), &word(length), &word(chunk), b"JSON", &json].concat();
    refused("a.glb", glb(20 + json.len(), 1 << 31), ": not readable as glTF 2.0: ");
    refused("a.glb", glb(1 << 31, 1 << 31), ": not readable as glTF 2.0: ");
    refused("a.glb", glb(1 << 31, json.len()), ": ");
}
