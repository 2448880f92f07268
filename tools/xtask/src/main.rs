//! Chores of the repository, run as `cargo xtask <verb>`.

use clap::{Parser, Subcommand};

mod bless;
mod cages;
mod cargo;
mod fuzz;
mod pictures;
mod schemes;

/// Chores of the repository.
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Accept what the golden tests draw as the new goldens.
    Bless,
    /// Regenerate the shipped cages in assets/cages.
    Cages {
        /// Write nothing; fail if a committed file differs from what would be written.
        #[arg(long)]
        check: bool,
    },
    /// Look for inputs that readers and plans do not bear; see docs/fuzzing.md.
    Fuzz(fuzz::Arguments),
    /// Draw the pictures of README.md and docs anew.
    Pictures {
        /// Only the moving picture of README.md.
        #[arg(long)]
        walk: bool,
    },
    /// Measure the schemes and print the tables of docs/schemes.md.
    Schemes,
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().verb {
        Verb::Bless => bless::run(),
        Verb::Cages { check: false } => cages::write(),
        Verb::Cages { check: true } => cages::check(),
        Verb::Fuzz(arguments) => fuzz::run(&arguments),
        Verb::Pictures { walk } => pictures::run(walk),
        Verb::Schemes => schemes::run(),
    }
}
