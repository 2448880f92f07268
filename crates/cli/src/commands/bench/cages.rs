//! Cages to be measured: files, or a generated one.

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::generated::{torus, torus_quads};
use crate::input::{Input, read, warn};
use osculate_cage::ReadDesc;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Where a cage comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum BenchCage {
    /// A file.
    File(PathBuf),
    /// A torus of about so many quads.
    Torus(u32),
}

impl FromStr for BenchCage {
    type Err = Failure;

    fn from_str(text: &str) -> Result<Self, Failure> {
        torus_quads(text).map_or_else(|| Ok(Self::File(text.into())), |count| count.map(Self::Torus))
    }
}

impl BenchCage {
    /// What results call it: the file's name without ending.
    pub(super) fn name(&self) -> String {
        match self {
            Self::File(file) => file.file_stem().unwrap_or(file.as_os_str()).to_string_lossy().into_owned(),
            Self::Torus(count) => format!("torus:{count}"),
        }
    }

    /// Reads or makes it.
    pub(super) fn read(&self, global: &GlobalArgs) -> Result<Input, Failure> {
        let (cage, name) = match self {
            Self::File(file) => (read(file, &ReadDesc::default(), global)?, file.as_path()),
            Self::Torus(count) => (torus(*count)?, Path::new("torus")),
        };
        warn(name, &cage);
        Ok(Input { boundary: cage.boundary_rule().unwrap_or_default(), cage })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_files_unless_they_say_torus() {
        assert_eq!("a/b.obj".parse::<BenchCage>().unwrap().name(), "b");
        assert_eq!("torus:500".parse::<BenchCage>().unwrap(), BenchCage::Torus(500));
        assert!("torus:5".parse::<BenchCage>().is_err());
    }
}
