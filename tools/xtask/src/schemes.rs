//! The figures of docs/schemes.md.

use crate::cargo;

/// Prints its tables.
pub(crate) fn run() -> anyhow::Result<()> {
    let status = cargo::run(&["run", "--release", "-p", "osculate-tests", "--example", "schemes"], &[])?;
    anyhow::ensure!(status.success(), "the schemes were not measured");
    Ok(())
}
