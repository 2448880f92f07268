//! What the examples share: their command line, and pictures.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use osculate::DeviceDesc;

pub(crate) type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The command line of an example: files, `-o`, and options with a number.
pub(crate) struct Arguments {
    pub(crate) files: Vec<PathBuf>,
    pub(crate) output: PathBuf,
    /// Core and synchronization validation; any message is an error.
    pub(crate) validation: bool,
    options: Vec<(String, u32)>,
}

impl Arguments {
    /// Reads the command line; nothing if it asks for help, which is given. `output` is where results go unless `-o` says otherwise.
    pub(crate) fn read(help: &str, output: &str) -> Result<Option<Self>> {
        let (files, options, output) = (Vec::new(), Vec::new(), PathBuf::from(output));
        let mut read = Self { files, output, validation: false, options };
        let mut rest = std::env::args().skip(1);
        while let Some(word) = rest.next() {
            let mut value = || rest.next().ok_or_else(|| format!("{word} wants a value; try --help"));
            match word.as_str() {
                "-h" | "--help" => {
                    println!("{help}");
                    return Ok(None);
                }
                "-o" => read.output = value()?.into(),
                "--validation" => read.validation = true,
                option if option.starts_with('-') => {
                    let number = value()?;
                    let number = number.parse().map_err(|_| format!("{option} {number}: not a whole number"))?;
                    if !help.contains(&format!("{option} ")) {
                        return Err(format!("there is no option {option}; try --help").into());
                    }
                    read.options.push((option.to_owned(), number));
                }
                file => read.files.push(file.into()),
            }
        }
        if read.files.is_empty() {
            return Err("which file? Try --help".into());
        }
        Ok(Some(read))
    }

    /// The device to open: that which `OSCULATE_DEVICE` names, or else the best.
    #[allow(dead_code, reason = "one example opens a device of its own")]
    pub(crate) fn device(&self) -> DeviceDesc {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        DeviceDesc { select, validation: self.validation, ..DeviceDesc::default() }
    }

    /// The number behind an option, or else a default.
    pub(crate) fn number(&self, option: &str, default: u32) -> u32 {
        self.options.iter().rev().find(|(name, _)| name == option).map_or(default, |(_, number)| *number)
    }
}

/// Runs an example: says what went wrong.
pub(crate) fn run(example: impl FnOnce() -> Result<()>) -> ExitCode {
    match example() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Fails if validation had anything to say.
pub(crate) fn expect_no_messages(messages: &[String]) -> Result<()> {
    if messages.is_empty() { Ok(()) } else { Err(format!("validation:\n{}", messages.join("\n")).into()) }
}

/// Writes rows of red, green, blue, alpha as a PNG file.
#[allow(dead_code, reason = "one example makes no pictures")]
pub(crate) fn write_png(path: &Path, [width, height]: [u32; 2], rgba: &[u8]) -> Result<()> {
    image::save_buffer(path, rgba, width, height, image::ExtendedColorType::Rgba8)?;
    Ok(())
}

/// The path of a frame: `%04d` in the pattern stands for its number, with that many digits.
#[allow(dead_code, reason = "not all examples write several pictures")]
pub(crate) fn frame_path(pattern: &Path, number: u32) -> Result<PathBuf> {
    let text = pattern.to_str().ok_or("the path of the pictures is not UTF-8")?;
    let place = text.find("%0").and_then(|at| Some((at, text[at + 2..].find('d')? + at + 2)));
    let Some((at, end)) = place else { return Err(format!("{text} has no %04d for the number of the picture").into()) };
    let digits: usize = text[at + 2..end].parse()?;
    Ok(format!("{}{number:0digits$}{}", &text[..at], &text[end + 1..]).into())
}
