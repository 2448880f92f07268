//! Cages that are worked at in parts: what comes of it is what it is of the whole.

use crate::support::{CAGE, osculate};
use std::fs;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

/// The file that a command writes, of the whole and in parts of one face.
fn both(name: &str, arguments: &[&str]) -> [Vec<u8>; 2] {
    [&[][..], &["--part-faces", "1"]].map(|parts| {
        let folder = folder();
        let ran = osculate(folder.path(), &[arguments, &["-o", name], parts].concat()).exits(0);
        assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("", ""));
        fs::read(folder.path().join(name)).unwrap()
    })
}

#[test]
fn pictures_are_the_same() {
    for evaluator in ["tessellator", "compute"] {
        let [whole, parts] =
            both("out.png", &["render", "cage.obj", "--size", "64x48", "--cage", "--evaluator", evaluator]);
        assert!(whole == parts, "{evaluator}");
    }
}

/// The triangles, and with them the vertices, come in another order.
#[test]
fn exports_have_the_same_vertices() {
    let [whole, parts] = both("out.ply", &["export", "cage.obj", "--level", "2", "--no-weld"]);
    assert_eq!(whole.len(), parts.len());
    let vertices = both("out.obj", &["export", "cage.obj", "--level", "2"]).map(|file| {
        let text = String::from_utf8(file).unwrap();
        let mut lines: Vec<String> = text.lines().filter(|line| line.starts_with('v')).map(str::to_owned).collect();
        lines.sort();
        lines
    });
    assert!(vertices[0].len() > 100 && vertices[0] == vertices[1]);
}

#[test]
fn proofs_say_the_same() {
    let folder = folder();
    let prove = |more: &[&str]| {
        let arguments = [&["check", "cage.obj", "--levels", "1,2.5", "--spacing", "even"], more].concat();
        osculate(folder.path(), &arguments).exits(0).stdout
    };
    assert_eq!(prove(&[]), prove(&["--part-faces", "2"]));
}

#[test]
fn what_needs_the_whole_says_so() {
    let folder = folder();
    let arguments = ["render", "cage.obj", "-o", "out.png", "--shade", "difference", "--part-faces", "1"];
    osculate(folder.path(), &arguments).fails(2, "3 parts");
    osculate(folder.path(), &["check", "cage.obj", "--part-faces", "0"]).fails(2, "part-faces");
}

/// A name that is no file's.
#[test]
fn tori_are_made() {
    let folder = folder();
    let ran = osculate(folder.path(), &["check", "torus:200", "--schemes", "stam", "--levels", "1"]).exits(0);
    assert!(ran.stdout.contains(" 1600 triangles") && ran.stdout.contains("watertight"), "{}", ran.stdout);
    osculate(folder.path(), &["check", "torus:2"]).fails(2, "torus:2");
}
