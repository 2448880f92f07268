//! How a command ends: what it found, or why it could not look, and the exit code of each.
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done; a check or comparison passed |
//! | 1 | a check or comparison failed |
//! | 2 | usage: an option, or a place that cannot be written to |
//! | 3 | an input file that cannot be read or is refused |
//! | 4 | no usable device |

use osculate::EngineError;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Advice where a result cannot be written.
pub(crate) const PLACE_HINT: &str = "name a file in a folder that exists and can be written to, on a disk with room";

/// What a command that could do its work found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Done, or all is as it should be: exit code 0.
    Pass,
    /// A check or comparison failed; the result has been printed: exit code 1.
    Fail,
}

impl Verdict {
    /// [`Verdict::Pass`] if `pass` holds.
    pub(crate) fn of(pass: bool) -> Self {
        if pass { Self::Pass } else { Self::Fail }
    }
}

impl From<Verdict> for ExitCode {
    fn from(verdict: Verdict) -> Self {
        Self::from(match verdict {
            Verdict::Pass => 0,
            Verdict::Fail => 1,
        })
    }
}

/// Whose fault it is that a command could not do its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Usage,
    Input,
    Device,
}

/// Why a command could not do its work: one line, and a hint at what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    kind: Kind,
    message: String,
    hint: Option<String>,
}

impl Failure {
    /// The command line asks for what cannot be done: exit code 2.
    pub(crate) fn usage(message: impl Display) -> Self {
        Self::new(Kind::Usage, message)
    }

    /// An input file cannot be read or is refused: exit code 3. The message names the file.
    pub(crate) fn input(message: impl Display) -> Self {
        Self::new(Kind::Input, message)
    }

    /// No usable device, or it failed: exit code 4.
    pub(crate) fn device(message: impl Display) -> Self {
        Self::new(Kind::Device, message)
    }

    /// Message and hint in a line, for the window.
    #[cfg(feature = "viewer")]
    pub(crate) fn sentence(&self) -> String {
        let hint = self.hint.as_ref().map(|hint| format!("; {hint}"));
        format!("{}{}", self.message, hint.unwrap_or_default())
    }

    /// A file that is read cannot be opened or does not hold what it should: exit code 3.
    pub(crate) fn unreadable(message: impl Display) -> Self {
        Self::input(message).with_hint("check the name, which counts from the current folder, and what the file holds")
    }

    /// A result could not be written to `path`: exit code 2.
    pub(crate) fn output(path: &Path, error: impl Display) -> Self {
        Self::usage(format_args!("{}: cannot write: {error}", path.display())).with_hint(PLACE_HINT)
    }

    /// The same failure with advice in place of what there was.
    pub(crate) fn with_hint(self, hint: impl Display) -> Self {
        Self { hint: Some(one_line(hint)), ..self }
    }

    fn new(kind: Kind, message: impl Display) -> Self {
        Self { kind, message: one_line(message), hint: None }
    }

    /// Says on stderr what went wrong; there is nowhere to report to if that fails.
    pub(crate) fn report(&self) -> ExitCode {
        let mut stderr = std::io::stderr().lock();
        let _nowhere_to_report = writeln!(stderr, "error: {}", self.message);
        if let Some(hint) = &self.hint {
            let _nowhere_to_report = writeln!(stderr, "hint: {hint}");
        }
        ExitCode::from(match self.kind {
            Kind::Usage => 2,
            Kind::Input => 3,
            Kind::Device => 4,
        })
    }
}

/// Why writing a result stopped: the place it went to, or the work that made it.
#[derive(Debug)]
pub(crate) enum WriteError {
    /// The place.
    Io(io::Error),
    /// The work.
    Failed(Failure),
}

impl WriteError {
    /// The failure to report for a result that was to go to `path`.
    pub(crate) fn to(self, path: &Path) -> Failure {
        match self {
            Self::Io(error) => Failure::output(path, error),
            Self::Failed(failure) => failure,
        }
    }
}

impl From<io::Error> for WriteError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Failure> for WriteError {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

impl From<EngineError> for WriteError {
    fn from(error: EngineError) -> Self {
        Self::Failed(error.into())
    }
}

/// Messages of libraries may run over several lines; ours do not.
fn one_line(text: impl Display) -> String {
    let text = text.to_string();
    text.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Reports what the parser of the command line has to say: help goes to stdout and is no failure, anything else is
/// one line and a hint like every other failure.
pub(crate) fn report_parser(error: &clap::Error) -> ExitCode {
    if error.use_stderr() && error.kind() != clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return from_parser(&error.render().to_string()).report();
    }
    let _nowhere_to_report = error.print();
    ExitCode::from(error.exit_code() as u8)
}

/// The parser's text is paragraphs: the error, perhaps a tip, the usage, a pointer to the help.
fn from_parser(text: &str) -> Failure {
    let mut paragraphs = text.split("\n\n");
    let error = paragraphs.next().unwrap_or_default();
    let tip = paragraphs.map(one_line).find_map(|p| p.strip_prefix("tip: ").map(str::to_owned));
    let failure = Failure::usage(error.strip_prefix("error: ").unwrap_or(error));
    failure.with_hint(tip.unwrap_or_else(|| "--help after a command lists its options, with examples".into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_one_line() {
        assert_eq!(Failure::input("a:\n   b\n\n c").message, "a: b c");
    }

    #[test]
    fn the_parsers_paragraphs_become_an_error_and_a_hint() {
        let failure = from_parser(
            "error: the following required arguments were not provided:\n  --output <FILE>\n\nUsage: osculate x\n\nFor more information, try '--help'.\n",
        );
        assert_eq!(failure.message, "the following required arguments were not provided: --output <FILE>");
        assert!(failure.hint.unwrap().contains("--help"));
        let failure = from_parser(
            "error: unexpected argument '--sise' found\n\n  tip: a similar argument exists: '--size'\n\nUsage: x",
        );
        assert_eq!(failure.hint.as_deref(), Some("a similar argument exists: '--size'"));
    }
}
