//! Choosing and listing devices.

use crate::support::{CAGE, command, osculate};
use std::fs;
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
