//! Regular grids over all faces.

use super::Places;
use osculate::{SubFace, SurfacePoint};
use osculate_cage::{Cage, sub_faces};

/// The `(n + 1)^2` places of a grid on each face (each sub-face, unless the face is a quad) that is drawn: faces in file
/// order, then sub-faces, t, s. `n` is at least 1.
pub(crate) fn grid(cage: &Cage, n: u32, drawn: &[bool]) -> Places {
    let drawn = (0..cage.face_count()).filter(|&face| drawn[face]);
    let sub_faces: Vec<SubFace> = drawn
        .flat_map(|face| sub_faces(cage.face(face).len()).map(move |sub| SubFace { face: face as u32, sub }))
        .collect();
    let side = u64::from(n) + 1;
    let len = side.saturating_mul(side).saturating_mul(sub_faces.len() as u64);
    let places = sub_faces
        .into_iter()
        .flat_map(move |sub_face| unit_square(n).map(move |(s, t)| SurfacePoint { sub_face, s, t }));
    Places { len, iterator: Box::new(places) }
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
        let place = |face, sub, s, t| SurfacePoint { sub_face: SubFace { face, sub }, s, t };
        assert_eq!(places[1], place(0, -1, 1.0 / 3.0, 0.0));
        assert_eq!(places[15], place(0, -1, 1.0, 1.0));
        assert_eq!(places[16 + 4], place(1, 0, 0.0, 1.0 / 3.0));
        assert_eq!(places[63], place(1, 2, 1.0, 1.0));
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
        assert!(places.iter().all(|place| place.sub_face.face == 1));
    }
}
