//! The examples run, under validation, and what they write is right.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use glam::DVec3;
use osculate_cage::Cage;
use osculate_surface::reference::{Boundary, Mesh, Reference};

/// Runs an example in a folder with arguments; fails unless it does what it should.
fn run(folder: &Path, name: &str, arguments: &[&str]) -> String {
    let output = command(name).current_dir(folder).args(arguments).arg("--validation").output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{name} {arguments:?}: {}\n{out}{err}", output.status);
    out.into_owned()
}

/// An example, which cargo builds with the tests of its package: it lies beside them.
fn command(name: &str) -> Command {
    let tests = std::env::current_exe().unwrap();
    let target = tests.parent().and_then(Path::parent).expect("tests lie in target/<profile>/deps");
    let program = target.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(program.exists(), "{} is not built: cargo build -p osculate --examples", program.display());
    Command::new(program)
}

fn asset(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/cages").join(name);
    path.to_str().unwrap().to_owned()
}

/// A picture: its pixels, red, green, blue, alpha.
fn picture(path: &Path, size: [u32; 2]) -> Vec<[u8; 4]> {
    let image = image::open(path).unwrap().into_rgba8();
    assert_eq!([image.width(), image.height()], size, "{}", path.display());
    image.pixels().map(|pixel| pixel.0).collect()
}

/// How many pixels differ from that in the corner, which shows background.
fn covered(pixels: &[[u8; 4]]) -> usize {
    pixels.iter().filter(|pixel| **pixel != pixels[0]).count()
}

/// How many pixels two pictures show differently.
fn differing(a: &[[u8; 4]], b: &[[u8; 4]]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

#[test]
fn embed_draws_every_instance_into_images_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let cages = [asset("twohole.obj"), asset("ngon.obj")];
    let common = [cages[0].as_str(), &cages[1], "--width", "160", "--height", "100"];
    let said = run(folder.path(), "embed", &[&common[..], &["-o", "all.png"]].concat());
    assert!(said.contains("7 instances of 2 cages"), "{said}");
    let all = picture(&folder.path().join("all.png"), [160, 100]);
    let share = covered(&all) as f64 / all.len() as f64;
    assert!((0.2..0.9).contains(&share), "{share} of the picture");
    // Paint, push constants and the renderer's own set reach the shader: there are reddish and bluish surfaces.
    let more = |i: usize, j: usize| all.iter().filter(|pixel| pixel[i] > pixel[j].saturating_add(40)).count();
    assert!(more(0, 2) > 100 && more(2, 0) > 50, "{} {}", more(0, 2), more(2, 0));
    // The first frame shows the cage in another shape.
    run(folder.path(), "embed", &[&common[..], &["-o", "first.png", "--frames", "1"]].concat());
    assert!(differing(&all, &picture(&folder.path().join("first.png"), [160, 100])) > 500);
}

#[test]
fn turntable_shows_another_side_in_each_picture() {
    let folder = tempfile::tempdir().unwrap();
    let cage = asset("dragon.obj");
    let size = ["--width", "96", "--height", "72", "--samples", "1"];
    run(folder.path(), "turntable", &[&[cage.as_str(), "-o", "side_%02d.png", "--frames", "3"], &size[..]].concat());
    let sides = ["side_00.png", "side_01.png", "side_02.png"].map(|name| picture(&folder.path().join(name), [96, 72]));
    for (i, side) in sides.iter().enumerate() {
        assert!(covered(side) > 500, "{} in picture {i}", covered(side));
        assert!(differing(side, &sides[(i + 1) % 3]) > 300);
    }
}

#[test]
fn morph_goes_there_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let (cube, triangles) = (asset("cube.obj"), asset("triangles.obj"));
    let small = ["--frames", "4", "--width", "64", "--height", "48", "--samples", "1", "-o"];
    run(folder.path(), "morph", &[&[cube.as_str()], &small[..], &["f_%02d.png"]].concat());
    let frames = [0, 1, 2, 3].map(|i| picture(&folder.path().join(format!("f_{i:02}.png")), [64, 48]));
    assert!(frames.iter().all(|frame| covered(frame) > 100));
    assert!(differing(&frames[0], &frames[2]) > 100, "another shape");
    assert_eq!(differing(&frames[1], &frames[3]), 0, "the way back is the way there");
    let wrong = [
        ([&[cube.as_str()], &small[..], &["f.png"]].concat(), "%04d"),
        ([&[cube.as_str(), &triangles], &small[..], &["f_%02d.png"]].concat(), "vertices"),
        (vec!["nowhere.obj"], "nowhere.obj"),
        (vec![], "--help"),
    ];
    for (arguments, reason) in wrong {
        let output = command("morph").current_dir(folder.path()).args(arguments).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && said.contains(reason), "{said}");
    }
}

/// The table agrees with the f64 reference, which shares no code with the shaders; the mesh has the same points.
#[test]
fn limit_points_are_those_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["ngon.obj", "shell.obj"] {
        let cage = Cage::read(asset(name).as_ref()).unwrap();
        run(folder.path(), "limit_points", &[&asset(name), "-o", "points.csv", "--grid", "3"]);
        let mesh = Mesh {
            positions: cage.positions().to_vec(),
            face_offsets: cage.face_offsets().to_vec(),
            face_vertices: cage.face_vertices().to_vec(),
        };
        let reference = Reference::new(&mesh, Boundary::EdgeAndCorner).unwrap();
        let text = std::fs::read_to_string(folder.path().join("points.csv")).unwrap();
        let mut faces = HashMap::new();
        let size = cage.bounds().half_diagonal();
        for line in text.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
            let [face, sub, s, t, x, y, z, nx, ny, nz] = numbers[..] else { panic!("{line}") };
            let expected = reference.eval(face as usize, sub as i32, s, t).unwrap();
            let (position, normal) = (DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
            assert!((position - expected.position).length() < 2e-6 * size, "{name}: {line}, {}", expected.position);
            assert!((normal - expected.normal).length() < 2e-4, "{name}: {line}, {}", expected.normal);
            *faces.entry((face as u32, sub as i32)).or_insert(0) += 1;
        }
        assert!(faces.len() >= cage.face_count() && faces.values().all(|&points| points == 16));
        run(folder.path(), "limit_points", &[&asset(name), "-o", "mesh.obj", "--grid", "3"]);
        let text = std::fs::read_to_string(folder.path().join("mesh.obj")).unwrap();
        let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!([count("v "), count("vn "), count("f ")], [faces.len() * 16, faces.len() * 16, faces.len() * 9]);
        let highest = text.lines().filter(|line| line.starts_with("f ")).flat_map(|line| line.split(' ').skip(1));
        let highest = highest.map(|corner| corner.split('/').next().unwrap().parse::<usize>().unwrap()).max();
        assert_eq!(highest, Some(faces.len() * 16));
    }
}

#[test]
fn every_example_has_help() {
    for name in ["embed", "turntable", "morph", "limit_points"] {
        let output = command(name).arg("--help").output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && said.contains(&format!("usage: {name} ")), "{said}");
    }
}
