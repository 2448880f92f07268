//! Runs the command and looks at what it leaves.

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A unit square folded from a quad and two triangles: small, open, not all quads.
pub(crate) const CAGE: &str = "\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0.5
f 1 2 3 4
f 2 5 3
f 5 6 3
";

/// The command with arguments, run in `folder`.
pub(crate) fn osculate(folder: &Path, arguments: &[&str]) -> Ran {
    let output = command(folder, arguments).output().expect("the command was built and can be started");
    Ran::new(arguments, output)
}

/// Commands that open a device.
const ON_A_DEVICE: [&str; 6] = ["bench", "check", "export", "render", "sample", "view"];

/// The command with arguments, not yet started. What opens a device does so under validation, which makes it fail if the layers
/// have anything to say.
pub(crate) fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_osculate"));
    let validated = arguments.first().is_some_and(|name| ON_A_DEVICE.contains(name));
    command
        .args(arguments)
        .args(validated.then_some("--validation"))
        .current_dir(folder)
        .env_remove("OSCULATE_DEVICE")
        .env("OSCULATE_CACHE", "off")
        .stdin(Stdio::null());
    command
}

/// [`command`], which heeds all signals, though the tests themselves may ignore some: jobs in the background of a script do.
#[cfg(target_os = "linux")]
pub(crate) fn interruptible(folder: &Path, arguments: &[&str]) -> Command {
    let plain = command(folder, arguments);
    let mut command = Command::new("env");
    command.arg("--default-signal=INT,TERM,HUP").arg(plain.get_program()).args(plain.get_args()).current_dir(folder);
    for (name, value) in plain.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    command.stdin(Stdio::null());
    command
}

/// Sends a signal by its name.
#[cfg(target_os = "linux")]
pub(crate) fn send(name: &str, process: &std::process::Child) {
    let status = Command::new("kill").args(["-s", name, &process.id().to_string()]).status();
    assert!(status.expect("there is a command kill").success(), "SIG{name} was not sent");
}

/// What a run left.
pub(crate) struct Ran {
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    code: Option<i32>,
    arguments: String,
}

impl Ran {
    pub(crate) fn new(arguments: &[&str], output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("the command prints UTF-8");
        Self {
            stdout: text(output.stdout),
            stderr: text(output.stderr),
            code: output.status.code(),
            arguments: arguments.join(" "),
        }
    }

    /// Requires an exit code.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        let Self { stdout, stderr, arguments, .. } = &self;
        assert_eq!(self.code, Some(code), "osculate {arguments}\nstdout: {stdout}\nstderr: {stderr}");
        self
    }

    /// Requires a failure that prints no result but one line of error and one line of hint, the error holding `part`.
    #[track_caller]
    pub(crate) fn fails(self, code: i32, part: &str) -> Self {
        let ran = self.exits(code);
        assert_eq!(ran.stdout, "", "{}", ran.arguments);
        let lines: Vec<&str> = ran.stderr.lines().filter(|line| !line.starts_with("warning: ")).collect();
        assert!(lines[0].starts_with("error: ") && lines[0].contains(part), "{part:?} in {}", ran.stderr);
        assert!(lines.len() == 1 || (lines.len() == 2 && lines[1].starts_with("hint: ")), "{}", ran.stderr);
        ran
    }
}
