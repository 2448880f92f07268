//! Errors of compilation, with the place of each.

use std::fmt;

/// Why a source could not be compiled.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CompileError {
    /// The file name does not say which stage the source is for.
    #[error("{name}: unknown shader stage; the file name must end in .vert, .tesc, .tese, .frag or .comp")]
    UnknownStage {
        /// Name of the source.
        name: String,
    },
    /// The compiler found errors in the source or in what it includes.
    #[error("{}", join(.0))]
    Rejected(Vec<Diagnostic>),
    /// shaderc itself failed.
    #[error("shaderc failed: {0}")]
    Internal(String),
}

/// One message of the compiler and the place it is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Path of the file, relative to the root: the source itself or an included file.
    pub file: String,
    /// Line, from 1; none where the message is about the file as a whole.
    pub line: Option<u32>,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.message),
            None => write!(f, "{}: {}", self.file, self.message),
        }
    }
}

impl CompileError {
    pub(crate) fn from_shaderc(error: shaderc::Error) -> Self {
        let shaderc::Error::CompilationError(_, text) = &error else {
            return Self::Internal(error.to_string());
        };
        let diagnostics: Vec<_> = text.lines().filter_map(parse_line).collect();
        if diagnostics.is_empty() {
            return Self::Internal(error.to_string());
        }
        Self::Rejected(diagnostics)
    }
}

fn join(diagnostics: &[Diagnostic]) -> String {
    let lines: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

/// Reads `file:line: error: message` or `file: error: message`; other lines (counts, blank lines) give nothing.
fn parse_line(text: &str) -> Option<Diagnostic> {
    let (place, message) = [": error: ", ": warning: "].iter().find_map(|mark| text.split_once(mark))?;
    let numbered = place.rsplit_once(':').and_then(|(file, line)| Some((file, line.parse().ok()?)));
    let (file, line) = numbered.map_or((place, None), |(file, line)| (file, Some(line)));
    Some(Diagnostic { file: file.to_owned(), line, message: message.to_owned() })
}
