//! Cages that are made rather than read, to see how large ones behave.

use crate::failure::Failure;
use osculate_cage::{Cage, CageDesc};
use std::f64::consts::TAU;

/// The number in `torus:N`; `None` if the name is that of a file.
pub(crate) fn torus_quads(name: &str) -> Option<Result<u32, Failure>> {
    let count = name.strip_prefix("torus:")?.parse().ok().filter(|count| (32..=50_000_000).contains(count));
    Some(count.ok_or_else(|| {
        Failure::usage(format_args!("{name}: not a number of quads from 32 to 50000000"))
            .with_hint("for example torus:20000")
    }))
}

/// A torus twice as many quads long as round, lumpy so that no two patches are alike.
pub(crate) fn torus(count: u32) -> Result<Cage, Failure> {
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
}
