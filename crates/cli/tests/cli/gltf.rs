//! glTF files on the command line.

use crate::support::osculate;
use serde_json::{Value, json};
use std::fs;
use tempfile::{TempDir, tempdir};

/// A folder with `strip.gltf`: a row of two quads, each as two triangles, and then a triangle, beside its buffer.
fn folder() -> TempDir {
    folder_of(&[0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 6, 5])
}

/// The same with these triangles.
fn folder_of(indices: &[u16]) -> TempDir {
    let points: [[f32; 3]; 7] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [2.0, 1.0, 0.0],
        [3.0, 0.5, 0.0],
    ];
    let mut bytes: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    let json = json!({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 7, "type": "VEC3", "min": [0, 0, 0], "max": [3, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": indices.len(), "type": "SCALAR"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 84},
            {"buffer": 0, "byteOffset": 84, "byteLength": 2 * indices.len()}
        ],
        "buffers": [{"byteLength": bytes.len(), "uri": "strip.bin"}]
    });
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("strip.bin"), bytes).unwrap();
    fs::write(folder.path().join("strip.gltf"), json.to_string()).unwrap();
    folder
}

fn inspect(folder: &TempDir, arguments: &[&str]) -> Value {
    let ran = osculate(folder.path(), &[&["inspect", "strip.gltf", "--json"], arguments].concat()).exits(0);
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn quads_come_back_and_what_is_left_is_told() {
    let folder = folder();
    let found = inspect(&folder, &[]);
    assert_eq!(found["faces_by_size"], json!({ "3": 1, "4": 2 }));
    assert_eq!(
        found["polygons"],
        json!({ "triangles": 5, "marked": 0, "marked_triangles": 0, "by_order": 2, "by_shape": 0, "left": 1 })
    );
    let told = "5 triangles give 2 larger polygons (2 by order); 1 stay as they are: 2";
    assert_eq!(found["problems"][0], told);
    let text = osculate(folder.path(), &["inspect", "strip.gltf"]).exits(0).stdout;
    assert!(text.contains(&format!("\npolygons         {told}\n")), "{text}");
    let ran = osculate(folder.path(), &["repair", "strip.gltf", "-o", "strip.obj"]).exits(0);
    assert!(ran.stderr.contains(&format!("warning: strip.gltf: {told}\n")), "{}", ran.stderr);
}

#[test]
fn signs_of_polygons_can_be_chosen() {
    let folder = folder();
    for (signs, sizes) in
        [("none", json!({ "3": 5 })), ("marked", json!({ "3": 5 })), ("marked,shape", json!({ "3": 1, "4": 2 }))]
    {
        assert_eq!(inspect(&folder, &["--gltf-polygons", signs])["faces_by_size"], sizes, "{signs}");
    }
    for (arguments, part) in [
        (["--gltf-polygons", "none,order"], "none goes with no other"),
        (["--gltf-polygons", "guess"], "guess"),
        (["--gltf-weld", "nan"], "--gltf-weld NaN is no distance"),
    ] {
        let ran = osculate(folder.path(), &[&["inspect", "strip.gltf"], &arguments[..]].concat()).exits(2);
        assert!(ran.stderr.contains(part), "{}", ran.stderr);
    }
}

#[test]
fn vertices_within_a_distance_are_welded() {
    let folder = folder();
    // Within 0.6, the tip of the triangle stays where it is, but not within 1.2.
    assert_eq!(inspect(&folder, &["--gltf-weld", "0.6"])["vertices"], 7);
    osculate(folder.path(), &["inspect", "strip.gltf", "--gltf-weld", "5"]).fails(3, "no faces");
}

#[test]
fn what_is_no_mesh_is_repaired() {
    // The last triangle is there a second time the other way round, and a fin stands on the side between the quads.
    let folder = folder_of(&[0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 6, 5, 5, 6, 2, 1, 4, 6]);
    osculate(folder.path(), &["inspect", "strip.gltf"]).fails(3, "strip.gltf: not manifold");
    let repair = ["repair", "strip.gltf", "--gltf-polygons", "none", "-o", "fixed.obj"];
    let ran = osculate(folder.path(), &repair).exits(0);
    let told =
        "warning: strip.gltf: repaired: 1 copied face dropped: 5; 1 edge with more than two faces separated: 1-2; ";
    assert!(ran.stderr.contains(told), "{}", ran.stderr);
    let fixed = fs::read_to_string(folder.path().join("fixed.obj")).unwrap();
    assert!(fixed.contains("o node 0\n"), "{fixed}");
    assert_eq!(fixed.lines().filter(|line| line.starts_with("f ")).count(), 6);
    let again = osculate(folder.path(), &["repair", "fixed.obj", "-o", "again.obj"]).exits(0);
    assert_eq!(again.stderr, "");
    assert_eq!(fs::read_to_string(folder.path().join("again.obj")).unwrap(), fixed);
}
