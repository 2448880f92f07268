//! `osculate export`.

use crate::support::{CAGE, osculate};
use std::collections::HashSet;
use std::fs;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

/// The bytes of the export to `name`.
fn export(folder: &TempDir, name: &str, more: &[&str]) -> Vec<u8> {
    let ran = osculate(folder.path(), &[&["export", "cage.obj", "-o", name], more].concat()).exits(0);
    assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("", ""));
    fs::read(folder.path().join(name)).unwrap()
}

/// Header and body of a PLY file.
fn ply(file: &[u8]) -> (String, Vec<u8>) {
    let mark = b"end_header\n";
    let end = file.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len();
    (String::from_utf8(file[..end].to_vec()).unwrap(), file[end..].to_vec())
}

fn number<const N: usize, T>(bytes: &[u8], at: usize, from: fn([u8; N]) -> T) -> T {
    from(bytes[at..at + N].try_into().unwrap())
}

#[test]
fn triangles_as_drawn_know_their_place() {
    let folder = folder();
    let (header, body) = ply(&export(&folder, "out.ply", &["--level", "2", "--no-weld"]));
    // 40 patches of 8 triangles.
    let expected = "ply|format binary_little_endian 1.0|element vertex 960|property float x|property float y|property float z|\
        property float nx|property float ny|property float nz|property int face|property int sub|property float s|property float t|\
        element face 320|property list uchar uint vertex_indices|end_header|";
    assert_eq!(header.replace('\n', "|"), expected);
    assert_eq!(body.len(), 960 * 40 + 320 * 13);
    let mut subs = HashSet::new();
    for vertex in body[..960 * 40].chunks(40) {
        let place = (number(vertex, 24, i32::from_le_bytes), number(vertex, 28, i32::from_le_bytes));
        subs.insert(place);
        for at in [32, 36] {
            assert!((0.0..=1.0).contains(&number(vertex, at, f32::from_le_bytes)));
        }
    }
    let expected = [(0, -1), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
    assert_eq!(subs, HashSet::from(expected));
}

/// Both evaluators have the same vertices at a power of two; the triangles between them may differ.
#[test]
fn evaluators_export_the_same_vertices() {
    let folder = folder();
    let vertices = |evaluator| {
        let arguments = ["--level", "4", "--no-weld", "--evaluator", evaluator];
        let (_, body) = ply(&export(&folder, "out.ply", &arguments));
        // 40 patches of 32 triangles.
        body[..40 * 32 * 3 * 40].chunks(40).map(<[u8]>::to_vec).collect::<HashSet<_>>()
    };
    let [tessellator, compute] = ["tessellator", "compute"].map(vertices);
    assert_eq!(tessellator.len(), compute.len());
    // Software drivers give the same bits, others nearly.
    let places = |vertices: &HashSet<Vec<u8>>| vertices.iter().map(|v| v[24..].to_vec()).collect::<HashSet<_>>();
    assert_eq!(places(&tessellator), places(&compute));
}

#[test]
fn exported_places_sample_to_the_exported_positions() {
    let folder = folder();
    let (_, body) = ply(&export(&folder, "out.ply", &["--level", "3", "--no-weld"]));
    let float = |vertex: &[u8], at| number(vertex, at, f32::from_le_bytes);
    let vertices: Vec<&[u8]> = body[..40 * 18 * 3 * 40].chunks(40).collect();
    let places = vertices.iter().map(|vertex| {
        let int = |at| number(vertex, at, i32::from_le_bytes);
        format!("{},{},{},{}\n", int(24), int(28), float(vertex, 32), float(vertex, 36))
    });
    fs::write(folder.path().join("places.csv"), places.collect::<String>()).unwrap();
    let sampled = osculate(folder.path(), &["sample", "cage.obj", "--at", "places.csv"]).exits(0).stdout;
    for (vertex, row) in vertices.iter().zip(sampled.lines().skip(1)) {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        for axis in 0..3 {
            let difference = (f64::from(float(vertex, 4 * axis)) - cells[4 + axis]).abs();
            assert!(difference < 2e-6, "{row}: {difference}");
        }
    }
}

#[test]
fn welded_meshes_share_vertices_in_every_format() {
    let folder = folder();
    // A quad grid of 8 segments along each edge of the cage's three faces: V - E + F = 1 for a disc.
    let (header, body) = ply(&export(&folder, "out.ply", &["--level", "2"]));
    let count = |name: &str| -> usize {
        let line = header.lines().find(|line| line.starts_with(name)).unwrap();
        line.rsplit(' ').next().unwrap().parse().unwrap()
    };
    let (vertices, faces) = (count("element vertex"), count("element face"));
    assert_eq!(faces, 320);
    assert_eq!(body.len(), vertices * 24 + faces * 13);
    let mut edges = HashSet::new();
    for face in body[vertices * 24..].chunks(13) {
        let index = |i: usize| number(face, 1 + 4 * (i % 3), u32::from_le_bytes);
        edges.extend((0..3).map(|i| (index(i).min(index(i + 1)), index(i).max(index(i + 1)))));
    }
    assert_eq!(vertices + faces, edges.len() + 1);

    let obj = String::from_utf8(export(&folder, "out.obj", &["--level", "2"])).unwrap();
    let lines = |start: &str| obj.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!((lines("v "), lines("vn "), lines("f ")), (vertices, vertices, faces));
    assert_eq!(export(&folder, "out.stl", &["--level", "2"]).len(), 84 + 50 * faces);
    let glb = export(&folder, "out.glb", &["--level", "2"]);
    let json: serde_json::Value =
        serde_json::from_slice(&glb[20..20 + number(&glb, 12, u32::from_le_bytes) as usize]).unwrap();
    assert_eq!(
        (json["accessors"][0]["count"].as_u64(), json["accessors"][2]["count"].as_u64()),
        (Some(vertices as u64), Some(3 * faces as u64))
    );
}

#[test]
fn an_exported_mesh_is_a_cage_again() {
    let folder = folder();
    export(&folder, "out.obj", &["--level", "2.5", "--spacing", "odd"]);
    let ran = osculate(folder.path(), &["inspect", "out.obj", "--json"]).exits(0);
    let found: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!((found["euler"].as_i64(), found["components"].as_i64()), (Some(1), Some(1)));
}

#[test]
fn formats_are_checked_first() {
    let folder = folder();
    let run = |more: &[&str]| osculate(folder.path(), &[&["export", "missing.obj"], more].concat());
    run(&["-o", "out.dae"]).fails(2, "out.dae");
    run(&["-o", "out.obj", "--no-weld"]).fails(2, "--no-weld");
    run(&["-o", "out.ply", "--scheme", "table"]).fails(2, "table");
    run(&["-o", "out.ply"]).fails(3, "missing.obj");
}

#[test]
fn formats_too_coarse_for_the_place_are_pointed_out() {
    let folder = tempdir().unwrap();
    let far = "v 1e7 0 0\nv 10000001 0 0\nv 10000001 1 0\nv 1e7 1 0\nf 1 2 3 4\n";
    fs::write(folder.path().join("far.obj"), far).unwrap();
    let export = |output| osculate(folder.path(), &["export", "far.obj", "--level", "1", "-o", output]).exits(0).stderr;
    for coarse in ["a.ply", "a.stl"] {
        assert!(
            export(coarse).starts_with(&format!("warning: {coarse}: its 32-bit numbers are 1.0e0 apart")),
            "{coarse}"
        );
    }
    for fine in ["a.obj", "a.glb"] {
        assert_eq!(export(fine), "");
    }
}
