//! Completes the link of the system's static shaderc.
//!
//! Debian and Ubuntu ship `libshaderc_combined.a` without the glslang and SPIRV-Tools objects it calls, and a
//! `libshaderc.so` whose own dependencies are missing, so `shaderc-sys` alone does not link against either. This
//! script adds the archives that hold the missing symbols. With the feature `build-from-source` there is nothing to add.

use std::path::{Path, PathBuf};
use std::process::exit;
use std::{env, fs};

/// The archives, as far as a release has them: OGLCompiler and HLSL went with glslang 14, others were merged into `libglslang.a` later.
const ARCHIVES: [&str; 10] = [
    "glslang",
    "glslang-default-resource-limits",
    "SPIRV",
    "MachineIndependent",
    "GenericCodeGen",
    "OSDependent",
    "OGLCompiler",
    "HLSL",
    "SPIRV-Tools-opt",
    "SPIRV-Tools",
];
/// Without these two no release links.
const REQUIRED: [&str; 2] = ["glslang", "SPIRV-Tools-opt"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=SHADERC_LIB_DIR");
    println!("cargo::rerun-if-env-changed=VULKAN_SDK");
    if env::var_os("CARGO_FEATURE_BUILD_FROM_SOURCE").is_some() {
        return;
    }
    let dirs = library_dirs();
    let Some(dir) = dirs.iter().find(|dir| has_archive(dir, "shaderc_combined")) else {
        fail("libshaderc_combined.a", &dirs);
    };
    println!("cargo::rustc-link-search=native={}", dir.display());
    println!("cargo::rerun-if-changed={}", archive(dir, "shaderc_combined").display());
    if !holds_glslang(&archive(dir, "shaderc_combined")) {
        link_archives(dir);
    }
}

/// Whether the archive really is combined, as in the Vulkan SDK: then it has glslang's main source file as a member.
fn holds_glslang(archive: &Path) -> bool {
    const MEMBER: &[u8] = b"ShaderLang.cpp";
    fs::read(archive).is_ok_and(|bytes| bytes.windows(MEMBER.len()).any(|window| window == MEMBER))
}

/// Emits the archives that `libshaderc_combined.a` in `dir` calls.
///
/// They are linked whole: the crate that calls into them, `shaderc-sys`, comes after this one on the linker's command line, and
/// a linker that reads archives strictly in order (GNU ld) would have dropped them by then.
fn link_archives(dir: &Path) {
    if let Some(missing) = REQUIRED.iter().find(|name| !has_archive(dir, name)) {
        fail(&format!("lib{missing}.a"), &[dir.to_owned()]);
    }
    for name in ARCHIVES.iter().filter(|name| has_archive(dir, name)) {
        println!("cargo::rustc-link-lib=static:+whole-archive={name}");
    }
}

/// Where `shaderc-sys` looks for its library, in the same order.
fn library_dirs() -> Vec<PathBuf> {
    if let Some(dir) = env::var_os("SHADERC_LIB_DIR") {
        return vec![PathBuf::from(dir)];
    }
    if let Some(sdk) = env::var_os("VULKAN_SDK") {
        return vec![PathBuf::from(sdk).join("lib")];
    }
    let arch = match env::var("CARGO_CFG_TARGET_ARCH").as_deref() {
        Ok("x86") => "i386".to_owned(),
        Ok(arch) => arch.to_owned(),
        Err(_) => String::new(),
    };
    vec![
        PathBuf::from(format!("/usr/lib/{arch}-linux-gnu")),
        PathBuf::from("/usr/lib64"),
        PathBuf::from("/usr/lib"),
        PathBuf::from("/usr/local/lib"),
    ]
}

fn archive(dir: &Path, name: &str) -> PathBuf {
    dir.join(format!("lib{name}.a"))
}

fn has_archive(dir: &Path, name: &str) -> bool {
    archive(dir, name).is_file()
}

fn fail(missing: &str, dirs: &[PathBuf]) -> ! {
    let looked: Vec<String> = dirs.iter().map(|dir| dir.display().to_string()).collect();
    println!("cargo::error={missing} was not found in {}", looked.join(", "));
    println!(
        "cargo::error=on Debian or Ubuntu run tools/setup.sh, or install libshaderc-dev glslang-dev spirv-tools g++"
    );
    println!(
        "cargo::error=elsewhere install the Vulkan SDK and set VULKAN_SDK, or enable the feature \
         osculate-shader-compiler/build-from-source"
    );
    exit(1);
}
