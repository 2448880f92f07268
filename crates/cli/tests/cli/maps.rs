//! Displacement and textures: `--displace`, `--texture`, the shades `textured` and `uv`.

use crate::support::{CAGE, osculate};
use osculate_cage::Cage;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
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

/// What a glTF file says of displacement does what the options would.
#[test]
fn materials_displace_as_they_say() {
    let folder = folder();
    let export = |input: &str, output: &str, extra: &[&str]| {
        osculate(folder.path(), &[&["export", input, "-o", output, "--level", "2"], extra].concat()).exits(0);
        fs::read(folder.path().join(output)).unwrap()
    };
    export("mapped.obj", "plain.glb", &["--scheme", "gregory1"]);
    let material = serde_json::json!({"extensions": {"KHR_materials_displacement": {
        "displacementGeometryTexture": {"index": 0}, "displacementGeometryFactor": 0.25, "displacementGeometryOffset": -0.125
    }}});
    with_material(&folder.path().join("plain.glb"), &folder.path().join("own.glb"), &material);
    let by_material = export("own.glb", "a.obj", &["--displace", "material"]);
    assert_eq!(by_material, export("plain.glb", "b.obj", &["--displace", "heights.png:0.25:-0.125"]));
    assert_ne!(by_material, export("own.glb", "c.obj", &[]));
    assert_ne!(by_material, export("own.glb", "d.obj", &["--displace", "material:0.5"]));
    let without = osculate(folder.path(), &["export", "plain.glb", "-o", "e.obj", "--displace", "material"]);
    without.fails(2, "no displacement");
}

/// Writes a GLB file again with a material for its one primitive, whose texture 0 is `heights.png`.
fn with_material(from: &Path, to: &Path, material: &serde_json::Value) {
    let file = fs::read(from).unwrap();
    let end = 20 + u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
    let mut json: serde_json::Value = serde_json::from_slice(&file[20..end]).unwrap();
    json["images"] = serde_json::json!([{"uri": "heights.png"}]);
    json["textures"] = serde_json::json!([{"source": 0}]);
    json["extensionsUsed"] = serde_json::json!(["KHR_materials_displacement"]);
    json["materials"] = serde_json::json!([material]);
    json["meshes"][0]["primitives"][0]["material"] = 0.into();
    let mut text = serde_json::to_vec(&json).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let size = |n: usize| (n as u32).to_le_bytes();
    let whole = [
        &b"glTF"[..],
        &size(2),
        &size(20 + text.len() + file.len() - end),
        &size(text.len()),
        b"JSON",
        &text,
        &file[end..],
    ];
    fs::write(to, whole.concat()).unwrap();
}

/// The texture coordinates of a file's corners, v upwards.
fn uv_of(file: &Path) -> BTreeSet<[u32; 2]> {
    let cage = Cage::read(file).unwrap();
    let downwards = file.extension().is_some_and(|extension| extension == "glb");
    let values = cage.uv().expect("texture coordinates").values.iter();
    values.map(|uv| [uv.x as f32, if downwards { 1.0 - uv.y as f32 } else { uv.y as f32 }].map(f32::to_bits)).collect()
}

#[test]
fn exports_have_the_texture_coordinates_of_the_cage() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let export = |input: &str, output: &str, extra: &[&str]| {
        osculate(folder.path(), &[&["export", input, "-o", output], extra].concat()).exits(0);
        fs::read_to_string(path(output)).unwrap_or_default()
    };
    let lines = |text: &str, start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    let mut texts = Vec::new();
    for evaluator in ["tessellator", "compute"] {
        // One patch per face, and one segment per side: the corners are those of the cage.
        let text = export("mapped.obj", "out.obj", &["--scheme", "gregory1", "--level", "1", "--evaluator", evaluator]);
        assert_eq!(uv_of(&path("out.obj")), uv_of(&path("mapped.obj")), "{evaluator}");
        assert_eq!((lines(&text, "v "), lines(&text, "vt "), lines(&text, "f ")), (6, 10, 4), "{evaluator}");
        texts.push(export("mapped.obj", "fine.obj", &["--level", "2", "--evaluator", evaluator]));
        assert!(uv_of(&path("fine.obj")).is_superset(&uv_of(&path("mapped.obj"))), "{evaluator}");
    }
    let plain = export("plain.obj", "plain_out.obj", &["--level", "2"]);
    for text in &texts {
        assert_eq!(lines(text, "v "), lines(&plain, "v "), "seams leave vertices joined");
        assert!(lines(text, "vt ") > lines(text, "v "), "seams are kept");
    }
    assert_eq!(lines(&plain, "vt "), 0);
    // What GLB holds is read again as it was written, and so is what is exported from it.
    export("mapped.obj", "out.glb", &["--scheme", "gregory1", "--level", "1"]);
    assert_eq!(uv_of(&path("out.glb")), turned(uv_of(&path("mapped.obj"))));
    export("out.glb", "again.obj", &["--scheme", "gregory1", "--level", "1"]);
    assert_eq!(uv_of(&path("again.obj")), uv_of(&path("out.glb")));
}

/// The same after v was turned upside down and back, which costs small ones their last bits.
fn turned(uv: BTreeSet<[u32; 2]>) -> BTreeSet<[u32; 2]> {
    uv.into_iter().map(|[u, v]| [u, (1.0 - (1.0 - f32::from_bits(v))).to_bits()]).collect()
}

/// Without seams each vertex has one pair of texture coordinates, whichever patch it is looked at from.
#[test]
fn no_seam_appears_in_an_export() {
    let folder = tempdir().unwrap();
    let sheet = "v 0 0 0\nv 1 0 0.3\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 1\nvt 0 0\nvt 0.3 0.1\nvt 1 0\nvt 0.1 0.9\nvt 0.45 0.8\nvt 0.7 1\n\
                 f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6\nf 5/5 2/2 6/6\n";
    fs::write(folder.path().join("sheet.obj"), sheet).unwrap();
    for scheme in ["gregory1", "gregory2", "stam"] {
        let arguments =
            ["export", "sheet.obj", "-o", "out.obj", "--scheme", scheme, "--level", "2.5", "--spacing", "odd"];
        osculate(folder.path(), &arguments).exits(0);
        let text = fs::read_to_string(folder.path().join("out.obj")).unwrap();
        let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!(count("v "), count("vt "), "{scheme}");
    }
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
