//! `osculate inspect`.

use crate::support::{CAGE, osculate};
use serde_json::{Value, json};
use std::fs;
use tempfile::tempdir;

fn inspect(cage: &str, more: &[&str]) -> Value {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), cage).unwrap();
    let ran = osculate(folder.path(), &[&["inspect", "cage.obj", "--json"], more].concat()).exits(0);
    assert_eq!(ran.stderr, "", "what was odd is part of the result");
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn json_has_the_keys_of_the_contract() {
    let found = inspect(CAGE, &[]);
    for (key, value) in [
        ("vertices", json!(6)),
        ("faces", json!(3)),
        ("faces_by_size", json!({ "3": 2, "4": 1 })),
        ("valence", json!({ "2": 3, "3": 2, "4": 1 })),
        ("boundary_valence", json!({ "2": 3, "3": 2, "4": 1 })),
        ("boundary_edges", json!(6)),
        ("components", json!(1)),
        ("genus", json!(0)),
        ("euler", json!(1)),
        ("creases", json!(0)),
        ("corners", json!(0)),
        ("holes", json!(0)),
        ("boundary_rule", json!("edge-and-corner")),
        ("problems", json!([])),
    ] {
        assert_eq!(found[key], value, "{key}");
    }
    let scheme = &found["schemes"]["gregory2"];
    assert_eq!(scheme["steps"], 2);
    assert_eq!(scheme["patches"], 4 * (4 + 3 + 3));
    let kinds = scheme["by_kind"].as_object().unwrap();
    assert_eq!(kinds.values().map(|count| count.as_u64().unwrap()).sum::<u64>(), 40);
    assert!(scheme["bytes"].as_u64().unwrap() > 0);
}

#[test]
fn a_cage_that_cannot_be_drawn_is_still_readable() {
    let found = inspect(CAGE, &["--boundary", "none"]);
    assert_eq!(found["schemes"], json!({}));
    assert!(found["not_drawn"].as_str().unwrap().contains("no face is left"), "{found}");
}

#[test]
fn problems_are_listed_in_both_forms() {
    let odd = format!("{CAGE}v 9 9 9\n");
    let found = inspect(&odd, &[]);
    assert!(found["problems"][0].as_str().unwrap().contains("unused"), "{found}");
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), odd).unwrap();
    let text = osculate(folder.path(), &["inspect", "cage.obj"]).exits(0).stdout;
    for part in [
        "vertices         6\n",
        "face sizes       3 (x2), 4 (x1)\n",
        "valences         2 (x3), 3 (x2), 4 (x1)\n",
        "gregory2 ",
        "unused",
    ] {
        assert!(text.contains(part), "{part:?} in {text}");
    }
}

#[test]
fn what_is_not_a_cage_exits_with_3() {
    let folder = tempdir().unwrap();
    fs::write(
        folder.path().join("fin.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 1 2 4\nf 2 1 5\n",
    )
    .unwrap();
    osculate(folder.path(), &["inspect", "fin.obj", "--json"]).fails(3, "fin.obj");
}

#[test]
fn frames_are_counted() {
    let folder = tempdir().unwrap();
    let moved = |height: usize| CAGE.replacen("v 0 0 0", &format!("v 0 0 {height}"), 1);
    for frame in 9..12 {
        fs::write(folder.path().join(format!("walk_{frame:04}.obj")), moved(frame)).unwrap();
    }
    let found = osculate(folder.path(), &["inspect", "walk_####.obj", "--json"]).exits(0).stdout;
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(found["frames"], json!({ "count": 3, "first": 9.0 / 24.0, "last": 11.0 / 24.0 }));
    assert_eq!((&found["faces"], &inspect(CAGE, &[])["frames"]["count"]), (&json!(3), &json!(1)));
    let text = osculate(folder.path(), &["inspect", "walk_%04d.obj"]).exits(0).stdout;
    assert!(text.contains("frames           3, from 0.375 s to "), "{text}");
    fs::remove_file(folder.path().join("walk_0010.obj")).unwrap();
    osculate(folder.path(), &["inspect", "walk_####.obj"]).fails(3, "walk_0010.obj: frame 10 is missing");
}
