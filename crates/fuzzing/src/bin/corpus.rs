//! Between the packed corpora of this crate and folders of inputs, which fuzzers work with.
//!
//! ```text
//! corpus unpack TARGET FOLDER     writes the inputs of the corpus into the folder
//! corpus pack TARGET FOLDER       makes the files of the folder the corpus
//! corpus run TARGET FILE          feeds the target with one file
//! ```

use std::path::Path;
use std::process::ExitCode;
use std::{env, fs, io};

use osculate_fuzzing::{corpus, target};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["unpack", target, folder] => unpack(target, Path::new(folder)),
        ["pack", target, folder] => pack(target, Path::new(folder)),
        ["run", name, file] => fs::read(file).map(|bytes| (target(name).run)(&bytes)),
        _ => Err(io::Error::other("usage: corpus unpack|pack TARGET FOLDER, or corpus run TARGET FILE")),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn unpack(target: &str, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for (number, input) in corpus::read(&corpus::kept(target))?.into_iter().enumerate() {
        fs::write(folder.join(format!("kept-{number:04}")), input)?;
    }
    Ok(())
}

fn pack(target: &str, folder: &Path) -> io::Result<()> {
    let files: Vec<fs::DirEntry> = fs::read_dir(folder)?.collect::<io::Result<_>>()?;
    let inputs = files.iter().map(|file| fs::read(file.path())).collect::<io::Result<Vec<_>>>()?;
    println!("{target}: {} inputs, {} bytes", inputs.len(), inputs.iter().map(Vec::len).sum::<usize>());
    corpus::write(&corpus::kept(target), inputs)
}
