//! Accepting what the golden tests draw.

use crate::cargo;

/// Runs the golden tests so that they write their goldens. They fail all the same: a run that blesses proves nothing.
pub(crate) fn run() -> anyhow::Result<()> {
    let build = ["test", "-p", "osculate-tests", "--test", "suite", "--no-run"];
    anyhow::ensure!(cargo::run(&build, &[])?.success(), "the golden tests do not build; nothing was blessed");
    let bless = ["test", "-q", "-p", "osculate-tests", "--test", "suite", "golden::"];
    let status = cargo::run(&bless, &[("OSCULATE_BLESS", "1")])?;
    anyhow::ensure!(!status.success(), "no golden was blessed: the tests passed although each that blesses fails");
    println!("\nLook at each picture that changed:\n  git status tests/goldens\nthen prove that they pass:\n  {PROOF}");
    Ok(())
}

const PROOF: &str = "cargo test -p osculate-tests --test suite golden::";
