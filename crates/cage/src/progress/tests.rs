use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use super::*;
use crate::{Cage, CreaseDesc, ReadDesc, ReadError, RepairDesc};

/// All that can be asked for while a file is read.
fn everything(observer: ReadObserver) -> ReadDesc {
    ReadDesc {
        repair: Some(RepairDesc::default()),
        creases: Some(CreaseDesc { angle: Some(30.0), ..CreaseDesc::default() }),
        observer: Some(observer),
        ..ReadDesc::default()
    }
}

/// The calls while a file is read, which must succeed.
fn calls(path: &Path) -> Vec<ReadProgress> {
    let calls = Arc::new(Mutex::new(Vec::new()));
    let heard = calls.clone();
    let observer = ReadObserver::new(move |progress| {
        heard.lock().expect("no panic").push(progress);
        ControlFlow::Continue(())
    });
    Cage::read_with(path, &everything(observer)).unwrap_or_else(|error| panic!("{error}"));
    std::mem::take(&mut *calls.lock().expect("no panic"))
}

/// Reads a file with an observer that ends it at call `last`, from 0. Returns what came of it and how many calls there were.
fn ended(path: &Path, last: usize) -> (Result<Cage, ReadError>, usize) {
    let count = Arc::new(AtomicUsize::new(0));
    let heard = count.clone();
    let observer = ReadObserver::new(move |_| {
        if heard.fetch_add(1, Ordering::Relaxed) == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let result = Cage::read_with(path, &everything(observer));
    (result, count.load(Ordering::Relaxed))
}

/// A strip of squares, two triangles each, in which some faces are the wrong way round.
fn strip(squares: u32) -> (Vec<[u32; 2]>, Vec<[u32; 3]>) {
    let positions = (0..2 * squares + 2).map(|v| [v / 2, v % 2]).collect();
    let halves = |k: u32| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]];
    (positions, (0..squares).flat_map(halves).collect())
}

fn obj() -> Vec<u8> {
    let (positions, faces) = strip(20);
    let vertices: String = positions.iter().map(|[x, y]| format!("v {x} {y} 0\n")).collect();
    let faces = faces.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    (vertices + &faces.collect::<String>() + "f 1 2 3 1 2 3\n").into_bytes()
}

fn off() -> Vec<u8> {
    let (positions, faces) = strip(20);
    let vertices: String = positions.iter().map(|[x, y]| format!("{x} {y} 0\n")).collect();
    let rows: String = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    format!("OFF\n{} {} 0\n{vertices}{rows}", positions.len(), faces.len()).into_bytes()
}

