//! Completes the link of the system's static shaderc.
//!
//! Debian and Ubuntu ship `libshaderc_combined.a` without the glslang and SPIRV-Tools objects it calls, and a
//! `libshaderc.so` whose own dependencies are missing, so `shaderc-sys` alone does not link against either. This
//! script adds the archives that hold the missing symbols. With the feature `build-from-source` there is nothing to add.

use std::env;
use std::path::{Path, PathBuf};
use std::process::exit;

/// Debian's packages, in the order in which a link needs them: callers before callees.
/// OGLCompiler and HLSL became part of glslang in version 14 and are absent there.
const REQUIRED: [&str; 7] =
    ["glslang", "SPIRV", "MachineIndependent", "GenericCodeGen", "OSDependent", "SPIRV-Tools-opt", "SPIRV-Tools"];
const OPTIONAL: [&str; 3] = ["glslang-default-resource-limits", "OGLCompiler", "HLSL"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=SHADERC_LIB_DIR");
    println!("cargo::rerun-if-env-changed=VULKAN_SDK");
    if env::var_os("CARGO_FEATURE_BUILD_FROM_SOURCE").is_some() {
        return;
    }
    let candidates = library_dirs();
    let Some(dir) = candidates.iter().find(|dir| has_archive(dir, "shaderc_combined")) else {
        fail_without_shaderc(&candidates);
    };
    println!("cargo::rerun-if-changed={}", archive(dir, "shaderc_combined").display());
    println!("cargo::rustc-link-search=native={}", dir.display());
    link_archives(dir);
}

/// Emits the archives around `libshaderc_combined.a` in `dir`.
///
/// They are linked whole: the crate that calls into them, `shaderc-sys`, comes after this one on the linker's command line, and
/// a linker that reads archives strictly in order (GNU ld) would have dropped them by then.
fn link_archives(dir: &Path) {
    // An archive that really is combined (Vulkan SDK, other distributions) stands alone.
    if REQUIRED.iter().any(|name| !has_archive(dir, name)) {
        return;
    }
    for name in OPTIONAL.iter().filter(|name| has_archive(dir, name)).chain(&REQUIRED) {
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

fn fail_without_shaderc(dirs: &[PathBuf]) -> ! {
    let looked: Vec<String> = dirs.iter().map(|dir| dir.display().to_string()).collect();
    println!("cargo::error=libshaderc_combined.a was not found in {}", looked.join(", "));
    println!(
        "cargo::error=on Debian or Ubuntu: run tools/setup.sh, or apt-get install libshaderc-dev glslang-dev spirv-tools g++"
    );
    println!(
        "cargo::error=elsewhere: install the Vulkan SDK and set VULKAN_SDK, or build with --features osculate-shader-compiler/build-from-source"
    );
    exit(1);
}
