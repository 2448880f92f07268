//! The embedded sources are what the embedded shaders were made from: tests that change a source rest on it.

use osculate_shader_compiler::{CompileDesc, CompileError, compile};
use osculate_shaders::{EmbeddedShader, INCLUDE_DIRS, SHADERS, embedded, source};

#[test]
fn embedded_sources_compile_to_the_embedded_shaders() {
    for shader in SHADERS {
        assert!(recompile(shader, source).unwrap() == shader.spirv, "{}", shader.name);
    }
}

#[test]
fn a_changed_include_changes_the_shader() {
    let shader = embedded("subdivide/face.comp").unwrap();
    let changed =
        |path: &str| if path == "include/constants.glsl" { Some("#define GROUP_SIZE oops\n") } else { source(path) };
    assert!(recompile(shader, changed).is_err());
}

fn recompile(
    shader: &EmbeddedShader,
    text_of: impl Fn(&str) -> Option<&'static str>,
) -> Result<Vec<u32>, CompileError> {
    compile(&CompileDesc {
        name: shader.path,
        source: text_of(shader.path).expect("every shader's source is embedded"),
        include_dirs: INCLUDE_DIRS,
        load: &|path| text_of(path).map(str::to_owned),
        defines: shader.defines,
        debug_info: cfg!(feature = "debug-info"),
    })
}
