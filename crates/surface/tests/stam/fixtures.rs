//! Nets under test, the meshes around them, and places to sample.

use glam::DVec3;
use osculate_surface::NetKind;
use osculate_surface::reference::Mesh;

use crate::star::Star;

pub(crate) fn interior(valence: u32) -> NetKind {
    NetKind::Interior { valence }
}

pub(crate) fn crease(faces: u32, quad: u32) -> NetKind {
    NetKind::Crease { faces, quad }
}

/// One kind per star under test: closed ones, then sectors (as their quad 0).
pub(crate) fn stars() -> Vec<NetKind> {
    (2..=12).chain([20, 64, 200]).map(interior).chain((1..=8).chain([12, 20]).map(|k| crease(k, 0))).collect()
}

/// The quads of a star with their kinds: of closed ones, where all are alike, three at most.
pub(crate) fn some_quads(kind: NetKind) -> Vec<(i64, NetKind)> {
    let count = match kind {
        NetKind::Interior { valence: ..=20 } => 3,
        NetKind::Interior { .. } => 1,
        _ => usize::MAX,
    };
    crate::star::quads(kind).into_iter().take(count).collect()
}

/// A bumpy star of coordinates up to about 3, its points moved by up to a tenth, or a fraction of the width of its quads
/// where they are narrower than that.
pub(crate) fn bumpy(kind: NetKind, seed: u64) -> Star {
    let around = match kind {
        NetKind::Regular => 4,
        NetKind::Interior { valence } => valence,
        NetKind::Crease { faces, .. } => 2 * faces,
    };
    let jitter = 0.1 * (8.0 / f64::from(around)).min(1.0);
    Star::over_plane(kind, |x, y| 0.2 * (x * x - y * y) + 0.1 * x, jitter, seed)
}

/// The first two rings of a star as a mesh; face i is quad i at V.
pub(crate) fn mesh(kind: NetKind, star: &Star) -> Mesh {
    let (sectors, open) = match kind {
        NetKind::Interior { valence } => (i64::from(valence), false),
        NetKind::Crease { faces, .. } => (i64::from(faces), true),
        NetKind::Regular => unreachable!("stars have a centre"),
    };
    // Vertex 0 is V; then per spoke i its points (a, 0), and points (a, b) of sector i, a and b in 1..=2.
    let spokes = sectors + i64::from(open);
    let vertex = |i: i64, a: i64, b: i64| -> u32 {
        let (i, a, b) = if a == 0 { (i + 1, b, 0) } else { (i, a, b) };
        let i = if open { i } else { i % sectors };
        let index = match (a, b) {
            (0, _) => 0,
            (_, 0) => 1 + 2 * i + (a - 1),
            _ => 1 + 2 * spokes + 4 * i + 2 * (a - 1) + (b - 1),
        };
        u32::try_from(index).expect("small mesh")
    };
    let mut positions = vec![star.at(0, 0, 0)];
    positions.extend((0..spokes).flat_map(|i| (1..=2).map(move |a| star.at(i, a, 0))));
    positions.extend((0..sectors).flat_map(|i| [(1, 1), (1, 2), (2, 1), (2, 2)].map(|(a, b)| star.at(i, a, b))));
    let faces = [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().flat_map(|(a, b)| {
        (0..sectors).map(move |i| [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)].map(|(a, b)| vertex(i, a, b)))
    });
    Mesh::from_faces(positions, faces)
}

/// Parameters all over the patch, on its sides, and down to `2^-depth` from V; exact in f32.
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
pub(crate) fn parameters(depth: i32, seed: u32) -> Vec<(f64, f64)> {
    // Multiples of the golden ratio, modulo 1, fill the unit interval evenly.
    let mut count = 7.0 * f64::from(seed);
    let mut places = vec![(1.0, 1.0), (0.5, 0.5), (0.5, 0.0), (0.0, 1.0), (0.25, 0.75)];
    for level in 0..=depth {
        let mut next = || {
            count += 1.0;
            f64::from(((count * 0.618_033_988_749_894_8).fract() * 2.0_f64.powi(-level)) as f32)
        };
        places.extend([(next(), next()), (next(), next()), (next(), 0.0), (0.0, next())]);
    }
    places
}

/// The distance of two unit vectors.
pub(crate) fn gap(a: Option<DVec3>, b: DVec3) -> f64 {
    (a.expect("there is a normal") - b).length()
}
