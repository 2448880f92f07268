//! The pictures of README.md and docs/shading.md.

use crate::cargo;

/// Draws them to docs/images.
pub(crate) fn run() -> anyhow::Result<()> {
    let status = cargo::run(&["run", "--release", "-p", "osculate-tests", "--example", "pictures"], &[])?;
    anyhow::ensure!(status.success(), "the pictures were not drawn");
    Ok(())
}
