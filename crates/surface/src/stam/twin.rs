//! Evaluation from a [`Table`] in f32, in the operations and the order that the shaders use.
//!
//! The dominant mode's function and the rest of the surface go together: component w of a `Vec4` is Bezier value of the
//! former, xyz Bezier point of the latter (`Expansion` of the parent module).

use glam::{Vec3, Vec4, Vec4Swizzles};

use super::table::{HEADER, Table};

/// A point of the surface: `normal` is a unit vector, or zero where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point.
    pub position: Vec3,
    /// Its outward normal.
    pub normal: Vec3,
}

/// The coefficient of mode `mode` for a net: a row of the projection times the points relative to V, summed from the last
/// point to the first with compensation (W. Kahan, *Further remarks on reducing truncation errors*, 1965). Mode 0 is the
/// limit position.
///
/// Without compensation the normals at valence 200 are four times less precise; up to 12 it makes no difference.
pub fn project(table: &Table, net: &[Vec3], mode: usize) -> Vec3 {
    let (mut sum, mut lost) = (Vec3::ZERO, Vec3::ZERO);
    for i in (1..table.net_size).rev() {
        let term = table.projection[mode * table.net_size + i] * (net[i] - net[0]) - lost;
        let next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    if mode == 0 { net[0] + sum } else { sum }
}

/// The point of a patch at (u, v) in the unit square. At V, and where a parameter is subnormal, the limit position
/// without a normal.
pub fn patch_point(table: &Table, coefficients: &[Vec3], u: f32, v: f32) -> SurfacePoint {
    let Some(place) = Place::of(u, v) else {
        return SurfacePoint { position: coefficients[0], normal: Vec3::ZERO };
    };
    let mut grid = [Vec4::ZERO; 16];
    expand(table, coefficients, table.patch_function(place.sub_patch, 0), place.level, &mut grid);
    let (bu, qu, bv, qv) = (bernstein3(place.u), bernstein2(place.u), bernstein3(place.v), bernstein2(place.v));
    let row = |j: usize| four(&grid[4 * j..]);
    let rows: [Vec4; 4] = std::array::from_fn(|j| combine4(bu, row(j)));
    let slopes: [Vec4; 4] = std::array::from_fn(|j| combine_differences(qu, row(j)));
    let (du, dv) = (combine4(bv, slopes), combine_differences(qv, rows));
    surface_point(table, coefficients, place.level, combine4(bv, rows), du, dv)
}

/// The point of a side at t in 0..=1 from V; at V as [`patch_point`].
pub fn side_point(table: &Table, record: &[Vec3], t: f32) -> SurfacePoint {
    let Some(place) = Place::of(t, 0.0) else {
        return SurfacePoint { position: record[0], normal: Vec3::ZERO };
    };
    let mut points = [Vec4::ZERO; 8];
    expand(table, record, table.side_function(0), place.level, &mut points);
    let (b, q) = (bernstein3(place.u), bernstein2(place.u));
    let (curve, across) = (four(&points), four(&points[4..]));
    surface_point(table, record, place.level, combine4(b, curve), combine_differences(q, curve), combine4(b, across))
}

/// See `super::place::Place`.
struct Place {
    level: u32,
    sub_patch: usize,
    u: f32,
    v: f32,
}

impl Place {
    fn of(u: f32, v: f32) -> Option<Self> {
        let largest = u.max(v);
        if largest < f32::MIN_POSITIVE {
            return None;
        }
        // The exponent of 1/2, biased, is 126; 1 belongs to level 0 too.
        let level = 126 - (largest.to_bits() >> 23).min(126);
        let scale = f32::from_bits((level + 128) << 23); // 2^(level + 1)
        let (a, b) = (u * scale, v * scale);
        Some(if b < 1.0 {
            Self { level, sub_patch: 0, u: a - 1.0, v: b }
        } else if a < 1.0 {
            Self { level, sub_patch: 2, u: a, v: b - 1.0 }
        } else {
            Self { level, sub_patch: 1, u: a - 1.0, v: b - 1.0 }
        })
    }
}

/// `x^m` for m < 128; exact for m = 0, also at x = 0.
fn power(x: f32, m: u32) -> f32 {
    let (mut result, mut square) = (1.0, x);
    for bit in 0..7 {
        result = if (m >> bit) & 1 == 1 { result * square } else { result };
        square *= square;
    }
    result
}

/// Bezier points at level m: of the dominant mode's function (w), of all others together (xyz, over mu^m). `first` is
/// where the functions begin.
fn expand(table: &Table, coefficients: &[Vec3], first: usize, level: u32, points: &mut [Vec4]) {
    let data = &table.evaluation;
    let stride = points.len();
    for mode in (2..table.modes).rev() {
        let mut coefficient = coefficients[mode];
        if mode == 2 {
            coefficient += (data[3] * level as f32) * coefficients[3];
        }
        coefficient = power(data[HEADER + mode], level) * coefficient;
        for (i, point) in points.iter_mut().enumerate() {
            *point += (data[first + stride * mode + i] * coefficient).extend(0.0);
        }
    }
    for (i, point) in points.iter_mut().enumerate() {
        point.w = data[first + stride + i];
    }
}

/// Puts position and derivatives (of any common scale) of both parts together.
fn surface_point(table: &Table, coefficients: &[Vec3], level: u32, at: Vec4, du: Vec4, dv: Vec4) -> SurfacePoint {
    let data = &table.evaluation;
    let dominant = coefficients[1];
    let offset = (power(data[0], level) * at.w) * dominant + power(data[1], level) * at.xyz();
    let mixed = cross_product(dominant, du.w * dv.xyz() - dv.w * du.xyz());
    let normal = mixed + power(data[2], level) * cross_product(du.xyz(), dv.xyz());
    SurfacePoint { position: coefficients[0] + offset, normal: unit_or_zero(normal) }
}

fn four(points: &[Vec4]) -> [Vec4; 4] {
    [points[0], points[1], points[2], points[3]]
}

fn bernstein3(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [(s * s) * s, 3.0 * (t * (s * s)), 3.0 * ((t * t) * s), (t * t) * t]
}

fn bernstein2(t: f32) -> [f32; 3] {
    let s = 1.0 - t;
    [s * s, 2.0 * (t * s), t * t]
}

fn combine4(w: [f32; 4], [a, b, c, d]: [Vec4; 4]) -> Vec4 {
    ((w[0] * a + w[1] * b) + w[2] * c) + w[3] * d
}

fn combine_differences(w: [f32; 3], [a, b, c, d]: [Vec4; 4]) -> Vec4 {
    (w[0] * (b - a) + w[1] * (c - b)) + w[2] * (d - c)
}

fn cross_product(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

fn unit_or_zero(a: Vec3) -> Vec3 {
    let largest = a.x.abs().max(a.y.abs()).max(a.z.abs());
    if largest.is_nan() || largest <= 0.0 {
        return Vec3::ZERO;
    }
    let b = a / largest;
    b / ((b.x * b.x + b.y * b.y) + b.z * b.z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_any_level() {
        assert_eq!(power(0.0, 0), 1.0);
        assert_eq!([power(-0.5, 3), power(0.5, 126)], [-0.125, 2.0_f32.powi(-126)]);
        assert_eq!(power(0.25, 127), 0.0);
    }

    #[test]
    fn places_are_those_of_f64() {
        for (u, v) in [(1.0, 1.0), (0.5, 0.0), (0.3, 0.7), (0.0, 0.1), (1e-30, 2e-30), (0.499_999_97, 0.2)] {
            let (own, exact) = (Place::of(u, v).expect("not V"), super::super::place::Place::of(u.into(), v.into()));
            let exact = exact.expect("not V");
            assert_eq!((own.level as i32, own.sub_patch), (exact.level, exact.sub_patch), "({u},{v})");
            assert_eq!((f64::from(own.u), f64::from(own.v)), (exact.u, exact.v));
        }
        assert!(Place::of(0.0, 1e-40).is_none() && Place::of(f32::MIN_POSITIVE, 0.0).is_some());
    }
}
