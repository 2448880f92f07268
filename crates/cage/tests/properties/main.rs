//! What holds for every mesh, tried with random ones.

mod meshes;
mod texts;

use std::path::Path;

use osculate_cage::{Cage, CageDesc, FileFormat, NONE, ReadDesc, RepairDesc, Topology, inspect, repair, write_obj};
use proptest::prelude::*;

use meshes::{decorated, repaired, soup};
use texts::{off, ply_binary, ply_text};

/// Failures are small and printed whole, so they need no file.
fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

fn read(bytes: &[u8], name: &str) -> Cage {
    Cage::read_bytes(bytes, Path::new(name), &ReadDesc::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn bits(cage: &Cage) -> Vec<[u64; 3]> {
    cage.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn obj(cage: &Cage) -> String {
    let mut text = Vec::new();
    write_obj(cage, &mut text).expect("a vector takes everything");
    String::from_utf8(text).expect("names are text")
}

/// The promises of a topology, by definition rather than by how it is built.
fn check_topology(topology: &Topology) {
    let half_edges = 0..topology.half_edge_count() as u32;
    for h in half_edges.clone() {
        let (from, to, twin) = (topology.origin(h), topology.target(h), topology.twins()[h as usize]);
        assert_ne!(from, to, "half-edge {h}");
        if twin != NONE {
            assert_ne!(topology.face(h), topology.face(twin), "half-edge {h}");
            assert_eq!(topology.twins()[twin as usize], h);
            assert_eq!((topology.origin(twin), topology.target(twin)), (to, from));
        }
    }
    let boundary = half_edges.filter(|&h| topology.twins()[h as usize] == NONE).count();
    assert_eq!(2 * topology.edge_count(), topology.half_edge_count() + boundary);
    for v in 0..topology.vertex_count() as u32 {
        assert!((2..=topology.edge_count() as u32).contains(&topology.valence(v)), "vertex {v}");
        assert_eq!(topology.origin(topology.vertex_half_edge(v)), v);
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_cage_is_a_manifold_or_refused(desc in soup()) {
        let corners = desc.face_vertices.clone();
        if let Ok(cage) = Cage::new(desc) {
            check_topology(cage.topology());
            let named = cage.face_vertices().iter().map(|&v| cage.source_vertices()[v as usize]);
            prop_assert_eq!(named.collect::<Vec<_>>(), corners);
            let found = inspect(&cage);
            prop_assert!(found.genus >= 0 && found.components >= 1);
            prop_assert_eq!(found.boundaries == 0, found.boundary_edges == 0);
        }
    }

    #[test]
    fn a_repair_leaves_a_cage_and_nothing_to_repair(desc in soup(), tolerance in prop_oneof![Just(0.0), 0.0..2.0]) {
        let options = RepairDesc { weld_tolerance: tolerance };
        let once = repair(desc, &options).expect("nothing is out of range");
        let twice = repair(once.clone(), &options).expect("nothing is out of range");
        prop_assert_eq!(&twice, &once);
        if once.face_offsets.len() > 1 {
            let cage = Cage::new(once).unwrap_or_else(|error| panic!("{error}"));
            check_topology(cage.topology());
        }
    }

    #[test]
    fn obj_files_read_back_as_the_same_bits(cage in decorated()) {
        let again = read(obj(&cage).as_bytes(), "again.obj");
        prop_assert_eq!(bits(&again), bits(&cage));
        prop_assert_eq!(again.topology(), cage.topology());
        prop_assert_eq!(again.uv(), cage.uv());
        prop_assert_eq!(again.tags(), cage.tags());
        prop_assert_eq!(again.face_sets(), cage.face_sets());
    }

    #[test]
    fn ply_and_off_files_read_back_as_the_same_bits(cage in repaired()) {
        let files = [
            ("a.ply", ply_text(&cage).into_bytes()),
            ("a.ply", ply_binary(&cage, false)),
            ("a.ply", ply_binary(&cage, true)),
            ("a.off", off(&cage).into_bytes()),
        ];
        for (name, bytes) in files {
            let again = read(&bytes, name);
            prop_assert_eq!(bits(&again), bits(&cage));
            prop_assert_eq!(again.topology(), cage.topology());
        }
    }

    #[test]
    fn line_ends_blanks_and_comments_say_nothing(cage in decorated(), blanks in "[ \t]{1,3}") {
        for (name, text) in [("a.obj", obj(&cage)), ("a.ply", ply_text(&cage)), ("a.off", off(&cage))] {
            let whole = read(text.as_bytes(), name);
            let trailing = text.replace('\n', &format!("{blanks}\n"));
            let mut others = vec![text.replace('\n', "\r\n"), text.replace('\n', "\r"), trailing, text.trim_end().into()];
            if FileFormat::of(Path::new(name), text.as_bytes()) != Some(FileFormat::Ply) {
                others.push(text.replace('\n', "\n# v 1 2 3\n\n"));
            }
            for other in others {
                prop_assert_eq!(&read(other.as_bytes(), name), &whole);
            }
        }
    }
}

/// The generators do what the properties rest on: some meshes are cages, some are not, and some of those can be repaired.
#[test]
fn meshes_are_of_all_kinds() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let meshes: Vec<CageDesc> = (0..200).map(|_| soup().new_tree(&mut runner).expect("a mesh").current()).collect();
    let cages = meshes.iter().filter(|desc| Cage::new((*desc).clone()).is_ok()).count();
    assert!((5..150).contains(&cages), "{cages} of 200 are cages");
    let made = |desc: &CageDesc| repair(desc.clone(), &RepairDesc::default()).is_ok_and(|desc| Cage::new(desc).is_ok());
    let repaired = meshes.iter().filter(|desc| made(desc)).count();
    assert!(repaired > cages + 20, "{repaired} of 200 can be repaired, {cages} are cages as they are");
}
