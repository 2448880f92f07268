//! The text, binary and packaged form of one scene, and damaged files. The binary form was made by usdcat, the package by usdzip.

use super::*;

const TEXT: &[u8] = include_bytes!("moving.usda");
const BINARY: &[u8] = include_bytes!("moving.usdc");
const PACKAGE: &[u8] = include_bytes!("moving.usdz");

fn read(bytes: &[u8]) -> Result<Cage, ReadError> {
    read_usd(bytes, "moving", &ReadDesc::default())
}

fn near(a: &[DVec3], b: &[DVec3]) -> bool {
    // The binary form has 32-bit floats.
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.abs_diff_eq(*b, 1e-6))
}

#[test]
fn all_forms_hold_the_same_cage() {
    let [text, binary, package] = [TEXT, BINARY, PACKAGE].map(|bytes| read(bytes).expect("a cage"));
    assert_eq!(binary, package);
    assert!(near(text.positions(), binary.positions()));
    assert_eq!((text.face_offsets(), text.face_vertices()), (binary.face_offsets(), binary.face_vertices()));
    assert_eq!(text.tags(), binary.tags());
    assert_eq!(text.uv(), binary.uv());
    assert_eq!(text.face_sets(), binary.face_sets());
    assert_eq!(text.warnings(), binary.warnings());
}

#[test]
fn the_scene_is_where_pixars_library_puts_it() {
    let cage = read(BINARY).expect("a cage");
    assert_eq!((cage.face_count(), cage.vertex_count()), (20, 29));
    let sheet = [(0, [10.0, -3.0, -0.125]), (1, [11.0, -2.880000002682209, -0.125])];
    let tetrahedron = [(25, [10.0, 2.0, -0.125]), (27, [10.0, 2.0, -1.125])];
    for (vertex, place) in sheet.into_iter().chain(tetrahedron) {
        assert!(cage.positions()[vertex].abs_diff_eq(DVec3::from(place), 1e-12), "{vertex}");
    }
    let creases: Vec<f32> = cage.tags().creases.iter().map(|crease| crease.sharpness).collect();
    assert_eq!(creases, [2.25, 1.5].repeat(8));
}

#[test]
fn frames_are_where_pixars_library_puts_them() {
    for (bytes, name) in [(TEXT, "a.usda"), (BINARY, "a.usdc"), (PACKAGE, "a.usdz")] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).expect("written");
        let sequence = crate::Sequence::open(&file, &ReadDesc::default()).expect("a sequence");
        assert_eq!(sequence.times(), [0.2, 0.7, 1.2]);
        let last = sequence.positions(2).expect("a frame");
        let expected = [[10.0, -2.773, -0.125], [10.0, -2.85, -1.125], [18.0, -3.189, -4.125]];
        assert!(near(&[last[0], last[1], last[24]], &expected.map(DVec3::from)), "{last:?}");
        // Points and the turn both move, each on its own line.
        let between = sequence.positions(1).expect("a frame");
        let turned = DVec3::new(10.0 + 0.5_f64.sqrt(), -2.751, -0.125 - 0.5_f64.sqrt());
        assert!(between[1].abs_diff_eq(turned, 1e-3), "{}", between[1]);
    }
}

/// Whatever happens to a file, it is a cage or refused.
fn survives(bytes: &[u8]) {
    if let Err(error) = read(bytes) {
        assert!(error.to_string().starts_with("moving:"), "{error}");
    }
}

#[test]
fn files_that_are_cut_are_refused() {
    for bytes in [BINARY, PACKAGE] {
        for length in (0..bytes.len()).step_by(7) {
            survives(&bytes[..length]);
        }
        // The table of contents comes last.
        assert!(read(&bytes[..bytes.len() / 2]).is_err());
    }
    for length in (0..TEXT.len()).step_by(7) {
        survives(&TEXT[..length]);
    }
}

#[test]
fn damaged_bytes_do_no_harm() {
    for bytes in [TEXT, BINARY] {
        let mut damaged = bytes.to_vec();
        for at in (0..bytes.len()).step_by(3) {
            for value in [0, 0xff, bytes[at] ^ 1, bytes[at].wrapping_add(64)] {
                damaged[at] = value;
                survives(&damaged);
            }
            damaged[at] = bytes[at];
        }
    }
}
