//! Shaders with a deliberate mistake, for tests that a check can fail.

use osculate::ShaderSet;
use osculate_shader_compiler::{CompileDesc, compile};
use osculate_shaders::{INCLUDE_DIRS, SHADERS, source};

/// One change of one file of the shaders folder.
pub struct Mutation {
    /// Path of the file.
    pub path: &'static str,
    /// Text that occurs there exactly once.
    pub from: &'static str,
    /// What it becomes.
    pub to: &'static str,
}

impl Mutation {
    fn apply(&self) -> String {
        let text = source(self.path).unwrap_or_else(|| panic!("there is no shader file {}", self.path));
        assert_eq!(text.matches(self.from).count(), 1, "{:?} must occur once in {}", self.from, self.path);
        text.replace(self.from, self.to)
    }
}

/// The shaders that the mutations reach, compiled with them; the others as they are.
///
/// # Panics
/// If a mutation does not fit its file, or the changed shaders do not compile, or no shader comes out different.
pub fn mutated(mutations: &[Mutation]) -> ShaderSet {
    let changed: Vec<(&str, String)> = mutations.iter().map(|mutation| (mutation.path, mutation.apply())).collect();
    let load = |path: &str| match changed.iter().find(|(name, _)| *name == path) {
        Some((_, text)) => Some(text.clone()),
        None => source(path).map(str::to_owned),
    };
    let mut set = ShaderSet::embedded();
    let mut different = 0;
    let reads = |path: &str| mutations.iter().any(|mutation| reads(path, mutation.path));
    for shader in SHADERS.iter().filter(|shader| reads(shader.path)) {
        let text = load(shader.path).expect("an embedded shader has its source");
        let desc = CompileDesc {
            name: shader.path,
            source: &text,
            include_dirs: INCLUDE_DIRS,
            load: &load,
            defines: shader.defines,
            debug_info: false,
        };
        let words = compile(&desc).unwrap_or_else(|error| panic!("{}: {error}", shader.name));
        different += usize::from(words != shader.spirv);
        set = set.with_override(shader.name, words).expect("the name is that of an embedded shader");
    }
    assert!(different > 0, "the mutations change no shader");
    set
}

/// Whether the text of a file contains that of another, by whatever way of includes.
fn reads(path: &str, other: &str) -> bool {
    let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let places = |name: &str| {
        let folders = std::iter::once(folder).chain(INCLUDE_DIRS.iter().copied());
        let joined = folders.map(|folder| if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") });
        joined.collect::<Vec<String>>()
    };
    let text = source(path).unwrap_or_else(|| panic!("there is no shader file {path}"));
    let names = text.lines().filter_map(|line| line.strip_prefix("#include \"")?.strip_suffix('"'));
    let mut included = names.filter_map(|name| places(name).into_iter().find(|path| source(path).is_some()));
    path == other || included.any(|path| reads(&path, other))
}
