//! Goldens: pictures kept beside the tests, and what happens when they are missing or differ.
//!
//! A golden changes only by intent. A missing golden fails; blessing (`OSCULATE_BLESS=1`) writes the golden and
//! fails that run too, so that no green run ever rests on pictures nobody has looked at. What a failing test drew
//! is left in a side folder, never beside the goldens.

use crate::flip::{CompareDesc, Comparison, compare};
use crate::limits::{Excess, Limits};
use crate::picture::{CompareError, Picture, load};
use crate::whole_file;
use std::io;
use std::path::{Path, PathBuf};

/// The variable that turns a run into a blessing when it is `1`.
pub const BLESS_VARIABLE: &str = "OSCULATE_BLESS";

/// The largest golden in bytes; small pictures show as much, and every clone carries them for ever.
pub const MAX_GOLDEN_BYTES: usize = 64 * 1024;

/// A folder of goldens named `NAME.png`.
#[derive(Clone, Debug)]
pub struct Goldens {
    /// Where the goldens are.
    pub folder: PathBuf,
    /// Where `NAME.actual.png` and `NAME.diff.png` of failures go; made when needed.
    pub side_folder: PathBuf,
    /// Whether checks write the goldens (and fail) instead of comparing.
    pub bless: bool,
}

/// Why a picture does not pass as its golden.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GoldenError {
    /// There is no golden of this name.
    #[error("golden {name} is missing; look at {} and, if it is right, run with {BLESS_VARIABLE}=1", actual.display())]
    Missing {
        /// Name of the golden.
        name: String,
        /// The picture that was drawn.
        actual: PathBuf,
    },
    /// The picture is not the golden.
    #[error("golden {name}: {excess}; see {} and {}", actual.display(), diff.display())]
    Differs {
        /// Name of the golden.
        name: String,
        /// The figures.
        excess: Excess,
        /// The picture that was drawn.
        actual: PathBuf,
        /// Where it differs.
        diff: PathBuf,
    },
    /// The golden could not be read, has another size, or a file could not be written.
    #[error("golden {name}: {source}")]
    Unusable {
        /// Name of the golden.
        name: String,
        /// What went wrong.
        source: CompareError,
    },
    /// The golden, or the picture that was to become it, is above [`MAX_GOLDEN_BYTES`].
    #[error("golden {name} has {bytes} bytes; at most {MAX_GOLDEN_BYTES} are allowed, draw it smaller")]
    TooLarge {
        /// Name of the golden.
        name: String,
        /// Its size in bytes.
        bytes: usize,
    },
    /// The golden was written; this run fails all the same.
    #[error("golden {name}: blessed, run again without {BLESS_VARIABLE}")]
    Blessed {
        /// Name of the golden.
        name: String,
    },
    /// The name would leave the folder.
    #[error("golden name {0:?} is refused; letters, digits, '-' and '_' are allowed")]
    BadName(String),
}

impl Goldens {
    /// The goldens of `folder`, as the environment asks for: failures go to [`side_folder`], and
    /// [`BLESS_VARIABLE`] is obeyed.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        let bless = std::env::var_os(BLESS_VARIABLE).is_some_and(|value| value == "1");
        Self { folder: folder.into(), side_folder: side_folder(), bless }
    }

    /// Compares `picture` with the golden `name`, or blesses it.
    ///
    /// # Errors
    ///
    /// [`GoldenError`] in every case but a golden that could be read and stays within `limits`.
    pub fn check(&self, name: &str, picture: &Picture, limits: &Limits) -> Result<Comparison, GoldenError> {
        if !is_plain(name) {
            return Err(GoldenError::BadName(name.to_owned()));
        }
        let check = Check { goldens: self, name, picture };
        if self.bless { Err(check.bless()) } else { check.compare(limits) }
    }
}

/// The folder `goldens` of the build folder that the running test program lies in.
///
/// Test programs are `BUILD/PROFILE/deps/NAME`; anything else gets a folder beside the program.
#[must_use]
pub fn side_folder() -> PathBuf {
    let program = std::env::current_exe().unwrap_or_default();
    let deps = program.parent().filter(|folder| folder.ends_with("deps"));
    let build = deps.and_then(|deps| deps.ancestors().nth(2)).or(program.parent());
    build.unwrap_or(Path::new(".")).join("goldens")
}

fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    !name.is_empty() && name.chars().all(plain)
}

/// One picture against one golden.
struct Check<'a> {
    goldens: &'a Goldens,
    name: &'a str,
    picture: &'a Picture,
}

impl Check<'_> {
    fn compare(&self, limits: &Limits) -> Result<Comparison, GoldenError> {
        let golden = self.golden_path();
        let bytes = match std::fs::metadata(&golden) {
            Ok(found) => found.len() as usize,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(self.missing()),
            Err(source) => {
                return Err(self.unusable(CompareError::Read { path: golden, source }));
            }
        };
        if bytes > MAX_GOLDEN_BYTES {
            return Err(GoldenError::TooLarge { name: self.name.to_owned(), bytes });
        }
        let reference = load(&golden).map_err(|error| self.unusable(error))?;
        let comparison =
            compare(&reference, self.picture, &CompareDesc::default()).map_err(|error| self.unusable(error))?;
        match limits.check(&comparison) {
            Ok(()) => Ok(comparison),
            Err(excess) => Err(self.differs(&comparison, excess)),
        }
    }

    fn bless(&self) -> GoldenError {
        let path = self.golden_path();
        let png = match self.picture.to_png() {
            Ok(png) if png.len() > MAX_GOLDEN_BYTES => {
                return GoldenError::TooLarge { name: self.name.to_owned(), bytes: png.len() };
            }
            Ok(png) => png,
            Err(source) => return self.unusable(CompareError::Write { path, source }),
        };
        let written = std::fs::create_dir_all(&self.goldens.folder)
            .and_then(|()| whole_file::write(&path, |out| out.write_all(&png)));
        match written {
            Ok(()) => GoldenError::Blessed { name: self.name.to_owned() },
            Err(error) => self.unusable(CompareError::Write { path, source: error.into() }),
        }
    }

    fn missing(&self) -> GoldenError {
        match self.write_aside("actual", self.picture) {
            Ok(actual) => GoldenError::Missing { name: self.name.to_owned(), actual },
            Err(error) => self.unusable(error),
        }
    }

    fn differs(&self, comparison: &Comparison, excess: Excess) -> GoldenError {
        let sides = self
            .write_aside("actual", self.picture)
            .and_then(|actual| Ok((actual, self.write_aside("diff", &comparison.picture())?)));
        match sides {
            Ok((actual, diff)) => GoldenError::Differs { name: self.name.to_owned(), excess, actual, diff },
            Err(error) => self.unusable(error),
        }
    }

    /// The error for a golden that cannot be judged; what was drawn is kept if it can be.
    fn unusable(&self, source: CompareError) -> GoldenError {
        let _kept_if_possible = self.write_aside("actual", self.picture);
        GoldenError::Unusable { name: self.name.to_owned(), source }
    }

    fn write_aside(&self, what: &str, picture: &Picture) -> Result<PathBuf, CompareError> {
        let path = self.goldens.side_folder.join(format!("{}.{what}.png", self.name));
        std::fs::create_dir_all(&self.goldens.side_folder)
            .map_err(|error| CompareError::Write { path: self.goldens.side_folder.clone(), source: error.into() })?;
        picture.write(&path)?;
        Ok(path)
    }

    fn golden_path(&self) -> PathBuf {
        self.goldens.folder.join(format!("{}.png", self.name))
    }
}
