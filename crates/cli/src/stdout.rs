//! Results on stdout. Who reads them may stop early (`| head`): that ends the printing, not the command.

use crate::failure::{Failure, WriteError};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

/// Prints what `write` puts out.
pub(crate) fn print<E: Into<WriteError> + From<io::Error>>(
    write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> Result<(), Failure> {
    let mut stdout = BufWriter::new(io::stdout().lock());
    let printed = write(&mut stdout).and_then(|()| Ok(stdout.flush()?));
    // What is still in the buffer has no reader; without this, dropping the buffer would try again.
    let _unread = stdout.into_parts();
    match printed.map_err(E::into) {
        Err(WriteError::Io(error)) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(error.to(Path::new("stdout"))),
        Ok(()) => Ok(()),
    }
}

/// Prints one line.
pub(crate) fn print_line(line: impl std::fmt::Display) -> Result<(), Failure> {
    print::<io::Error>(|out| writeln!(out, "{line}"))
}

/// Prints a value as one line of JSON.
pub(crate) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print::<io::Error>(|out| {
        serde_json::to_writer(&mut *out, value)?;
        writeln!(out)
    })
}
