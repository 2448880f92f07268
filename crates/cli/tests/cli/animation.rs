//! `osculate render` of what moves.

use crate::support::{CAGE, osculate};
use osculate_compare::{Picture, load};
use serde_json::json;
use std::fs;
use tempfile::{TempDir, tempdir};

/// A folder with `slide.gltf`: a square of half side 1 that slides 10 to the right in a second, or rises by 10, beside its buffer.
fn folder() -> TempDir {
    let points: [f32; 12] = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0];
    let keys: [f32; 14] = [0.0, 1.0, 0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 10.0, 0.0];
    let mut bytes: Vec<u8> = points.iter().chain(&keys).flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    let animation = |name, output| {
        json!({
            "name": name,
            "samplers": [{"input": 1, "output": output}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]
        })
    };
    let document = json!({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 4}]}],
        "animations": [animation("slide", 2), animation("rise", 3)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
            {"bufferView": 0, "byteOffset": 56, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 104},
            {"buffer": 0, "byteOffset": 104, "byteLength": 12}
        ],
        "buffers": [{"byteLength": bytes.len(), "uri": "slide.bin"}]
    });
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("slide.bin"), bytes).unwrap();
    fs::write(folder.path().join("slide.gltf"), document.to_string()).unwrap();
    fs::write(folder.path().join("still.obj"), CAGE).unwrap();
    folder
}

/// From straight ahead, so that the square covers the middle of the picture when it is at the origin.
const AHEAD: [&str; 8] =
    ["--size", "64x48", "--level", "2", "--camera", "0,0,4:0,0,0:0,1,0:45", "--background", "white"];

fn render(folder: &TempDir, output: &str, more: &[&str]) -> String {
    let ran = osculate(folder.path(), &[&["render", "slide.gltf", "-o", output], more].concat()).exits(0);
    assert_eq!(ran.stdout, "");
    ran.stderr
}

fn picture(folder: &TempDir, name: &str) -> Picture {
    load(&folder.path().join(name)).unwrap()
}

fn shows_the_square(picture: &Picture) -> bool {
    picture.pixels().nth(24 * 64 + 32).unwrap() != [255; 4]
}

/// The pictures in the folder, in order.
fn names(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = entries.filter(|name| name.contains("png")).collect();
    names.sort();
    names
}

#[test]
fn the_cage_is_where_it_is_at_that_time() {
    let folder = folder();
    let at = |more: &[&str]| {
        render(&folder, "out.png", &[&AHEAD[..], more].concat());
        picture(&folder, "out.png")
    };
    let start = at(&["--time", "0"]);
    assert!(shows_the_square(&start) && !shows_the_square(&at(&["--time", "1"])));
    assert_eq!(at(&["--time", "-3"]), start);
    assert_eq!(at(&["--animation", "rise"]), start);
    let moved = |animation| at(&["--time", "0.15", "--animation", animation]);
    assert!(moved("slide") == moved("0") && moved("rise") == moved("1") && moved("slide") != moved("rise"));
    // Other schemes and evaluators follow as well, and so do both surfaces of a difference.
    for more in [["--scheme", "gregory1"], ["--evaluator", "compute"], ["--shade", "normals"]] {
        let [start, end] = ["0", "1"].map(|time| at(&[&more[..], &["--time", time]].concat()));
        assert!(shows_the_square(&start) && !shows_the_square(&end), "{more:?}");
    }
    let ran = osculate(
        folder.path(),
        &[&["render", "slide.gltf", "-o", "out.png", "--time", "1", "--shade", "difference"], &AHEAD[..]].concat(),
    );
    assert!(ran.exits(0).stdout.contains("largest distance 0.000e0"));
}

#[test]
fn frames_are_numbered_and_the_same_in_parts() {
    let folder = folder();
    let frames = ["--frames", "8..11", "--fps", "10"];
    render(&folder, "whole_%03d.png", &[&AHEAD[..], &frames].concat());
    assert_eq!(names(&folder), [8, 9, 10, 11].map(|k| format!("whole_{k:03}.png")));
    for part in ["1/3", "2/3", "3/3"] {
        render(&folder, "part_%d.png", &[&AHEAD[..], &frames, &["--shard", part]].concat());
    }
    for k in 8..=11 {
        let time = format!("{}", f64::from(k) / 10.0);
        render(&folder, "one.png", &[&AHEAD[..], &["--time", &time]].concat());
        let whole = picture(&folder, &format!("whole_{k:03}.png"));
        assert_eq!(picture(&folder, &format!("part_{k}.png")), whole, "{k}");
        assert_eq!(picture(&folder, "one.png"), whole, "{k}");
    }
    // More parts than frames leave some with nothing to do.
    render(&folder, "none_%d.png", &[&AHEAD[..], &["--frames", "0..1", "--shard", "3/3"]].concat());
    assert!(names(&folder).iter().all(|name| !name.starts_with("none")));
}

