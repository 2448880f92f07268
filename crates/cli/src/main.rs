//! The `osculate` command.

mod args;
mod cache;
mod commands;
mod device;
mod failure;
mod generated;
mod input;
#[cfg(unix)]
mod interruption;
mod logging;
mod mesh;
mod options;
mod postponement;
mod progress;
mod samples;
mod shortest;
mod stdout;

use args::{Cli, Command};
use clap::{CommandFactory, Parser};
use failure::{Failure, Verdict};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() && lists_devices() => return end(device::list()),
        Err(error) => return failure::report_parser(&error),
    };
    logging::start(cli.global.quiet, cli.global.verbose);
    #[cfg(unix)]
    interruption::clean_up();
    let start = Instant::now();
    let result = run(cli);
    tracing::info!("{:.2} s", start.elapsed().as_secs_f64());
    #[cfg(unix)]
    if result.is_ok() {
        interruption::conclude();
    }
    end(result)
}

fn end(result: Result<Verdict, Failure>) -> ExitCode {
    match result {
        Ok(verdict) => verdict.into(),
        Err(failure) => failure.report(),
    }
}

/// Whether devices are to be listed, asked of a command line that does not parse: it may be one that lacks what its command
/// needs, which a list of devices does not.
fn lists_devices() -> bool {
    let options = std::env::args_os().skip(1).take_while(|argument| argument != "--");
    options.into_iter().any(|argument| argument == "--list-devices")
}

fn run(cli: Cli) -> Result<Verdict, Failure> {
    let global = &cli.global;
    if global.list_devices {
        return device::list();
    }
    match cli.command {
        Some(Command::Render(args)) => commands::render::run(&args.validate()?, global),
        Some(Command::Sample(args)) => commands::sample::run(&args.validate()?, global),
        Some(Command::Export(args)) => commands::export::run(&args.validate()?, global),
        Some(Command::Bench(args)) => commands::bench::run(&args.validate()?, global),
        Some(Command::Check(args)) => commands::check::run(&args.validate()?, global),
        Some(Command::Inspect(args)) => commands::inspect::run(&args.validate()?, global),
        Some(Command::Repair(args)) => commands::repair::run(&args.validate()?, global),
        Some(Command::Compare(args)) => commands::compare::run(&args.validate()?),
        #[cfg(feature = "viewer")]
        Some(Command::View(args)) => commands::view::run(args.validate(global)?),
        None => Err(no_command()),
    }
}

/// Nothing was asked for: the list of commands is the best answer, but it is not a result.
fn no_command() -> Failure {
    let names: Vec<String> = Cli::command().get_subcommands().map(|command| command.get_name().to_owned()).collect();
    Failure::usage("no command").with_hint(format_args!("the commands are {}; see --help", names.join(", ")))
}
