//! Displacement and textures: `--displace`, `--texture`, the shades `textured` and `uv`.

use crate::support::{CAGE, osculate};
use std::fs;
use tempfile::{TempDir, tempdir};

/// The cage with texture coordinates that jump at every edge, and a map of heights.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    let text = CAGE.replace("f 1 2 3 4\nf 2 5 3\nf 5 6 3\n", "");
    let uv = "vt 0 0\nvt 0.4 0\nvt 0.4 0.4\nvt 0 0.4\nvt 0.9 0.5\nvt 0.6 0.9\nvt 0.5 0.6\n";
    let faces = "f 1/1 2/2 3/3 4/4\nf 2/7 5/5 3/6\nf 5/1 6/3 3/2\n";
    fs::write(folder.path().join("mapped.obj"), format!("{text}{uv}{faces}")).unwrap();
    fs::write(folder.path().join("plain.obj"), CAGE).unwrap();
    let heights = image::ImageBuffer::from_fn(16, 16, |x, y| image::Luma([(x * 4001 + y * 2503) as u16]));
    heights.save(folder.path().join("heights.png")).unwrap();
    folder
}

#[test]
fn displaced_surfaces_are_watertight() {
    let folder = folder();
    for evaluator in ["tessellator", "compute"] {
        let arguments =
            ["check", "mapped.obj", "--displace", "heights.png:0.3:-0.1", "--levels", "3", "--evaluator", evaluator];
        let ran = osculate(folder.path(), &arguments).exits(0);
        assert_eq!(ran.stdout.lines().filter(|line| line.ends_with(": watertight")).count(), 4, "{}", ran.stdout);
    }
}

/// The edges of the box of what is exported.
fn bounds(folder: &TempDir, extra: &[&str]) -> [f64; 2] {
    let arguments = [&["export", "mapped.obj", "-o", "out.obj", "--level", "2", "-q"], extra].concat();
    osculate(folder.path(), &arguments).exits(0);
    let text = fs::read_to_string(folder.path().join("out.obj")).unwrap();
    let heights = text.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(2)?.parse::<f64>().ok());
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
}

#[test]
fn scale_and_bias_are_lengths_of_the_cage() {
    let folder = folder();
    let plain = bounds(&folder, &[]);
    let moved = bounds(&folder, &["--displace", "heights.png", "--displace-scale", "0", "--displace-bias", "10"]);
    assert!(moved[0] > plain[0] + 7.0 && moved[1] < plain[1] + 10.0 + 1e-4, "{plain:?}, {moved:?}");
    assert_eq!(bounds(&folder, &["--displace", "heights.png:0:10"]), moved);
}

#[test]
fn pictures_show_textures_and_texture_coordinates() {
    let folder = folder();
    let picture = |extra: &[&str]| {
        let arguments = [&["render", "mapped.obj", "-o", "out.png", "--size", "48x48"], extra].concat();
        osculate(folder.path(), &arguments).exits(0);
        fs::read(folder.path().join("out.png")).unwrap()
    };
    let textured = ["--shade", "textured", "--texture", "heights.png"];
    let pictures = [
        picture(&[]),
        picture(&["--shade", "uv"]),
        picture(&textured),
        picture(&[&textured[..], &["--displace", "heights.png:0.4"]].concat()),
    ];
    for (i, a) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|b| a != b), "picture {i} is one of those before");
    }
}

#[test]
fn what_is_missing_is_named() {
    let folder = folder();
    let says = |arguments: &[&str], code: i32, text: &str| {
        let ran = osculate(folder.path(), arguments).exits(code);
        assert!(ran.stderr.contains(text), "{}", ran.stderr);
    };
    says(&["check", "plain.obj", "--displace", "heights.png"], 3, "plain.obj: the cage has no texture coordinates");
    says(&["check", "mapped.obj", "--displace", "none.png"], 3, "none.png");
    says(&["check", "mapped.obj", "--displace", "plain.obj"], 3, "plain.obj: not a readable picture");
    says(&["check", "mapped.obj", "--displace-bias", "1"], 2, "--displace");
    says(&["render", "mapped.obj", "-o", "out.png", "--shade", "textured"], 2, "--texture");
    says(&["render", "mapped.obj", "-o", "out.png", "--texture", "heights.png"], 2, "--shade textured");
}
