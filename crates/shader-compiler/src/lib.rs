//! GLSL to SPIR-V through shaderc, with includes and errors that name file and line.
//!
//! Sources are named by paths relative to one root, with `/` between components (`patch/regular.tese`); where their text
//! comes from is the caller's choice (a folder at build time, embedded text in tests). The target is Vulkan 1.3 with SPIR-V
//! 1.5, the last version whose workgroup sizes need neither `maintenance4` nor a reader that knows `LocalSizeId`. Nothing is
//! optimised here: the optimiser is free to reassociate, and the proof that shared edges agree rests on `precise`
//! arithmetic reaching the driver as written.

mod error;
mod include;
mod stage;

pub use error::{CompileError, Diagnostic};
pub use include::Folder;
pub use stage::Stage;

use std::sync::OnceLock;

use include::Resolver;
use shaderc::{CompileOptions, Compiler, EnvVersion, OptimizationLevel, SpirvVersion, TargetEnv};

/// What to compile, and how.
#[derive(Clone, Copy)]
pub struct CompileDesc<'a> {
    /// Path of the source relative to the root, as errors show it. Its extension gives the stage (see [`Stage::of_path`]).
    pub name: &'a str,
    /// The GLSL text.
    pub source: &'a str,
    /// Folders, relative to the root, searched for an included file after the folder of the including file; `""` is the root.
    pub include_dirs: &'a [&'a str],
    /// Gives the text of the file at a path relative to the root, or nothing if there is no such file.
    pub load: &'a dyn Fn(&str) -> Option<String>,
    /// Macros defined before the first line, with their values.
    pub defines: &'a [(&'a str, Option<&'a str>)],
    /// Whether to embed source text and line numbers, for debuggers and profilers.
    pub debug_info: bool,
}

impl<'a> CompileDesc<'a> {
    /// A source without includes, macros or debug information.
    pub fn new(name: &'a str, source: &'a str) -> Self {
        Self { name, source, include_dirs: &[], load: &|_| None, defines: &[], debug_info: false }
    }
}

/// Compiles one stage to SPIR-V words. Warnings count as errors.
pub fn compile(desc: &CompileDesc) -> Result<Vec<u32>, CompileError> {
    let stage = Stage::of_path(desc.name)?;
    let resolver = Resolver::new(desc.include_dirs, desc.load);
    let options = options(desc, &resolver)?;
    reject_nul(desc)?;
    let artifact = compiler()?
        .compile_into_spirv(desc.source, stage.kind(), desc.name, "main", Some(&options))
        .map_err(CompileError::from_shaderc)?;
    Ok(artifact.as_binary().to_vec())
}

/// Paths of all files that the source includes, directly or not, sorted and without repeats.
///
/// The source is preprocessed with the macros of `desc`, so a file under a false `#if` is not listed.
pub fn list_includes(desc: &CompileDesc) -> Result<Vec<String>, CompileError> {
    let resolver = Resolver::new(desc.include_dirs, desc.load);
    let options = options(desc, &resolver)?;
    reject_nul(desc)?;
    compiler()?.preprocess(desc.source, desc.name, "main", Some(&options)).map_err(CompileError::from_shaderc)?;
    Ok(resolver.loaded())
}

/// The compiler of this process. With the last one goes all that glslang knows of built-in functions, and the next compilation takes several times as long.
fn compiler() -> Result<&'static Compiler, CompileError> {
    static COMPILER: OnceLock<Compiler> = OnceLock::new();
    if let Some(compiler) = COMPILER.get() {
        return Ok(compiler);
    }
    let compiler = Compiler::new().map_err(CompileError::from_shaderc)?;
    Ok(COMPILER.get_or_init(|| compiler))
}

fn options<'a>(desc: &CompileDesc, resolver: &'a Resolver) -> Result<CompileOptions<'a>, CompileError> {
    let mut options = CompileOptions::new().map_err(CompileError::from_shaderc)?;
    options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(SpirvVersion::V1_5);
    options.set_optimization_level(OptimizationLevel::Zero);
    options.set_warnings_as_errors();
    if desc.debug_info {
        options.set_generate_debug_info();
    }
    for (name, value) in desc.defines {
        options.add_macro_definition(name, *value);
    }
    options.set_include_callback(|wanted, kind, from, depth| resolver.resolve(wanted, kind, from, depth));
    Ok(options)
}

/// shaderc takes C strings, and its binding panics on a NUL inside one.
fn reject_nul(desc: &CompileDesc) -> Result<(), CompileError> {
    let Some(at) = desc.source.find('\0') else {
        return Ok(());
    };
    let line = desc.source[..at].matches('\n').count() + 1;
    Err(CompileError::Rejected(vec![Diagnostic {
        file: desc.name.to_owned(),
        line: u32::try_from(line).ok(),
        message: "NUL character in the source".to_owned(),
    }]))
}

#[cfg(test)]
mod tests;
