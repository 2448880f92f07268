//! The SPIR-V of the shaders folder, and the structs and bindings shared with it.
//!
//! A shader's name is its path below the shaders folder (`subdivide/face.comp`). Some stages exist in variants, named by what follows a `#`: evaluation stages by
//! the spacing, by what fragments see (`position`, `normal`, or everything) or `capture` for those whose outputs go to transform feedback, and by `mapped` for
//! surfaces with texture coordinates (`patch/regular.tese#odd,capture`); the exact patches' control stage by the points of its net (`patch/stam.tesc#18`). The
//! list is `build/variants.rs`. Sources are embedded too, so that a changed text can be compiled at run time.

pub mod layout;

/// Binding numbers of descriptor set 0: the `BINDING_*` lines of `shaders/include/bindings.glsl`.
pub mod binding {
    include!(concat!(env!("OUT_DIR"), "/binding.rs"));
}

/// Numbers that shaders and host share: the `#define` lines of `shaders/include/constants.glsl`.
pub mod constant {
    include!(concat!(env!("OUT_DIR"), "/constant.rs"));
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

use std::collections::BTreeMap;

/// One compiled shader.
#[derive(Debug, Clone, Copy)]
pub struct EmbeddedShader {
    /// Path of its source plus the suffix of its variant.
    pub name: &'static str,
    /// Path of its source, as in [`SOURCES`].
    pub path: &'static str,
    /// Macros that make the variant.
    pub defines: &'static [(&'static str, Option<&'static str>)],
    /// The SPIR-V words.
    pub spirv: &'static [u32],
}

/// SPIR-V of the shader with that name.
pub fn shader(name: &str) -> Option<&'static [u32]> {
    embedded(name).map(|shader| shader.spirv)
}

/// The shader with that name, with what it was compiled from.
pub fn embedded(name: &str) -> Option<&'static EmbeddedShader> {
    SHADERS.binary_search_by_key(&name, |shader| shader.name).ok().map(|at| &SHADERS[at])
}

/// Text of the GLSL file with that path, includes too.
pub fn source(path: &str) -> Option<&'static str> {
    SOURCES.binary_search_by_key(&path, |(path, _)| path).ok().map(|at| SOURCES[at].1)
}

/// There is no shader to replace under that name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "no shader is named '{name}'; names are paths in the shaders folder, with #equal, #odd or #even for .tese files"
)]
pub struct UnknownShader {
    /// The name that was asked for.
    pub name: String,
}

/// The shaders that an engine uses: the embedded ones, some of them perhaps replaced.
#[derive(Debug, Clone, Default)]
pub struct ShaderSet {
    overrides: BTreeMap<String, Vec<u32>>,
}

impl ShaderSet {
    /// The shaders as they were built.
    pub fn embedded() -> Self {
        Self::default()
    }

    /// SPIR-V of the shader with that name.
    pub fn get(&self, name: &str) -> Option<&[u32]> {
        self.overrides.get(name).map(Vec::as_slice).or_else(|| shader(name))
    }

    /// The same set with another text for one shader. A name that replaces nothing is an error, lest a test of a changed shader run
    /// the unchanged one.
    pub fn with_override(mut self, name: &str, spirv: Vec<u32>) -> Result<Self, UnknownShader> {
        let shader = embedded(name).ok_or_else(|| UnknownShader { name: name.to_owned() })?;
        self.overrides.insert(shader.name.to_owned(), spirv);
        Ok(self)
    }
}

/// Little-endian words of a SPIR-V file, aligned because they are words.
const fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
    let (chunks, rest) = bytes.as_chunks::<4>();
    assert!(chunks.len() == N && rest.is_empty(), "the file and its length were written together");
    let mut words = [0; N];
    let mut at = 0;
    while at < N {
        words[at] = u32::from_le_bytes(chunks[at]);
        at += 1;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPIRV_MAGIC: u32 = 0x0723_0203;

    #[test]
    fn every_shader_is_found_under_its_name() {
        for embedded in SHADERS {
            assert_eq!(shader(embedded.name), Some(embedded.spirv), "{}", embedded.name);
            assert_eq!(embedded.spirv[0], SPIRV_MAGIC, "{}", embedded.name);
            assert!(source(embedded.path).is_some(), "{}", embedded.path);
        }
        assert_eq!(shader("no/such.comp"), None);
    }

    #[test]
    fn subdivision_stages_are_there() {
        for name in ["subdivide/face.comp", "subdivide/edge.comp", "subdivide/vertex.comp"] {
            assert!(shader(name).is_some(), "{name}");
        }
    }

    #[test]
    fn evaluation_stages_come_in_every_spacing() {
        for spacing in ["equal", "odd", "even"] {
            for capture in ["", ",capture"] {
                assert!(shader(&format!("patch/regular.tese#{spacing}{capture}")).is_some(), "{spacing}{capture}");
            }
        }
    }

    #[test]
    fn an_override_replaces_one_shader() {
        let name = "subdivide/face.comp";
        let set = ShaderSet::embedded().with_override(name, vec![SPIRV_MAGIC]).unwrap();
        assert_eq!(set.get(name), Some(&[SPIRV_MAGIC][..]));
        assert_eq!(set.get("subdivide/edge.comp"), shader("subdivide/edge.comp"));
        assert_eq!(ShaderSet::embedded().get(name), shader(name));
    }

    #[test]
    fn an_override_of_nothing_is_an_error() {
        let error = ShaderSet::embedded().with_override("subdivide/faec.comp", Vec::new()).unwrap_err();
        assert!(error.to_string().contains("faec"), "{error}");
    }

    #[test]
    fn binding_numbers_are_distinct() {
        let text = source("include/bindings.glsl").unwrap();
        let mut numbers: Vec<&str> =
            text.lines().filter_map(|line| line.strip_prefix("#define BINDING_")?.split_whitespace().nth(1)).collect();
        let all = numbers.len();
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len(), all);
        assert_eq!(
            text.lines().find(|line| line.contains("BINDING_POINTS ")).unwrap(),
            format!("#define BINDING_POINTS {}", binding::POINTS)
        );
    }
}
