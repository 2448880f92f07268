//! Cages to be measured: files, or a generated one.

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::input::{Input, read, warn};
use osculate_cage::{Cage, CageDesc, ReadDesc};
use std::f64::consts::TAU;
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
        let Some(count) = text.strip_prefix("torus:") else { return Ok(Self::File(text.into())) };
        let count = count.parse().ok().filter(|count| (32..=50_000_000).contains(count));
        count.map(Self::Torus).ok_or_else(|| {
            Failure::usage(format_args!("{text}: not a number of quads from 32 to 50000000"))
                .with_hint("for example torus:20000")
        })
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

/// A torus twice as many quads long as round, lumpy so that no two patches are alike.
fn torus(count: u32) -> Result<Cage, Failure> {
    let round = f64::from(count / 2).sqrt().round() as u32;
    let along = count / round;
    let point = |i: u32, j: u32| {
        let (u, v) = (TAU * f64::from(i) / f64::from(along), TAU * f64::from(j) / f64::from(round));
        let tube = 0.35 + 0.05 * (5.0 * u).sin() * (3.0 * v).cos();
        let radius = 1.0 + tube * v.cos();
        glam::DVec3::new(radius * u.cos(), tube * v.sin(), -radius * u.sin())
    };
    let vertex = |i: u32, j: u32| (i % along) * round + j % round;
    let cells = || (0..along).flat_map(|i| (0..round).map(move |j| (i, j)));
    let desc = CageDesc {
        positions: cells().map(|(i, j)| point(i, j)).collect(),
        face_offsets: (0..=along * round).map(|face| 4 * face).collect(),
        face_vertices: cells()
            .flat_map(|(i, j)| [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)])
            .collect(),
        ..CageDesc::default()
    };
    Cage::new(desc).map_err(Failure::input)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tori_are_closed_and_of_the_size_asked_for() {
        for count in [32, 1000, 20_000] {
            let cage = torus(count).unwrap();
            let faces = cage.face_count() as f64;
            assert!((0.9..=1.1).contains(&(faces / f64::from(count))), "{faces} of {count}");
            assert_eq!(cage.positions().len(), cage.face_count(), "Euler number 0");
        }
    }

    #[test]
    fn names_are_files_unless_they_say_torus() {
        assert_eq!("a/b.obj".parse::<BenchCage>().unwrap().name(), "b");
        assert_eq!("torus:500".parse::<BenchCage>().unwrap(), BenchCage::Torus(500));
        assert!("torus:5".parse::<BenchCage>().is_err());
    }
}
