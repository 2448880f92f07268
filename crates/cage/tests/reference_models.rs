//! Reads the reference models and compares them with what is known about them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use osculate_cage::{BoundaryRule, Cage, ReadDesc, RepairDesc, Warning, inspect, read_obj, write_obj};

fn root() -> PathBuf {
    let root = std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data");
    PathBuf::from(root).join("models")
}

/// Models that are no cages, and why.
const REFUSED: [(&str, &str); 2] = [
    (
        "opensubdiv/catmark_nonman_quadpole8.obj",
        ":20: repeated vertices in a face, at 8 corners: face 1 vertex 4, face 3 vertex 4, face 5 vertex 4, face 7 vertex 4 and 4 more; \
         split the face or merge its corners (elements count from 0)",
    ),
    (
        "opensubdiv/catmark_nonman_verts.obj",
        ":29: not manifold, 4 bow-tie vertices where separate fans of faces touch: 1 (2 fans), 10 (2 fans), 24 (2 fans), 35 (2 fans); \
         split these vertices (elements count from 0)",
    ),
];

/// All OBJ files below the folder of reference models.
fn models() -> Vec<PathBuf> {
    files().into_iter().filter(|file| file.extension().is_some_and(|e| e == "obj")).collect()
}

/// All files below that folder, texts that say where models come from included.
fn files() -> Vec<PathBuf> {
    let mut folders = vec![root()];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of models") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn model(path: &str) -> Cage {
    Cage::read(&root().join(path)).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(path: &str) -> String {
    let file = root().join(path);
    let message = Cage::read(&file).expect_err("must be refused").to_string();
    message.strip_prefix(&*file.to_string_lossy()).expect("the message starts with the file").to_string()
}

/// Faces and the vertices they use, counted without the reader.
fn counts(file: &Path) -> (usize, usize) {
    let text = std::fs::read_to_string(file).expect("text");
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    let vertices: BTreeSet<&str> = faces
        .iter()
        .flat_map(|face| face.split_whitespace().skip(1))
        .map(|corner| corner.split('/').next().expect("a corner"))
        .collect();
    (faces.len(), vertices.len())
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn every_file_is_read_whole_or_refused_for_the_reason_that_is_known() {
    let (mut read, mut refused_files) = (0, 0);
    for file in files() {
        let name = file.strip_prefix(root()).expect("a file below the folder").to_string_lossy().into_owned();
        if let Some((_, reason)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
            assert_eq!(refused(&name), *reason);
            refused_files += 1;
        } else if file.extension().is_some_and(|e| e == "md" || e == "txt") {
            assert!(refused(&name).starts_with(": unknown kind of file; the name must end in "), "{name}");
        } else {
            check_whole(&file);
            read += 1;
        }
    }
    assert!(read > 50 && refused_files == REFUSED.len(), "{read} models read, {refused_files} refused");
}

/// Reads a model, compares it with a count of its lines, and inspects it.
fn check_whole(file: &Path) {
    let cage = Cage::read(file).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((cage.face_count(), cage.vertex_count()), counts(file), "{}", file.display());
    let found = inspect(&cage);
    assert_eq!((found.vertices, found.faces), (cage.vertex_count(), cage.face_count()), "{}", file.display());
    assert!(found.genus >= 0 && found.components > 0, "{}", file.display());
    assert_eq!(found.boundaries == 0, found.boundary_edges == 0, "{}", file.display());
    assert_eq!(
        found.euler,
        2 * found.components as i64 - 2 * found.genus - found.boundaries as i64,
        "{}",
        file.display()
    );
    assert_eq!(found.faces_by_size.values().sum::<usize>(), found.faces, "{}", file.display());
    assert_eq!(found.valence.values().sum::<usize>(), found.vertices, "{}", file.display());
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn all_models_survive_a_round_trip() {
    for file in models() {
        let Ok(cage) = Cage::read(&file) else { continue };
        let mut text = Vec::new();
        write_obj(&cage, &mut text).expect("a vector takes everything");
        let again = read_obj(&text, "again.obj").unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        assert_eq!(again.positions(), cage.positions(), "{}", file.display());
        assert_eq!(again.topology(), cage.topology(), "{}", file.display());
        assert_eq!(
            (again.uv(), again.tags(), again.face_sets()),
            (cage.uv(), cage.tags(), cage.face_sets()),
            "{}",
            file.display()
        );
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn all_models_can_be_repaired() {
    let desc = ReadDesc { repair: Some(RepairDesc::default()), ..ReadDesc::default() };
    let read = |path: &Path| Cage::read_with(path, &desc).unwrap_or_else(|error| panic!("{error}"));
    let is_repaired = |cage: &Cage| cage.warnings().iter().any(|warning| matches!(warning, Warning::Repaired(_)));
    let folder = tempfile::tempdir().expect("a folder");
    for file in models() {
        let cage = read(&file);
        if let Ok(plain) = Cage::read(&file) {
            assert!(is_repaired(&cage) || cage == plain, "{}", file.display());
        } else {
            assert!(is_repaired(&cage), "{}", file.display());
        }
        let copy = folder.path().join("copy.obj");
        let mut text = Vec::new();
        write_obj(&cage, &mut text).expect("a vector takes everything");
        std::fs::write(&copy, text).expect("written");
        assert!(!is_repaired(&read(&copy)), "{}: a second repair finds something", file.display());
    }
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn the_cages_of_the_report() {
    let big_guy = inspect(&model("paper/bigguy.obj"));
    assert_eq!((big_guy.faces, big_guy.boundary_edges, big_guy.euler), (1450, 0, 2));
    assert_eq!(big_guy.faces_by_size, [(4, 1450)].into());
    assert_eq!(big_guy.valence.keys().copied().collect::<Vec<_>>(), [3, 4, 5, 6]);

    let frog = inspect(&model("paper/monsterfrog.obj"));
    assert_eq!((frog.faces, frog.components, frog.boundary_edges), (1292, 9, 0));
    assert_eq!((frog.valence.keys().min(), frog.valence.keys().max()), (Some(&3), Some(&7)));
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn surfaces_of_known_shape() {
    let euler = |path: &str| {
        let inspection = inspect(&model(path));
        (inspection.components, inspection.genus, inspection.boundaries)
    };
    assert_eq!(euler("own/cube.obj"), (1, 0, 0));
    assert_eq!(euler("own/torus.obj"), (1, 1, 0));
    assert_eq!(euler("own/twohole.obj"), (1, 2, 0));
    assert_eq!(euler("own/grid.obj"), (1, 0, 1));
    assert_eq!(inspect(&model("own/star12.obj")).valence[&12], 2);
    assert!(inspect(&model("opensubdiv/catmark_pole64.obj")).valence.contains_key(&64));
    assert!(inspect(&model("opensubdiv/catmark_val2_interior.obj")).valence.contains_key(&2));
    let cat = inspect(&model("mit/cat_head.obj"));
    assert_eq!((cat.faces_by_size, cat.boundary_edges > 0), ([(3, 248)].into(), true));
    let spot = inspect(&model("public-domain/spot_control_mesh.obj"));
    assert_eq!(spot.faces, 180);
    assert!(spot.faces_by_size.len() > 1);
}

#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn tags_of_the_models() {
    let bishop = model("opensubdiv/catmark_bishop.obj");
    assert_eq!(bishop.tags().creases.len(), 224);
    assert_eq!(bishop.warnings()[0].to_string(), "tags not evaluated yet are ignored: 224 creases");
    assert_eq!(model("opensubdiv/catmark_edgeonly.obj").boundary_rule(), Some(BoundaryRule::EdgeOnly));
    assert_eq!(model("opensubdiv/catmark_edgecorner.obj").boundary_rule(), Some(BoundaryRule::EdgeAndCorner));
    assert_eq!(model("opensubdiv/catmark_hole_test2.obj").tags().holes, [5, 6, 9, 10]);
    assert!(!model("opensubdiv/catmark_smoothtris0.obj").tags().smooth_triangles);
}
