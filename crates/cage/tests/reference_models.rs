//! Reads every model of the reference data.

use std::path::PathBuf;

use osculate_cage::{Cage, CageError, ReadError, TopologyError};

/// All OBJ files below the folder of reference models.
fn models() -> Vec<PathBuf> {
    let root = std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data");
    let mut folders = vec![PathBuf::from(root).join("models")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of models") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "obj") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn stem(path: &std::path::Path) -> &str {
    path.file_stem().and_then(|s| s.to_str()).expect("a plain name")
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn all_models_are_read_or_refused_for_cause() {
    let files = models();
    assert!(files.len() > 50, "only {} models", files.len());
    for file in files {
        match Cage::read(&file) {
            Ok(cage) => {
                println!(
                    "{}: {} vertices, {} faces {:?}",
                    stem(&file),
                    cage.vertex_count(),
                    cage.face_count(),
                    cage.warnings()
                );
            }
            Err(
                error @ ReadError::Refused {
                    error: CageError::Topology(TopologyError::NonManifoldEdge(_) | TopologyError::BowTie(_)),
                    ..
                },
            ) => {
                println!("{error}");
            }
            Err(error) => panic!("{error}"),
        }
    }
}
