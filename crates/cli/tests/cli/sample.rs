//! `osculate sample`.

use crate::support::{CAGE, osculate};
use std::fs;
use tempfile::{TempDir, tempdir};

const HEADER: &str = "face,sub,s,t,px,py,pz,dux,duy,duz,dvx,dvy,dvz,nx,ny,nz,ev";

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some(HEADER));
    lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

const REFERENCE: [&str; 4] = ["sample", "cage.obj", "--evaluator", "reference"];

#[test]
fn rows_come_in_the_order_of_the_contract() {
    let folder = folder();
    let ran = osculate(folder.path(), &[&REFERENCE[..], &["--grid", "2", "--scheme", "stam"]].concat()).exits(0);
    let rows = rows(&ran.stdout);
    assert_eq!(rows.len(), 9 * (1 + 3 + 3));
    assert_eq!(rows[1][..4], [0.0, -1.0, 0.5, 0.0]);
    assert_eq!(rows[3][..4], [0.0, -1.0, 0.0, 0.5]);
    assert_eq!(rows[9][..4], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(rows[62][..4], [2.0, 2.0, 1.0, 1.0]);
    // A boundary vertex with one face is a fixed corner by default.
    assert_eq!(rows[0][4..7], [0.0, 0.0, 0.0]);
    for row in &rows {
        let length = row[13..16].iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn a_file_gets_what_stdout_would() {
    let folder = folder();
    let printed = osculate(folder.path(), &REFERENCE).exits(0).stdout;
    let ran = osculate(folder.path(), &[&REFERENCE[..], &["-o", "out.csv"]].concat()).exits(0);
    assert_eq!(ran.stdout, "");
    assert_eq!(fs::read_to_string(folder.path().join("out.csv")).unwrap(), printed);
}

#[test]
fn the_output_can_be_the_list_of_places() {
    let folder = folder();
    let arguments = [&REFERENCE[..], &["-o", "out.csv", "--grid", "3"]].concat();
    osculate(folder.path(), &arguments).exits(0);
    let again = osculate(folder.path(), &[&REFERENCE[..], &["--at", "out.csv"]].concat()).exits(0);
    assert_eq!(again.stdout, fs::read_to_string(folder.path().join("out.csv")).unwrap());
}

#[test]
fn lists_with_wrong_places_exit_with_3() {
    let folder = folder();
    fs::write(folder.path().join("points.csv"), "0,-1,0.5,0.5\n9,-1,0,0\n").unwrap();
    let run = |more: &[&str]| osculate(folder.path(), &[&REFERENCE[..], more].concat());
    run(&["--at", "points.csv"]).fails(3, "points.csv:2: there is no face 9; the faces are 0 to 2");
    for (place, part) in [("0,0,0,0", "sub must be -1, not 0"), ("1,3,0,0", "sub must be from 0 to 2, not 3")] {
        fs::write(folder.path().join("place.csv"), place).unwrap();
        run(&["--at", "place.csv"]).fails(3, part);
    }
    run(&["--grid", "-1"]).fails(2, "expected a whole number from 1");
    run(&["--at", "missing.csv"]).fails(3, "missing.csv");
    run(&["--at", "points.csv", "--grid", "3"]).fails(2, "--grid");
}

#[test]
fn a_failed_run_leaves_no_file() {
    let folder = folder();
    fs::write(folder.path().join("points.csv"), "9,-1,0,0\n").unwrap();
    osculate(folder.path(), &[&REFERENCE[..], &["--at", "points.csv", "-o", "out.csv"]].concat()).exits(3);
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["cage.obj", "points.csv"]);
    osculate(folder.path(), &[&REFERENCE[..], &["-o", "no/out.csv"]].concat()).fails(2, "its folder does not exist");
    let before = fs::read(folder.path().join("cage.obj")).unwrap();
    osculate(folder.path(), &[&REFERENCE[..], &["-o", "./cage.obj"]].concat()).fails(2, "is also the input");
    osculate(folder.path(), &[&REFERENCE[..], &["--at", "points.csv", "-o", "points.csv"]].concat())
        .fails(2, "is also the input");
    assert_eq!(fs::read(folder.path().join("cage.obj")).unwrap(), before);
}

#[test]
fn the_boundary_rule_is_the_option_else_the_files_tag() {
    let folder = folder();
    let tagged = format!("{CAGE}t interpolateboundary 1/0/0 2\n");
    fs::write(folder.path().join("tagged.obj"), tagged).unwrap();
    let sample = |file: &str, more: &[&str]| {
        let arguments = [&["sample", file, "--evaluator", "reference", "--grid", "1"], more].concat();
        osculate(folder.path(), &arguments).exits(0).stdout
    };
    let (sharp, smooth) = (sample("cage.obj", &[]), sample("cage.obj", &["--boundary", "edge-only"]));
    assert!(sharp != smooth);
    assert!(sample("cage.obj", &["--boundary", "edge-and-corner"]) == sharp);
    assert!(sample("tagged.obj", &[]) == smooth, "2 is edge-only");
    assert!(sample("tagged.obj", &["--boundary", "edge-and-corner"]) == sharp);
    // Every face of this cage touches the boundary.
    for evaluator in ["reference", "auto"] {
        let ran = osculate(folder.path(), &["sample", "cage.obj", "--evaluator", evaluator, "--boundary", "none"]);
        ran.fails(3, "cage.obj: no face is left to draw");
    }
}

#[test]
fn the_reference_knows_the_exact_scheme_only() {
    let folder = folder();
    let run = |scheme: &str| osculate(folder.path(), &[&REFERENCE[..], &["--scheme", scheme]].concat());
    run("gregory2").fails(2, "exact limit surface");
    run("nurbs").fails(2, "the schemes are");
    osculate(folder.path(), &[&REFERENCE[..], &["--grid", "0"]].concat()).fails(2, "--grid");
    osculate(folder.path(), &[&REFERENCE[..], &["--boundary", "sharp"]].concat()).fails(2, "--boundary");
}

#[test]
fn the_device_agrees_with_the_reference_where_the_surface_is_bicubic() {
    // A torus-like ring of regular quads, 4 x 4, is bicubic everywhere.
    let folder = tempdir().unwrap();
    let corner = |i: usize, j: usize| 1 + (i % 4) * 4 + j % 4;
    let turn = |k: usize| (std::f64::consts::TAU * k as f64 / 4.0).sin_cos();
    let mut ring = String::new();
    for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
        let ((s, c), (t, d)) = (turn(i), turn(j));
        ring += &format!("v {} {} {}\n", (3.0 + d) * c, (3.0 + d) * s, t);
    }
    for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
        let face = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        ring += &format!("f {} {} {} {}\n", face[0], face[1], face[2], face[3]);
    }
    fs::write(folder.path().join("ring.obj"), ring).unwrap();
    let sample = |evaluator: &str| {
        let ran = osculate(folder.path(), &["sample", "ring.obj", "--evaluator", evaluator]).exits(0);
        assert_eq!(ran.stderr, "");
        rows(&ran.stdout)
    };
    let (device, exact) = (sample("auto"), sample("reference"));
    assert_eq!(device.len(), 16 * 25);
    assert_eq!(sample("compute"), device);
    for (found, expected) in device.iter().zip(&exact) {
        assert_eq!((&found[..4], found[16]), (&expected[..4], expected[16]));
        for (a, b) in found[4..16].iter().zip(&expected[4..16]) {
            assert!((a - b).abs() < 1e-5, "{found:?}\n{expected:?}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_run_leaves_no_file() {
    use crate::support::{interruptible, send};
    use std::os::unix::process::ExitStatusExt;
    use std::time::{Duration, Instant};
    for (name, number) in [("INT", 2), ("TERM", 15), ("HUP", 1)] {
        let folder = folder();
        let names = || fs::read_dir(folder.path()).unwrap().count();
        let arguments = [&REFERENCE[..], &["--grid", "20000", "-o", "out.csv"]].concat();
        let mut child = interruptible(folder.path(), &arguments).spawn().unwrap();
        let start = Instant::now();
        while names() < 2 {
            assert!(start.elapsed() < Duration::from_secs(60), "nothing was begun");
            std::thread::sleep(Duration::from_millis(5));
        }
        send(name, &child);
        assert_eq!(child.wait().unwrap().signal(), Some(number), "SIG{name}");
        assert_eq!(names(), 1, "SIG{name}");
    }
}
