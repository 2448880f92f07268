//! What fuzzing runs: for each reader, and for the way from a mesh to a plan, a function that takes any bytes.
//!
//! Such a function returns on success and panics on what must not be: a reader that panics, a message of several lines, a cage that
//! is not what it promises, a repair whose result is refused. The fuzzer of `fuzz/` feeds them with what it invents, and a test of
//! this crate with the corpus that it found worth keeping; see docs/fuzzing.md.

pub mod corpus;
mod mesh;
mod plan;
mod readers;

/// A function to be fed with bytes.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, which is also that of its corpus and its dictionary.
    pub name: &'static str,
    /// Panics if the bytes uncover a fault.
    pub run: fn(&[u8]),
}

/// All targets. A new one is a line here and in `fuzz/Cargo.toml`, and a file in `fuzz/targets`.
pub const TARGETS: &[Target] = &[
    Target { name: "obj", run: readers::obj },
    Target { name: "ply", run: readers::ply },
    Target { name: "off", run: readers::off },
    Target { name: "gltf", run: readers::gltf },
    Target { name: "usd", run: readers::usd },
    Target { name: "plan", run: plan::plan },
];

/// The target of that name.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn target(name: &str) -> Target {
    let found = TARGETS.iter().find(|target| target.name == name);
    *found.unwrap_or_else(|| panic!("no target {name:?}"))
}
