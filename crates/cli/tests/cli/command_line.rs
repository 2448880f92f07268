//! What every command promises: help, exit codes, one line of error.

use crate::support::{CAGE, command, osculate};
use std::fs;
use std::process::Stdio;
use tempfile::tempdir;

#[test]
fn help_and_version_go_to_stdout() {
    let folder = tempdir().unwrap();
    let help = osculate(folder.path(), &["--help"]).exits(0);
    assert_eq!(help.stderr, "");
    for part in ["sample", "compare", "Examples", "Exit codes", "--device", "--list-devices", "OSCULATE_DEVICE"] {
        assert!(help.stdout.contains(part), "{part} in {}", help.stdout);
    }
    let version = osculate(folder.path(), &["--version"]).exits(0);
    assert!(version.stdout.starts_with("osculate "), "{}", version.stdout);
}

#[test]
fn every_command_has_help_with_examples() {
    let folder = tempdir().unwrap();
    let help = osculate(folder.path(), &["--help"]).exits(0).stdout;
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names: Vec<&str> =
        list.lines().filter_map(|line| line.split_whitespace().next()).filter(|&n| n != "help").collect();
    assert!(names.len() > 1, "{list}");
    for name in names {
        let help = osculate(folder.path(), &[name, "--help"]).exits(0);
        assert!(help.stdout.contains(&format!("osculate {name}")) && help.stdout.contains("Examples:"), "{name}");
    }
}

#[test]
fn usage_errors_exit_with_2() {
    let folder = tempdir().unwrap();
    let run = |arguments: &[&str]| osculate(folder.path(), arguments);
    run(&[]).fails(2, "no command");
    run(&["draw"]).fails(2, "'draw'");
    run(&["compare"]).fails(2, "required arguments");
    run(&["compare", "a.png", "b.png", "--limit", "3"]).fails(2, "'--limit'");
    run(&["sample", "a.obj", "-q", "-v"]).fails(2, "--quiet");
}

#[test]
fn files_that_cannot_be_read_exit_with_3_and_are_named() {
    let folder = tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let run = |file: &str| osculate(folder.path(), &["sample", file]);
    run("missing.obj").fails(3, "missing.obj");
    write("cage.xyz", CAGE);
    run("cage.xyz").fails(3, "cage.xyz");
    write("syntax.obj", "v 0 0 0\nv 1 0 zero\n");
    run("syntax.obj").fails(3, "syntax.obj:2");
    write("empty.obj", "");
    run("empty.obj").fails(3, "empty.obj");
    write("bowtie.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n");
    run("bowtie.obj").fails(3, "bowtie.obj");
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    let mut child = command(folder.path(), &["sample", "cage.obj", "--evaluator", "reference", "--grid", "100"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap().as_str()), (Some(0), ""));
}

#[test]
fn warnings_go_to_stderr_and_can_be_silenced() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("tagged.obj"), format!("{CAGE}t crease 2/1/0 0 1 2.0\n")).unwrap();
    let arguments = ["sample", "tagged.obj", "--evaluator", "reference", "--grid", "1"];
    let loud = osculate(folder.path(), &arguments).exits(0);
    assert_eq!(loud.stderr.lines().count(), 1, "{}", loud.stderr);
    assert!(loud.stderr.starts_with("warning: tagged.obj: ") && loud.stderr.contains("crease"), "{}", loud.stderr);
    let quiet = osculate(folder.path(), &[&arguments[..], &["-q"]].concat()).exits(0);
    assert_eq!((quiet.stderr.as_str(), quiet.stdout), ("", loud.stdout));
}
