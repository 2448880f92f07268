//! `osculate repair`, and the options with which cages are read.

use crate::support::osculate;
use serde_json::{Value, json};
use std::fs;
use tempfile::{TempDir, tempdir};

/// Two triangles that touch in one vertex, a copy of the first, a quad that nothing joins, and a material.
const DIRTY: &str = "\
v 0 0 0
v 1 0 0
v 0 1 0
v -1 0 0
v 0 -1 0
v 1 0 0
v 2 0 0
v 1 1 0
v 0 1 0
usemtl red
f 1 2 3
f 1 4 5
f 2 3 1
f 6 7 8 9
t crease 2/1/0 0 1 2
";

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("dirty.obj"), DIRTY).unwrap();
    folder
}

fn inspect(folder: &TempDir, arguments: &[&str]) -> Value {
    let ran = osculate(folder.path(), &[&["inspect", "--json"], arguments].concat()).exits(0);
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn the_result_is_written_and_told() {
    let folder = folder();
    osculate(folder.path(), &["inspect", "dirty.obj"]).fails(3, "dirty.obj:13: inconsistent winding");
    let ran = osculate(folder.path(), &["repair", "dirty.obj", "-o", "fixed.obj"]).exits(0);
    assert_eq!(ran.stdout, "");
    let told = "warning: dirty.obj: repaired: 1 copied face dropped: 2; 1 vertex split: 0; \
        2 vertices welded to another at its place: 5, 8\n";
    assert!(ran.stderr.starts_with(told), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path().join("fixed.obj")).unwrap();
    assert!(text.contains("usemtl red\nf 1 2 3\nf 8 4 5\nf 2 6 7 3\n"), "{text}");
    assert!(text.ends_with("t crease 2/1/0 0 1 2.0\n"), "{text}");
    let again = osculate(folder.path(), &["repair", "fixed.obj", "-o", "again.obj", "-q"]).exits(0);
    assert_eq!(again.stderr, "");
    assert_eq!(fs::read_to_string(folder.path().join("again.obj")).unwrap(), text);
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let folder = folder();
    osculate(folder.path(), &["repair", "dirty.obj", "-o", "fixed.ply"]).fails(2, "fixed.ply");
    osculate(folder.path(), &["repair", "dirty.obj", "-o", "dirty.obj"]).fails(2, "also the input");
    fs::write(folder.path().join("bad.obj"), "v 0 0 0\nf 1 1 1\n").unwrap();
    osculate(folder.path(), &["repair", "bad.obj", "-o", "fixed.obj"]).fails(3, "no faces");
    assert!(!folder.path().join("fixed.obj").exists());
}

#[test]
fn every_command_can_repair_and_counts_faces_as_the_file_does() {
    let folder = folder();
    let sample = ["sample", "dirty.obj", "--repair", "--evaluator", "reference", "--grid", "1", "-o", "points.csv"];
    let ran = osculate(folder.path(), &sample).exits(0);
    assert!(ran.stderr.contains("repaired: 1 copied face dropped: 2"), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path().join("points.csv")).unwrap();
    let faces: Vec<&str> = text.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert!(faces.contains(&"1") && !faces.contains(&"2") && faces.contains(&"3"), "{text}");
    // What was written can be asked for again.
    let list = ["sample", "dirty.obj", "--repair", "--evaluator", "reference", "--at", "points.csv", "-q"];
    assert_eq!(osculate(folder.path(), &list).exits(0).stdout, text);
    fs::write(folder.path().join("dropped.csv"), "2,0,0,0\n").unwrap();
    let dropped = [&list[..6], &["dropped.csv", "-q"]].concat();
    osculate(folder.path(), &dropped).fails(3, "there is no face 2; the repair dropped it");
}

#[test]
fn distances_are_for_repairs() {
    let folder = folder();
    let gap = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.01 0 0\nv 1 1 0\nv 0 1.01 0\nf 1 2 3\nf 4 5 6\n";
    fs::write(folder.path().join("gap.obj"), gap).unwrap();
    assert_eq!(inspect(&folder, &["gap.obj", "--repair"])["vertices"], 6);
    assert_eq!(inspect(&folder, &["gap.obj", "--repair", "--weld", "0.1"])["vertices"], 4);
    osculate(folder.path(), &["inspect", "gap.obj", "--weld", "0.1"]).fails(2, "--weld");
    osculate(folder.path(), &["inspect", "gap.obj", "--repair", "--weld", "nan"]).fails(2, "--weld");
}

#[test]
fn creases_are_made_and_written() {
    let folder = folder();
    let cube = "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n\
        f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nusemtl lid\nf 2 8 6 4\nf 7 1 3 5\n";
    fs::write(folder.path().join("cube.obj"), cube).unwrap();
    assert_eq!(inspect(&folder, &["cube.obj", "--crease-from", "angle=89"])["creases"], 12);
    assert_eq!(inspect(&folder, &["cube.obj", "--crease-from", "angle=91,materials"])["creases"], 8);
    let options = ["--crease-from", "materials", "--crease-sharpness", "1.5"];
    let repair = [&["repair", "cube.obj", "-o", "creased.obj"], &options[..]].concat();
    let ran = osculate(folder.path(), &repair).exits(0);
    assert!(ran.stderr.contains("8 creases made"), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path().join("creased.obj")).unwrap();
    assert_eq!(text.lines().filter(|l| l.starts_with("t crease 2/1/0 ") && l.ends_with(" 1.5")).count(), 8);
    osculate(folder.path(), &["inspect", "cube.obj", "--crease-from", "edges"]).fails(2, "edges");
    osculate(folder.path(), &["inspect", "cube.obj", "--crease-sharpness=-1"]).fails(2, "sharpness");
}

#[test]
fn limits_are_named_with_their_options() {
    let folder = folder();
    for (option, value, message) in [
        ("--max-file-size", "100", "larger than the limit of 100 bytes"),
        ("--max-faces", "2", "more faces than the limit of 2"),
        ("--max-memory", "1k", "more memory than the limit of 1024 bytes"),
    ] {
        let ran = osculate(folder.path(), &["inspect", "dirty.obj", option, value]).fails(3, message);
        assert!(ran.stderr.contains(&format!("hint: {option} raises the limit")), "{}", ran.stderr);
    }
    osculate(folder.path(), &["inspect", "dirty.obj", "--max-memory", "1.5G"]).fails(2, "1.5G");
}

#[test]
fn other_formats_are_read() {
    let folder = folder();
    fs::write(folder.path().join("a.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap();
    assert_eq!(inspect(&folder, &["a.off"])["faces"], 1);
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    fs::write(folder.path().join("a.ply"), ply).unwrap();
    assert_eq!(inspect(&folder, &["a.ply"])["vertices"], 3);
    osculate(folder.path(), &["repair", "a.ply", "-o", "a.obj"]).exits(0);
    assert_eq!(inspect(&folder, &["a.obj"])["faces_by_size"], json!({ "3": 1 }));
}

#[test]
fn advice_has_hints() {
    let folder = folder();
    let thin = "v 0 0 0\nv 1000 0 0\nv 1000 1 0\nv 0 1 0\nf 1 2 3 4\n";
    fs::write(folder.path().join("thin.obj"), thin).unwrap();
    let found = inspect(&folder, &["thin.obj"]);
    assert_eq!((&found["advice"][0]["kind"], &found["advice"][0]["faces"]), (&json!("thin"), &json!([0])));
    let text = osculate(folder.path(), &["inspect", "thin.obj"]).exits(0).stdout;
    assert!(text.contains("\n  hint           cut the faces across"), "{text}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_read_leaves_no_file() {
    use crate::support::{interruptible, send};
    use std::io::Write;
    use std::os::unix::process::ExitStatusExt;
    use std::process::Stdio;
    use std::time::Duration;
    let folder = folder();
    let mut child =
        interruptible(folder.path(), &["repair", "/dev/stdin", "-o", "out.obj"]).stdin(Stdio::piped()).spawn().unwrap();
    // A file whose end does not come.
    let mut file = child.stdin.take().unwrap();
    file.write_all(b"OFF\n4 1 4\n0 0 0\n").unwrap();
    std::thread::sleep(Duration::from_millis(50));
    assert!(child.try_wait().unwrap().is_none(), "it waits for the rest");
    send("INT", &child);
    assert_eq!(child.wait().unwrap().signal(), Some(2));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
