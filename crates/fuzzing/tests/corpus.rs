//! Runs what fuzzing found worth keeping through the functions that it fuzzes.

use std::path::Path;

use osculate_cage::{Cage, Limits, ReadDesc};
use osculate_fuzzing::{TARGETS, corpus, target};

/// The inputs of a target; all of them are fed to it.
fn replay(name: &str) -> Vec<Vec<u8>> {
    let inputs = corpus::read(&corpus::kept(name)).expect("a corpus");
    assert!(inputs.len() > 50, "only {} inputs", inputs.len());
    for (number, input) in inputs.iter().enumerate() {
        // Inputs are small: what a panic does not say, this does.
        let fed = std::panic::catch_unwind(|| (target(name).run)(input));
        assert!(fed.is_ok(), "input {number} of {name}: {:?}", String::from_utf8_lossy(input));
    }
    inputs
}

#[test]
fn obj() {
    replay("obj");
}

#[test]
fn ply() {
    replay("ply");
}

#[test]
fn off() {
    replay("off");
}

#[test]
fn gltf() {
    replay("gltf");
}

#[test]
fn usd() {
    replay("usd");
}

#[test]
fn plan() {
    replay("plan");
}

#[test]
fn there_is_a_test_and_a_corpus_for_each_target() {
    let text = include_str!("corpus.rs");
    for target in TARGETS {
        assert!(text.contains(&format!("replay(\"{}\")", target.name)), "no test of {}", target.name);
    }
    let bytes: u64 = TARGETS.iter().map(|target| corpus::kept(target.name).metadata().expect("a corpus").len()).sum();
    assert!(bytes < 1 << 20, "the corpora have {bytes} bytes; minimise them");
}

/// A corpus that only holds refused files would say little.
#[test]
fn corpora_hold_good_files_too() {
    for (target, ending) in [("obj", "obj"), ("ply", "ply"), ("off", "off"), ("gltf", "gltf"), ("usd", "usd")] {
        let name = format!("a.{ending}");
        let limits = Limits { memory_bytes: 1 << 20, ..Limits::default() };
        let desc = ReadDesc { limits, ..ReadDesc::default() };
        let read = |bytes: &Vec<u8>| Cage::read_bytes(bytes, Path::new(&name), &desc).is_ok();
        let inputs = corpus::read(&corpus::kept(target)).expect("a corpus");
        let good = inputs.iter().filter(|bytes| read(bytes)).count();
        assert!(good > 2 && good < inputs.len(), "{good} of {} files {name} are read", inputs.len());
    }
}

#[test]
fn packing_keeps_every_input_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let pack = folder.path().join("a.pack");
    corpus::write(&pack, vec![b"bb".to_vec(), Vec::new(), b"a".to_vec(), b"bb".to_vec()]).expect("written");
    assert_eq!(corpus::read(&pack).expect("read"), [Vec::new(), b"a".to_vec(), b"bb".to_vec()]);
    std::fs::write(&pack, [9, 0, 0, 0, 1]).expect("written");
    assert!(corpus::read(&pack).is_err());
}
