//! Commands under the scheme that refines no triangle and no quad.

use crate::support::{CAGE, osculate};
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::fs;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

#[test]
fn every_face_is_a_patch() {
    let ran = osculate(folder().path(), &["inspect", "cage.obj", "--json"]).exits(0);
    let found: Value = serde_json::from_str(&ran.stdout).unwrap();
    let scheme = &found["schemes"]["gregory1"];
    assert_eq!((&scheme["patches"], &scheme["steps"]), (&json!(3), &json!(0)));
    assert_eq!(scheme["by_kind"], json!({ "gregory_stored": 1, "triangle_stored": 2 }));
}

#[test]
fn check_proves_triangles() {
    let arguments = ["check", "cage.obj", "--schemes", "gregory1", "--levels", "1,2,3.5", "--spacing", "even"];
    let ran = osculate(folder().path(), &arguments).exits(0);
    // Level 2 cuts the quad in 8 and a triangle in 6.
    assert!(
        ran.stdout.lines().nth(1).unwrap().starts_with("gregory1 level 2 even: 20 triangles, 0 open,"),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.lines().all(|line| line.ends_with(": watertight")), "{}", ran.stdout);
}

/// The three sub-faces of a triangle meet in its centroid, and at the middles of its sides.
#[test]
fn sub_faces_of_triangles_meet() {
    let ran = osculate(folder().path(), &["sample", "cage.obj", "--scheme", "gregory1", "--grid", "1"]).exits(0);
    let place = |line: &str| {
        let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        (cells[..4].join(","), cells[4..7].join(","))
    };
    let found: HashMap<String, String> = ran.stdout.lines().skip(1).map(place).collect();
    assert_eq!(found.len(), 4 * (1 + 3 + 3));
    for face in 1..3 {
        for sub in 0..3 {
            let next = (sub + 1) % 3;
            assert_eq!(found[&format!("{face},{sub},1,0")], found[&format!("{face},{next},0,1")]);
            assert_eq!(found[&format!("{face},{sub},1,1")], found[&format!("{face},{next},1,1")]);
        }
    }
    // The quad's corners are those of the triangle beside it.
    assert_eq!(found["0,-1,1,1"], found["1,2,0,0"]);
}

#[test]
fn exported_triangles_know_their_sub_faces() {
    let folder = folder();
    let arguments = ["export", "cage.obj", "-o", "out.ply", "--scheme", "gregory1", "--level", "4", "--no-weld"];
    osculate(folder.path(), &arguments).exits(0);
    let file = fs::read(folder.path().join("out.ply")).unwrap();
    let mark = b"end_header\n";
    let start = file.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len();
    // 32 triangles of the quad, 24 of each triangle.
    let vertices = file[start..].chunks_exact(40).take(3 * (32 + 2 * 24));
    let place = |vertex: &[u8]| [24, 28].map(|at| i32::from_le_bytes(vertex[at..at + 4].try_into().unwrap()));
    let places: HashSet<[i32; 2]> = vertices.map(place).collect();
    assert_eq!(places, HashSet::from([[0, -1], [1, 0], [1, 1], [1, 2], [2, 0], [2, 1], [2, 2]]));
}
