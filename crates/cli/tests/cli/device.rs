//! Choosing and listing devices.

use crate::support::{CAGE, command, osculate};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::tempdir;

#[test]
fn devices_are_listed_with_index_name_kind_and_driver() {
    let folder = tempdir().unwrap();
    let ran = osculate(folder.path(), &["--list-devices"]).exits(0);
    assert_eq!(ran.stderr, "");
    for elsewhere in [&["render", "--list-devices"][..], &["--list-devices", "inspect", "cage.obj"]] {
        assert_eq!(command(folder.path(), elsewhere).output().unwrap().stdout, ran.stdout.as_bytes());
    }
    for (index, line) in ran.stdout.lines().enumerate() {
        assert!(line.trim_start().starts_with(&format!("{index}  ")), "{line}");
        let kinds = ["discrete", "integrated", "virtual", "cpu", "other"];
        assert!(kinds.iter().any(|kind| line.contains(&format!("  {kind} "))) && line.contains("Vulkan 1."), "{line}");
    }
}

#[test]
fn a_device_that_does_not_exist_exits_with_4() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    let arguments = ["render", "cage.obj", "-o", "out.png", "--device", "no such device"];
    osculate(folder.path(), &arguments).fails(4, "no such device");
    let output = command(folder.path(), &arguments[..4]).env("OSCULATE_DEVICE", "neither this").output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(!folder.path().join("out.png").exists());
}

#[test]
fn a_machine_without_a_driver_is_told_what_to_install() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    for arguments in [&["--list-devices"][..], &["sample", "cage.obj"]] {
        let empty = folder.path().join("no-driver.json");
        let output = command(folder.path(), arguments)
            .env("VK_DRIVER_FILES", &empty)
            .env("VK_ICD_FILENAMES", &empty)
            .output()
            .unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.as_slice()), (Some(4), &b""[..]), "{stderr}");
        assert!(stderr.lines().any(|line| line.starts_with("error: ") && line.contains("install")), "{stderr}");
    }
}

#[test]
fn the_reference_needs_no_device() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    let status = command(folder.path(), &["sample", "cage.obj", "--evaluator", "reference", "-o", "out.csv"])
        .env("VK_DRIVER_FILES", "none")
        .env("VK_ICD_FILENAMES", "none")
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(0));
}

/// The file in a folder of kept pipelines.
fn kept_in(folder: &Path) -> PathBuf {
    let files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(files.len(), 1, "{files:?}");
    files[0].clone()
}

#[test]
fn pipelines_are_kept_where_the_environment_says() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    let cache = folder.path().join("kept/here");
    let sample = || {
        let output =
            command(folder.path(), &["sample", "cage.obj", "-v", "-v"]).env("OSCULATE_CACHE", &cache).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    sample();
    let file = kept_in(&cache);
    let whole = fs::read(&file).unwrap();
    assert!(sample().contains(&format!("{}: used", file.display())));
    for damaged in [&whole[..whole.len() / 2], b"no cache at all"] {
        fs::write(&file, damaged).unwrap();
        let stderr = sample();
        assert!(stderr.contains("nothing to be used") && !stderr.contains("warning"), "{stderr}");
        assert_eq!(fs::read(&file).unwrap().len(), whole.len());
    }
}

#[test]
fn a_cache_that_cannot_be_used_is_not_mentioned() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    for cache in ["cage.obj", "cage.obj/inside", "", "off"] {
        let output = command(folder.path(), &["sample", "cage.obj"]).env("OSCULATE_CACHE", cache).output().unwrap();
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]), "{cache:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is kept");
}
