//! Surfaces with texture coordinates, heights and colours.

use glam::DVec2;
use osculate::{ColorMap, Coloring, Displacement, Engine, HeightMap, MapPlacement, MapsDesc, Scheme, Surface};
use osculate_cage::{Cage, CageDesc, FaceVarying};

use crate::surface_of;

/// The cage with other texture coordinates, which `at` gives for each face and corner.
///
/// # Panics
/// If that makes no valid cage.
pub fn with_uv(cage: &Cage, at: impl Fn(usize, usize) -> DVec2) -> Cage {
    let corners = (0..cage.face_count()).flat_map(|face| (0..cage.face(face).len()).map(move |corner| (face, corner)));
    let values: Vec<DVec2> = corners.map(|(face, corner)| at(face, corner)).collect();
    let indices = (0..values.len() as u32).collect();
    let desc = CageDesc {
        positions: cage.positions().to_vec(),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
        tags: cage.tags().clone(),
        uv: Some(FaceVarying { values, indices }),
        ..CageDesc::default()
    };
    Cage::new(desc).unwrap_or_else(|error| panic!("{error}"))
}

/// The cage with seams at all edges: each face is a polygon of its own size and place, some beyond the unit square.
pub fn torn(cage: &Cage) -> Cage {
    with_uv(cage, |face, corner| {
        let n = cage.face(face).len() as f64;
        let (turn, f) = (std::f64::consts::TAU * (corner as f64 + 0.3 * face as f64) / n, face as f64);
        let centre = DVec2::new(1.7 * (0.618 * f).fract() - 0.3, 1.3 * (0.414 * f).fract() - 0.2);
        centre + (0.1 + 0.05 * (f * 0.73).fract()) * DVec2::new(turn.cos(), turn.sin())
    })
}

/// The cage seen from above: x and z, as parts of its box.
pub fn from_above(cage: &Cage) -> Cage {
    let (low, size) = (cage.bounds().min, cage.bounds().max - cage.bounds().min);
    with_uv(cage, |face, corner| {
        let part = (cage.positions()[cage.face(face)[corner] as usize] - low) / size;
        DVec2::new(part.x, part.z)
    })
}

/// A map of so many texels a side, from 0 to 1 in u and v.
///
/// # Panics
/// If a height is not finite.
pub fn heights(size: u32, at: impl Fn(f64, f64) -> f64) -> HeightMap {
    let coordinate = |i: u32| (f64::from(i) + 0.5) / f64::from(size);
    let texels = (0..size * size).map(|i| at(coordinate(i % size), coordinate(i / size)) as f32).collect();
    HeightMap::new("heights", [size, size], texels).unwrap_or_else(|error| panic!("{error}"))
}

/// Waves and noise: no two texels are alike.
pub fn rough() -> HeightMap {
    heights(64, |u, v| {
        let noise = (43758.5453 * (127.1 * u + 311.7 * v).sin()).fract();
        (9.0 * u).sin() * (7.0 * v).cos() + 0.4 * noise
    })
}

/// Rows of overlapping scales, as many as `rows` in v.
pub fn scales(size: u32, rows: f64) -> HeightMap {
    heights(size, |u, v| {
        let scale = |row: f64| {
            let shift = if row.rem_euclid(2.0) < 1.0 { 0.0 } else { 0.5 };
            let x = (0.5 * rows * u + shift).rem_euclid(1.0) - 0.5;
            let y = rows * v - row;
            let radius = (x * x * 4.0 + (0.62 * y - 0.6) * (0.62 * y - 0.6) * 1.9).sqrt();
            (1.0 - radius).max(0.0).sqrt() * (1.0 - 0.32 * y)
        };
        let row = (rows * v).floor();
        scale(row).max(scale(row - 1.0))
    })
}

/// The surface of a cage, moved by a map.
///
/// # Panics
/// If it cannot be made.
pub fn displaced(engine: &Engine, cage: &Cage, scheme: Scheme, map: &HeightMap, scale: f64, bias: f64) -> Surface {
    let displacement = Some(Displacement { map, scale, bias, placement: MapPlacement::default() });
    let surface = surface_of(engine, cage, scheme, None).expect("something to draw");
    let desc = MapsDesc { displacement, ..MapsDesc::default() };
    surface.with_maps(cage, &desc).unwrap_or_else(|error| panic!("{error}"))
}

/// The same, painted: low places in the first colour, high ones in the second, sRGB.
///
/// # Panics
/// If it cannot be made.
pub fn painted(engine: &Engine, cage: &Cage, map: &HeightMap, scale: f64, [low, high]: [[u8; 3]; 2]) -> Surface {
    let mix = |height: f32, i: usize| {
        let part = height.clamp(0.0, 1.0);
        (f32::from(low[i]) + part * (f32::from(high[i]) - f32::from(low[i]))).round() as u8
    };
    let texels = map.heights().iter().map(|&h| [mix(h, 0), mix(h, 1), mix(h, 2), 255]).collect();
    let colors = ColorMap::new("colours", map.size(), texels).unwrap_or_else(|error| panic!("{error}"));
    let placement = MapPlacement::default();
    let desc = MapsDesc {
        displacement: Some(Displacement { map, scale, bias: 0.0, placement }),
        coloring: Some(Coloring { map: Some(&colors), factor: [1.0; 3], placement }),
        ..MapsDesc::default()
    };
    let surface = surface_of(engine, cage, Scheme::default(), None).expect("something to draw");
    surface.with_maps(cage, &desc).unwrap_or_else(|error| panic!("{error}"))
}