/// Numbered files are frames of their number at any rate. The cage space stays that of the first, so bits may differ from those of a still.
#[test]
fn numbered_files_are_frames() {
    let folder = folder();
    for (number, x) in [(3, 0.0), (4, 0.5), (5, 9.0)] {
        let square =
            format!("v {} -1 0\nv {} -1 0\nv {} 1 0\nv {} 1 0\nf 1 2 3 4\n", x - 1.0, x + 1.0, x + 1.0, x - 1.0);
        fs::write(folder.path().join(format!("walk_{number:04}.obj")), square).unwrap();
    }
    let still = |name: &str| {
        let arguments = [&["render", name, "-o", "still.png"], &AHEAD[..]].concat();
        osculate(folder.path(), &arguments).exits(0);
        picture(&folder, "still.png")
    };
    let stills = [3, 4, 5].map(|number| still(&format!("walk_000{number}.obj")));
    assert_eq!(stills.each_ref().map(shows_the_square), [true, true, false]);
    for fps in ["24", "7"] {
        let arguments = ["render", "walk_####.obj", "-o", "f_%d.png", "--frames", "2..6", "--fps", fps];
        osculate(folder.path(), &[&arguments, &AHEAD[..]].concat()).exits(0);
        for (k, expected) in (2..).zip([0, 0, 1, 2, 2].map(|file| &stills[file])) {
            let near = |(a, b): &([u8; 4], [u8; 4])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 4);
            let found = picture(&folder, &format!("f_{k}.png"));
            let same = found.pixels().zip(expected.pixels()).filter(near).count();
            assert!(same >= 64 * 48 * 99 / 100, "frame {k} at {fps}: only {same} pixels are alike");
        }
    }
    let arguments = ["render", "walk_####.obj", "-o", "out.png", "--time", "0.1", "--animation", "0"];
    osculate(folder.path(), &arguments).fails(2, "no animations to choose from");
}

#[test]
fn the_camera_fits_the_first_frame_or_all() {
    let folder = folder();
    let size = ["--size", "64x48", "--background", "white", "--fps", "2"];
    let warnings = render(&folder, "first_%d.png", &[&size[..], &["--frames", "0..2"]].concat());
    assert!(warnings.contains("first_1.png: the picture is blank") && !warnings.contains("first_2.png"), "{warnings}");
    // A part that does not hold the first frame has its camera all the same.
    render(&folder, "part_%d.png", &[&size[..], &["--frames", "0..2", "--shard", "2/2"]].concat());
    assert_eq!(picture(&folder, "part_1.png"), picture(&folder, "first_1.png"));
    let quiet = render(&folder, "all_%d.png", &[&size[..], &["--frames", "0..2", "--fit-frames"]].concat());
    assert_eq!(quiet, "");
}

#[test]
fn what_cannot_be_played_is_refused() {
    let folder = folder();
    for (arguments, part) in [
        (&["still.obj", "-o", "out.png", "--time", "1"][..], "still.obj: nothing is animated in this file"),
        (&["still.obj", "-o", "out_%d.png", "--frames", "0..3"], "still.obj: nothing is animated"),
        (&["slide.gltf", "-o", "out.png", "--animation", "swim"], "no animation \"swim\""),
        (&["slide.gltf", "-o", "out.png", "--animation", "2"], "no animation \"2\""),
        (&["slide.gltf", "-o", "out.png", "--frames", "0..3"], "a place for their number"),
        (&["slide.gltf", "-o", "out_%d.png", "--frames", "3..0"], "3..0"),
        (&["slide.gltf", "-o", "out_%d.png", "--frames", "0..3", "--fps", "0"], "greater than 0"),
        (&["slide.gltf", "-o", "out_%d.png", "--frames", "0..3", "--shard", "0/2"], "0/2"),
        (&["slide.gltf", "-o", "out_%d.png", "--frames", "0..3", "--time", "1"], "--time"),
        (&["slide.gltf", "-o", "out.png", "--fps", "24"], "--frames"),
        (&["slide.gltf", "-o", "no/out_%d.png", "--frames", "0..3"], "its folder does not exist"),
    ] {
        osculate(folder.path(), &[&["render"], arguments].concat()).fails(2, part);
    }
    assert_eq!(names(&folder), [""; 0]);
}

#[cfg(target_os = "linux")]
#[test]
fn an_interruption_leaves_whole_pictures_only() {
    use crate::support::{interruptible, send};
    use std::os::unix::process::ExitStatusExt;
    use std::process::Stdio;

    let folder = folder();
    let arguments = [&["render", "slide.gltf", "-o", "f_%06d.png", "--frames", "0..100000"], &AHEAD[..]].concat();
    let mut child = interruptible(folder.path(), &arguments).stderr(Stdio::null()).spawn().unwrap();
    while names(&folder).iter().filter(|name| name.ends_with(".png")).count() < 3 {
        assert_eq!(child.try_wait().unwrap(), None, "it has not ended");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    send("INT", &child);
    assert_eq!(child.wait().unwrap().signal(), Some(2));
    for (k, name) in names(&folder).iter().enumerate() {
        assert_eq!(*name, format!("f_{k:06}.png"));
        assert_eq!(picture(&folder, name).size().to_string(), "64x48");
    }
}
