//! Chores of the repository, run as `cargo xtask <verb>`.

use clap::{Parser, Subcommand};

mod cages;

/// Chores of the repository.
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Regenerate the shipped cages in assets/cages.
    Cages {
        /// Write nothing; fail if a committed file differs from what would be written.
        #[arg(long)]
        check: bool,
    },
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().verb {
        Verb::Cages { check: false } => cages::write(),
        Verb::Cages { check: true } => cages::check(),
    }
}
