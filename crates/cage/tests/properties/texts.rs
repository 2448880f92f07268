//! Cages as files, written without any code of the crate.

use std::fmt::Write;

use osculate_cage::Cage;

fn faces(cage: &Cage) -> impl Iterator<Item = &[u32]> {
    (0..cage.face_count()).map(|f| cage.face(f))
}

/// Rust's shortest digits read back as the same number.
fn rows(cage: &Cage) -> String {
    let mut text = String::new();
    for p in cage.positions() {
        writeln!(text, "{:?} {:?} {:?}", p.x, p.y, p.z).expect("a string takes everything");
    }
    for face in faces(cage) {
        write!(text, "{}", face.len()).expect("a string takes everything");
        face.iter().for_each(|v| write!(text, " {v}").expect("a string takes everything"));
        text.push('\n');
    }
    text
}

pub(crate) fn off(cage: &Cage) -> String {
    format!("OFF\n{} {} 0\n{}", cage.vertex_count(), cage.face_count(), rows(cage))
}

fn ply_header(cage: &Cage, format: &str) -> String {
    let axes: String = ["x", "y", "z"].map(|axis| format!("property double {axis}\n")).concat();
    let (vertices, faces) = (cage.vertex_count(), cage.face_count());
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\n{axes}element face {faces}\nproperty list uint uint vertex_indices\nend_header\n"
    )
}

pub(crate) fn ply_text(cage: &Cage) -> String {
    ply_header(cage, "ascii") + &rows(cage)
}

pub(crate) fn ply_binary(cage: &Cage, big_endian: bool) -> Vec<u8> {
    let format = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = ply_header(cage, format).into_bytes();
    for x in cage.positions().iter().flat_map(|p| p.to_array()) {
        bytes.extend(if big_endian { x.to_be_bytes() } else { x.to_le_bytes() });
    }
    let mut number = |n: u32| bytes.extend(if big_endian { n.to_be_bytes() } else { n.to_le_bytes() });
    for face in faces(cage) {
        number(face.len() as u32);
        face.iter().for_each(|&v| number(v));
    }
    bytes
}
