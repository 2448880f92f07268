//! Cages for the tests of this crate.
#![allow(dead_code, reason = "each test file uses some of these")]

use std::path::PathBuf;

use glam::DVec3;
use osculate_cage::{Cage, CageDesc};

/// A cage with the given faces; points on a helix, for tests that look at connectivity alone.
pub(crate) fn cage(vertices: usize, faces: &[&[u32]]) -> Cage {
    let positions = (0..vertices).map(|i| i as f64).map(|x| DVec3::new(x.cos(), x.sin(), 0.1 * x)).collect();
    let mut face_offsets = vec![0];
    face_offsets.extend(faces.iter().scan(0, |end, face| {
        *end += face.len() as u32;
        Some(*end)
    }));
    Cage::new(CageDesc { positions, face_offsets, face_vertices: faces.concat(), ..CageDesc::default() })
        .expect("a valid cage")
}

/// All shipped cages with their names.
pub(crate) fn zoo() -> Vec<(String, Cage)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/cages");
    let mut files: Vec<PathBuf> =
        folder.read_dir().expect("the folder of cages").map(|entry| entry.expect("a readable entry").path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "obj"));
    files.sort();
    assert!(files.len() > 10, "only {} cages in {}", files.len(), folder.display());
    let read = |file: PathBuf| {
        (file.file_stem().unwrap_or_default().to_string_lossy().into_owned(), Cage::read(&file).unwrap())
    };
    files.into_iter().map(read).collect()
}
