//! `osculate bench`: what it prints and writes, never how long anything takes.

use crate::support::{CAGE, osculate};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

/// Few and small frames.
const QUICK: [&str; 8] = ["--frames", "4", "--rounds", "2", "--size", "64x48", "--levels", "2"];

fn bench(folder: &Path, arguments: &[&str]) -> crate::support::Ran {
    osculate(folder, &[&["bench", "cage.obj"], &QUICK[..], arguments].concat())
}

fn objects(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_json_object_per_configuration() {
    let folder = folder();
    let ran = bench(folder.path(), &["--schemes", "gregory2,stam", "--animate", "--limit"]).exits(0);
    let rows = objects(&ran.stdout);
    assert_eq!(rows.len(), 4);
    for (row, (scheme, evaluator)) in rows.iter().zip([
        ("gregory2", "tessellator"),
        ("gregory2", "compute"),
        ("stam", "tessellator"),
        ("stam", "compute"),
    ]) {
        assert_eq!(
            (&row["cage"], &row["scheme"], &row["evaluator"]),
            (&"cage".into(), &scheme.into(), &evaluator.into())
        );
        assert_eq!((&row["level"], &row["animated"], &row["size"]), (&2.0.into(), &true.into(), &"64x48".into()));
        // 40 patches of 8 triangles.
        assert_eq!((&row["patches"], &row["triangles"]), (&40.into(), &320.into()));
        let ms = |name: &str| row["frame_ms"][name].as_f64().unwrap();
        assert!(0.0 < ms("min") && ms("min") <= ms("median") && ms("median") <= ms("p95") && ms("p95") <= ms("max"));
        assert!(ms("min") <= ms("mean") && ms("mean") <= ms("max"));
        assert_eq!(row["frames"], 4);
        assert_eq!(row["rounds_ms"].as_array().unwrap().len(), 2);
        assert!(row["first_frame_ms"].as_f64().unwrap() > 0.0);
        assert!(row["to_limit"]["low"].as_f64().unwrap() <= row["to_limit"]["high"].as_f64().unwrap());
        // Six points of three floats.
        assert_eq!(row["work"]["bytes_uploaded"], 6 * 12);
        assert!(["device", "driver", "revision"].iter().all(|key| !row[*key].as_str().unwrap().is_empty()));
    }
    assert_eq!(rows[0]["to_first"]["median"], 1.0);
    assert!(rows[0]["vertices"].is_null() && rows[1]["vertices"].as_u64().unwrap() > 0);
    assert!(rows[1]["work"]["dispatches"].as_u64() > rows[0]["work"]["dispatches"].as_u64());
}

#[test]
fn what_rests_is_not_computed_again() {
    let ran = bench(folder().path(), &["--evaluator", "compute"]).exits(0);
    let row = &objects(&ran.stdout)[0];
    assert_eq!((&row["work"]["dispatches"], &row["work"]["bytes_uploaded"]), (&0.into(), &0.into()));
    assert!(row.get("to_limit").is_none());
}

#[test]
fn files_hold_the_results_and_stdout_a_table() {
    let folder = folder();
    let arguments = ["torus:50", "--json", "now.json", "--csv", "now.csv", "--plot", "now.svg"];
    let ran = bench(folder.path(), &arguments).exits(0);
    let lines: Vec<&str> = ran.stdout.lines().collect();
    assert!(lines[0].starts_with("cage") && lines.len() == 5, "{}", ran.stdout);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let rows = objects(&read("now.json"));
    assert_eq!(
        rows.iter().map(|row| row["cage"].as_str().unwrap()).collect::<Vec<_>>(),
        ["cage", "cage", "torus:50", "torus:50"]
    );
    let csv = read("now.csv");
    assert!(csv.starts_with("cage,faces,scheme,refine,level,evaluator,animated,") && csv.lines().count() == 5, "{csv}");
    assert_eq!(read("now.svg").matches("tessellator").count(), 2);
}

#[test]
fn an_earlier_run_is_compared_with() {
    let folder = folder();
    let file = folder.path().join("old.json");
    bench(folder.path(), &["--evaluator", "compute", "--json", "old.json"]).exits(0);
    // Whatever it is compared with took a thousand times as long, or no time.
    let mut old: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    let mut compared = |rounds: f64| {
        old["rounds_ms"] = vec![rounds; 2].into();
        fs::write(&file, old.to_string()).unwrap();
        bench(folder.path(), &["--evaluator", "compute", "--compare", "old.json"])
    };
    let faster = compared(1e6).exits(0);
    assert!(faster.stderr.contains(": faster"), "{}", faster.stderr);
    let slower = compared(1e-6).exits(1);
    assert!(slower.stderr.contains("cage gregory2 level 2 compute") && slower.stderr.contains(": SLOWER"));
    assert_eq!(objects(&slower.stdout).len(), 1);
}

#[test]
fn table_1_times_subdivision() {
    let ran = bench(folder().path(), &["--table1"]).exits(0);
    let table = &objects(&ran.stdout)[0];
    assert_eq!((&table["table"], &table["steps"], &table["faces"]), (&1.into(), &2.into(), &3.into()));
    assert!(table["difference_ms"].is_number() && table["subdivide_ms"].is_number() && table["records_ms"].is_number());
    let names: Vec<&str> =
        table["passes"].as_array().unwrap().iter().map(|pass| pass["name"].as_str().unwrap()).collect();
    let subdivision = ["subdivide/face.comp", "subdivide/edge.comp", "subdivide/vertex.comp"];
    assert_eq!(names[1..4], subdivision, "{names:?}");
    assert!(names.contains(&"records/edge_regular.comp"));
}

#[test]
fn figure_5_is_all_schemes_by_the_tessellator() {
    let folder = folder();
    let arguments = ["bench", "cage.obj", "--figure5", "five.svg", "--frames", "1", "--rounds", "1", "--size", "16x16"];
    let ran = osculate(folder.path(), &[&arguments[..], &["--levels", "1,2"]].concat()).exits(0);
    let rows = objects(&ran.stdout);
    assert_eq!(rows.len(), 8);
    assert!(rows.iter().all(|row| row["evaluator"] == "tessellator" && row["animated"] == false));
    let figure = fs::read_to_string(folder.path().join("five.svg")).unwrap();
    assert!(["gregory1", "gregory2", "stam", "biseptic"].iter().all(|scheme| figure.contains(scheme)));
}

#[test]
fn mistakes_are_found_before_anything_is_measured() {
    let folder = folder();
    bench(folder.path(), &["--plot", "plot.png"]).fails(2, "plot.png");
    bench(folder.path(), &["--json", "no/such/folder.json"]).fails(2, "no/such/folder.json");
    bench(folder.path(), &["--schemes", "nurbs"]).fails(2, "nurbs");
    bench(folder.path(), &["--compare", "missing.json"]).fails(3, "missing.json");
    bench(folder.path(), &["--table1", "--animate"]).fails(2, "--table1");
    bench(folder.path(), &["--samples", "3"]).fails(4, "3 samples");
    fs::write(folder.path().join("broken.json"), "{}\n").unwrap();
    bench(folder.path(), &["--compare", "broken.json"]).fails(3, "broken.json:1: ");
    osculate(folder.path(), &["bench", "torus:3"]).fails(2, "torus:3");
    osculate(folder.path(), &["bench", "missing.obj"]).fails(3, "missing.obj");
}

/// The first interruption ends the measuring, not the command: what was measured is kept.
#[cfg(target_os = "linux")]
#[test]
fn an_interruption_keeps_what_was_measured() {
    use crate::support::{interruptible, send};
    use std::os::unix::process::ExitStatusExt;
    use std::time::{Duration, Instant};
    let folder = folder();
    let arguments = ["bench", "cage.obj", "--levels", "1,2", "--size", "16x16", "--evaluator", "compute"];
    // A round each second, for two days; the folder shows when the first level is done.
    let endless = ["--frames", "100000000", "--rounds", "2", "--max-seconds", "2", "--json", "now.json"];
    let mut child = interruptible(folder.path(), &[&arguments[..], &endless].concat()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(3500));
    send("INT", &child);
    let start = Instant::now();
    let status = child.wait().unwrap();
    assert!(start.elapsed() < Duration::from_secs(60));
    // Where the machine is slow it may not have come to a result; where it is quick, to the end.
    match fs::read_to_string(folder.path().join("now.json")) {
        Ok(text) => assert!(!objects(&text).is_empty()),
        Err(_) => assert_ne!(status.code(), Some(0)),
    }
    assert!(status.signal() == Some(2) || status.code() == Some(2) || status.success(), "{status}");
}

/// The same triangles of a fourth as many patches.
#[test]
fn both_ways_to_refine_are_measured_in_turn() {
    let folder = folder();
    let arguments = [&["bench", "torus:48", "--evaluator", "tessellator", "--refine", "everywhere,needed"], &QUICK[..]];
    let rows = objects(&osculate(folder.path(), &arguments.concat()).exits(0).stdout);
    let of = |row: &Value| (row["refine"].as_str().unwrap().to_owned(), row["patches"].as_u64().unwrap());
    let faces = rows[0]["faces"].as_u64().unwrap();
    assert_eq!(rows.iter().map(of).collect::<Vec<_>>(), [("everywhere".into(), 4 * faces), ("needed".into(), faces)]);
    assert_eq!(rows[0]["triangles"], rows[1]["triangles"]);
}
