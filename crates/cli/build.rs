//! Tells the command which revision it was built from.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
        String::from_utf8(output.stdout).ok().map(|text| text.trim().to_owned())
    };
    // Moves with every commit, and with a change of branch.
    for name in ["logs/HEAD", "HEAD"] {
        if let Some(file) = git(&["rev-parse", "--git-path", name]) {
            println!("cargo::rerun-if-changed={file}");
        }
    }
    let revision = git(&["describe", "--always", "--dirty", "--abbrev=12"]);
    let version = env!("CARGO_PKG_VERSION");
    println!("cargo::rustc-env=OSCULATE_REVISION={}", revision.unwrap_or_else(|| format!("v{version}")));
}