fn ply() -> Vec<u8> {
    let (positions, faces) = strip(20);
    let (n, m) = (positions.len(), faces.len());
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {n}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {m}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    positions.iter().for_each(|&[x, y]| [x, y, 0].iter().for_each(|&x| bytes.extend((x as f32).to_le_bytes())));
    for face in faces {
        bytes.push(3);
        face.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

fn glb() -> Vec<u8> {
    let (positions, faces) = strip(20);
    let place = |&[x, y]: &[u32; 2]| [x, y, 0].map(|x| (x as f32).to_le_bytes()).concat();
    let corners = |face: &[u32; 3]| face.map(u32::to_le_bytes).concat();
    let mut bin: Vec<u8> = positions.iter().flat_map(place).collect();
    let start = bin.len();
    bin.extend(faces.iter().flat_map(corners));
    let mut json = serde_json::json!({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [{"byteLength": bin.len()}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "bufferViews": [
            {"buffer": 0, "byteLength": start}, {"buffer": 0, "byteOffset": start, "byteLength": bin.len() - start}
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": positions.len(), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3 * faces.len(), "type": "SCALAR"}
        ]
    })
    .to_string()
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |n: usize| (n as u32).to_le_bytes();
    let chunks = [&word(json.len()), b"JSON", &json[..], &word(bin.len()), b"BIN\0", &bin].concat();
    [&b"glTF"[..], &word(2), &word(12 + chunks.len()), &chunks].concat()
}

fn usda() -> Vec<u8> {
    let (positions, faces) = strip(20);
    let points: Vec<String> = positions.iter().map(|[x, y]| format!("({x}, {y}, 0)")).collect();
    let corners: Vec<String> = faces.iter().flatten().map(u32::to_string).collect();
    let (points, counts, corners) = (points.join(", "), vec!["3"; faces.len()].join(", "), corners.join(", "));
    format!(
        "#usda 1.0\ndef Mesh \"strip\" {{\npoint3f[] points = [{points}]\n\
         int[] faceVertexCounts = [{counts}]\nint[] faceVertexIndices = [{corners}]\n}}\n"
    )
    .into_bytes()
}

#[test]
fn every_stage_is_told_and_can_be_ended() {
    use ReadStage::{Creases, Fetch, Parse, Polygons, Repair, Topology};
    let folder = tempfile::tempdir().expect("a folder");
    let plain = [Fetch, Parse, Repair, Topology, Creases];
    let with_polygons = [Fetch, Parse, Polygons, Repair, Topology, Creases];
    for (name, bytes, due) in [
        ("a.obj", obj(), &plain[..]),
        ("a.off", off(), &plain),
        ("a.ply", ply(), &plain),
        ("a.glb", glb(), &with_polygons),
        ("a.usda", usda(), &plain),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        let calls = calls(&path);
        let mut stages: Vec<ReadStage> = calls.iter().map(|progress| progress.stage).collect();
        stages.dedup();
        // The parts of a binary file are counted in bytes first.
        assert_eq!(stages, due, "{name}");
        for stage in due {
            let of_stage: Vec<&ReadProgress> = calls.iter().filter(|progress| progress.stage == *stage).collect();
            assert!(of_stage.len() > 1, "{name}: {stage:?} says nothing while it goes on");
            assert!(of_stage.iter().all(|progress| progress.done <= progress.total), "{name}: {of_stage:?}");
        }
        for last in 0..calls.len() {
            let (result, count) = ended(&path, last);
            // Threads that find another one telling do not wait, so there may be fewer calls than before.
            if count > last {
                assert!(matches!(&result, Err(ReadError::Cancelled { .. })), "{name} {last}: {result:?}");
                assert_eq!(count, last + 1, "{name}: told after the end");
            }
        }
        let message = ended(&path, 0).0.expect_err("ended").to_string();
        assert_eq!(message, format!("{}: reading was cancelled", path.display()));
    }
}

#[test]
fn progress_rises_within_a_stage() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, obj()).expect("written");
    for pair in calls(&path).windows(2).filter(|pair| pair[0].stage == pair[1].stage) {
        assert!(pair[0].done <= pair[1].done && pair[0].total == pair[1].total, "{pair:?}");
    }
}

#[test]
fn one_long_element_can_be_ended() {
    // Without a look at parts of elements, a file of one line would be read to its end.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, "v 0 0 0\nf".to_owned() + &" 1".repeat(1000)).expect("written");
    let parsed = Arc::new(AtomicUsize::new(0));
    let heard = parsed.clone();
    let observer = ReadObserver::new(move |progress| {
        heard.fetch_add(usize::from(progress.stage == ReadStage::Parse), Ordering::Relaxed);
        ControlFlow::Continue(())
    });
    assert!(Cage::read_with(&path, &ReadDesc { observer: Some(observer), ..ReadDesc::default() }).is_err());
    assert!(parsed.load(Ordering::Relaxed) > 100);
}

#[test]
fn observers_are_equal_to_their_clones() {
    let observer = || ReadObserver::new(|_| ControlFlow::Continue(()));
    let one = observer();
    assert_eq!(one, one.clone());
    assert_ne!(one, observer());
    assert_eq!(format!("{one:?}"), "ReadObserver");
}
