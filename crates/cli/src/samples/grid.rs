//! Regular grids over all faces.

use super::{Place, Places};
use osculate_cage::Cage;

/// The `(n + 1)^2` places of a grid on each face (each sub-face, unless the face is a quad) that is drawn: faces in file
/// order, then sub-faces, t, s. `n` is at least 1.
pub(crate) fn grid(cage: &Cage, n: u32, drawn: &[bool]) -> Places {
    let faces = (0..cage.face_count()).filter(|&face| drawn[face]);
    let subs: Vec<(u32, i32)> =
        faces.flat_map(|face| sub_faces(cage.face(face).len()).map(move |sub| (face as u32, sub))).collect();
    let side = u64::from(n) + 1;
    let len = side.saturating_mul(side).saturating_mul(subs.len() as u64);
    let places =
        subs.into_iter().flat_map(move |(face, sub)| unit_square(n).map(move |(s, t)| Place { face, sub, s, t }));
    Places { len, iterator: Box::new(places) }
}

/// The values of `sub` for a face: -1 alone for a quad, else its corners.
pub(crate) fn sub_faces(corners: usize) -> std::ops::Range<i32> {
    if corners == 4 { -1..0 } else { 0..corners as i32 }
}

/// Multiples of 1/n; quotients rather than products, so that the last is exactly 1.
fn unit_square(n: u32) -> impl Iterator<Item = (f64, f64)> {
    let at = move |i: u32| f64::from(i) / f64::from(n);
    (0..=n).flat_map(move |j| (0..=n).map(move |i| (at(i), at(j))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use osculate_cage::CageDesc;

    /// A quad and a triangle side by side.
    fn cage() -> Cage {
        let positions =
            [(0, 0), (1, 0), (1, 1), (0, 1), (2, 0)].map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
        Cage::new(CageDesc {
            positions: positions.to_vec(),
            face_offsets: vec![0, 4, 7],
            face_vertices: vec![0, 1, 2, 3, 2, 1, 4],
            ..CageDesc::default()
        })
        .unwrap()
    }

    #[test]
    fn s_runs_fastest_then_t_then_sub_then_face() {
        let places = grid(&cage(), 3, &[true; 2]);
        assert_eq!(places.len, 64);
        let places = places.batches().flatten().collect::<Vec<_>>();
        assert_eq!(places.len(), 16 * 4);
        assert_eq!(places[1], Place { face: 0, sub: -1, s: 1.0 / 3.0, t: 0.0 });
        assert_eq!(places[15], Place { face: 0, sub: -1, s: 1.0, t: 1.0 });
        assert_eq!(places[16 + 4], Place { face: 1, sub: 0, s: 0.0, t: 1.0 / 3.0 });
        assert_eq!(places[63], Place { face: 1, sub: 2, s: 1.0, t: 1.0 });
    }

    #[test]
    fn large_grids_come_in_batches() {
        let places = grid(&cage(), 300, &[true; 2]);
        let (len, batches) = (places.len, places.batches().collect::<Vec<_>>());
        assert!(batches.len() > 1);
        assert_eq!(batches.iter().map(|batch| batch.len() as u64).sum::<u64>(), len);
        assert_eq!(batches[1][0].s, f64::from((1 << 16) % 301) / 300.0);
    }

    #[test]
    fn faces_that_are_not_drawn_are_left_out() {
        let places = grid(&cage(), 1, &[false, true]).batches().flatten().collect::<Vec<_>>();
        assert_eq!(places.len(), 12);
        assert!(places.iter().all(|place| place.face == 1));
    }
}
