//! The pictures of README.md and docs.

use crate::cargo;

/// Draws them to docs/images: all, or the moving one alone.
pub(crate) fn run(walk: bool) -> anyhow::Result<()> {
    let all = ["run", "--release", "-p", "osculate-tests", "--example", "pictures"];
    let only: &[&str] = if walk { &["--", "--walk"] } else { &[] };
    let status = cargo::run(&[&all[..], only].concat(), &[])?;
    anyhow::ensure!(status.success(), "the pictures were not drawn");
    Ok(())
}
