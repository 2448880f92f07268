//! `osculate check`.

use crate::support::{CAGE, osculate};
use serde_json::Value;
use std::fs;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

#[test]
fn a_line_per_scheme_and_level() {
    let ran = osculate(folder().path(), &["check", "cage.obj"]).exits(0);
    assert_eq!(ran.stderr, "");
    let lines: Vec<&str> = ran.stdout.lines().filter(|line| line.starts_with("gregory2")).collect();
    assert_eq!(lines.len(), 3, "{}", ran.stdout);
    assert!(
        ["stam", "biseptic"].iter().all(|scheme| ran.stdout.contains(&format!("\n{scheme} level 1 "))),
        "{}",
        ran.stdout
    );
    // 40 patches of 2 L^2 triangles.
    assert!(lines[0].starts_with("gregory2 level 1 equal: 80 triangles, 0 open, 0 over_shared,"), "{}", lines[0]);
    assert!(lines[2].contains("5120 triangles") && lines[2].ends_with(": watertight"), "{}", lines[2]);
}

#[test]
fn both_evaluators_are_proven() {
    let folder = folder();
    let lines = |evaluator| {
        let arguments = [
            "check",
            "cage.obj",
            "--schemes",
            "gregory2",
            "--levels",
            "1,3.5",
            "--spacing",
            "even",
            "--evaluator",
            evaluator,
        ];
        osculate(folder.path(), &arguments).exits(0).stdout
    };
    let (tessellator, compute) = (lines("tessellator"), lines("compute"));
    assert_eq!(compute.matches(": watertight").count(), 2, "{compute}");
    // 40 patches of 2 x 2 and 4 x 4 cells.
    assert!(compute.contains("320 triangles") && compute.contains("1280 triangles"), "{compute}");
    assert!(tessellator.contains("320 triangles"), "{tessellator}");
}

#[test]
fn an_object_per_scheme_and_level() {
    let arguments =
        ["check", "cage.obj", "--json", "--schemes", "stam,gregory2,stam", "--levels", "2.5,5.3", "--spacing", "odd"];
    let ran = osculate(folder().path(), &arguments).exits(0);
    let reports: Vec<Value> = ran.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let cases = reports.iter().map(|report| (report["scheme"].as_str().unwrap(), report["level"].as_f64().unwrap()));
    assert_eq!(cases.collect::<Vec<_>>(), [("stam", 2.5), ("stam", 5.3), ("gregory2", 2.5), ("gregory2", 5.3)]);
    for report in &reports {
        assert!(report["triangles"].as_u64().unwrap() > 0);
        for key in ["open", "over_shared", "split_normals", "inverted", "wrong_patches"] {
            assert_eq!(report[key], 0, "{key}");
        }
        assert_eq!(report["weld"]["open"], 0);
    }
}

#[test]
fn adaptive_factors_are_proved_along_a_turn() {
    let folder = folder();
    let arguments =
        ["check", "cage.obj", "--schemes", "stam", "--adaptive", "6", "--spacing", "odd", "--json", "--orbit"];
    let ran = osculate(folder.path(), &[&arguments[..], &["3"]].concat()).exits(0);
    let reports: Vec<Value> = ran.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let views: Vec<&Value> = reports.iter().map(|report| &report["view"]).collect();
    assert_eq!(views, [0, 1, 2]);
    assert!(reports.iter().all(|report| report["open"] == 0 && report["watertight"] == true), "{}", ran.stdout);
    assert_ne!(reports[0]["triangles"], reports[1]["triangles"], "the second view is nearer");
    osculate(folder.path(), &[&arguments[..], &["0"]].concat()).fails(2, "--orbit");
    osculate(folder.path(), &["check", "cage.obj", "--orbit", "3"]).fails(2, "--adaptive");
}

#[test]
fn adaptive_factors_are_proved_at_the_camera() {
    let near = [
        "check",
        "cage.obj",
        "--json",
        "--schemes",
        "biseptic",
        "--adaptive",
        "6",
        "--camera",
        "0.5,0.5,1:0.5,0.5,0:0,1,0:45",
    ];
    let far = [
        "check",
        "cage.obj",
        "--json",
        "--schemes",
        "biseptic",
        "--adaptive",
        "6",
        "--camera",
        "0.5,0.5,20:0.5,0.5,0:0,1,0:45",
    ];
    let triangles = |arguments: &[&str]| {
        let ran = osculate(folder().path(), arguments).exits(0);
        let report: Value = serde_json::from_str(&ran.stdout).unwrap();
        assert_eq!(report["adaptive"], 6.0);
        report["triangles"].as_u64().unwrap()
    };
    assert!(triangles(&near) > 4 * triangles(&far));
}

#[test]
fn schemes_and_levels_are_checked_first() {
    let folder = folder();
    let run = |more: &[&str]| osculate(folder.path(), &[&["check", "missing.obj"], more].concat());
    run(&["--levels", "1,99"]).fails(2, "--levels");
    run(&["--levels", ""]).fails(2, "--levels");
    run(&["--schemes", "gregory2,table"]).fails(2, "table");
    run(&["--adaptive", "0"]).fails(2, "--adaptive");
    run(&[]).fails(3, "missing.obj");
}

#[test]
fn what_is_refined_where_needed_is_proved_and_does_not_go_with_everything() {
    let folder = folder();
    let run = |arguments: &[&str]| {
        osculate(folder.path(), &[&["check", "torus:48", "--refine", "needed"], arguments].concat())
    };
    let ran = run(&["--schemes", "gregory2", "--levels", "3"]).exits(0);
    assert!(ran.stdout.contains("watertight"), "{}", ran.stdout);
    run(&["--schemes", "gregory2", "--spacing", "odd"]).fails(2, "--refine");
    run(&["--schemes", "gregory2", "--levels", "33"]).fails(2, "--refine");
    run(&["--schemes", "gregory2", "--part-faces", "20"]).fails(2, "--refine");
    run(&["--schemes", "gregory1", "--part-faces", "20", "--levels", "2"]).exits(0);
}
