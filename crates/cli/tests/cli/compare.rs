//! `osculate compare`.

use crate::support::osculate;
use osculate_compare::{Picture, load};
use std::path::Path;
use tempfile::{TempDir, tempdir};

fn write(path: &Path, grey: u8, width: u32) {
    Picture::new(width, 16, [grey, grey, grey, 255].repeat(16 * width as usize)).unwrap().write(path).unwrap();
}

/// `a.png` and `same.png` are equal, `b.png` is darker, `wide.png` wider.
fn pictures() -> TempDir {
    let folder = tempdir().unwrap();
    for (name, grey, width) in [("a", 128, 16), ("same", 128, 16), ("b", 100, 16), ("wide", 128, 17)] {
        write(&folder.path().join(format!("{name}.png")), grey, width);
    }
    folder
}

#[test]
fn equal_pictures_exit_with_0() {
    let folder = pictures();
    let ran = osculate(folder.path(), &["compare", "a.png", "same.png", "--mean", "0", "--p99", "0"]).exits(0);
    assert_eq!((ran.stdout.lines().count(), ran.stderr.as_str()), (1, ""));
    assert!(ran.stdout.starts_with("same: FLIP mean 0.000000"), "{}", ran.stdout);
}

#[test]
fn different_pictures_exit_with_1_and_show_where() {
    let folder = pictures();
    let ran = osculate(folder.path(), &["compare", "a.png", "b.png", "-o", "diff.png"]).exits(1);
    assert!(ran.stdout.starts_with("different: FLIP mean 0."), "{}", ran.stdout);
    let diff = load(&folder.path().join("diff.png")).unwrap();
    assert_eq!(diff.size().to_string(), "16x16");
    osculate(folder.path(), &["compare", "a.png", "b.png", "--mean", "1", "--p99", "1"]).exits(0);
    osculate(folder.path(), &["compare", "a.png", "b.png", "--mean", "1"]).exits(1);
    osculate(folder.path(), &["compare", "a.png", "b.png", "--p99", "1"]).exits(1);
}

#[test]
fn pictures_of_other_sizes_are_different() {
    let folder = pictures();
    let ran = osculate(folder.path(), &["compare", "a.png", "wide.png", "--mean", "1", "--p99", "1"]).exits(1);
    assert!(ran.stdout.contains("16x16 and 17x16"), "{}", ran.stdout);
}

#[test]
fn figures_as_json() {
    let folder = pictures();
    for (other, same, code) in [("same.png", true, 0), ("b.png", false, 1), ("wide.png", false, 1)] {
        let ran = osculate(folder.path(), &["compare", "a.png", other, "--json"]).exits(code);
        let json: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
        assert_eq!(json["same"], same, "{other}: {json}");
        assert_eq!(json["mean_limit"], 0.002, "{other}: {json}");
        let compared = other != "wide.png";
        assert_eq!(json.get("reason").is_none(), compared, "{other}: {json}");
        for figure in ["mean", "p99", "max", "alpha"] {
            assert_eq!(json.get(figure).map(serde_json::Value::is_number), Some(compared), "{other}: {json}");
        }
    }
}

#[test]
fn files_that_are_not_pictures_exit_with_3() {
    let folder = pictures();
    std::fs::write(folder.path().join("text.png"), "text").unwrap();
    osculate(folder.path(), &["compare", "a.png", "missing.png"]).fails(3, "missing.png");
    osculate(folder.path(), &["compare", "text.png", "a.png"]).fails(3, "text.png");
}

#[test]
fn limits_and_places_are_checked_before_anything_is_read() {
    let folder = pictures();
    let run = |more: &[&str]| osculate(folder.path(), &[&["compare", "missing.png", "missing.png"], more].concat());
    run(&["--mean", "2"]).fails(2, "--mean");
    run(&["--p99", "nan"]).fails(2, "--p99");
    run(&["--p99", "little"]).fails(2, "--p99");
    run(&["--mean", "-0.1"]).fails(2, "FLIP values are from 0 to 1");
    run(&["-o", "diff.jpg"]).fails(2, "diff.jpg");
    run(&["-o", "no/diff.png"]).fails(2, "no/diff.png");
}

#[test]
fn a_difference_of_alpha_is_named_and_inputs_are_kept() {
    let folder = pictures();
    let clear = Picture::new(16, 16, [128, 128, 128, 0].repeat(256)).unwrap();
    clear.write(&folder.path().join("clear.png")).unwrap();
    let ran = osculate(folder.path(), &["compare", "a.png", "clear.png"]).exits(1);
    assert!(ran.stdout.contains("255/255 (alpha differs)"), "{}", ran.stdout);
    osculate(folder.path(), &["compare", "a.png", "b.png", "-o", "b.png"]).fails(2, "is also the input");
}
