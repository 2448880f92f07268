//! The compute stages on the host, in f32 with the device's order of operations: equal bit for bit where the device rounds `/` and `sqrt` correctly. They
//! tell a wrong kernel from a wrong table. Each function has the name of the shader whose twin it is.

mod gathered;

use glam::Vec3;

use crate::{MatrixSource, ProjectionSource, RefineTables, SurfacePlan};

/// Points of all levels and phantom points, from the cage's own points (shaders/subdivide, shaders/records/phantom.comp).
///
/// `cage` holds the points of the cage, in order.
pub fn points(plan: &SurfacePlan, cage: &[Vec3]) -> Vec<Vec3> {
    let mut points = vec![Vec3::ZERO; plan.point_count as usize];
    points[..cage.len()].copy_from_slice(cage);
    for tables in &plan.levels {
        face_points(tables, &mut points);
        edge_points(tables, &mut points);
        vertex_points(tables, &mut points);
    }
    phantom_points(plan, &mut points);
    points
}

/// shaders/subdivide/face.comp.
pub fn face_points(tables: &RefineTables, points: &mut [Vec3]) {
    for (face, &[offset, valence]) in tables.face_spans.iter().enumerate() {
        let indices = &tables.face_indices[offset as usize..(offset + valence) as usize];
        let first = points[indices[0] as usize];
        let sum = indices[1..].iter().fold(first, |sum, &i| sum + points[i as usize]);
        points[tables.first_new as usize + face] = sum / valence as f32;
    }
}

/// shaders/subdivide/edge.comp.
pub fn edge_points(tables: &RefineTables, points: &mut [Vec3]) {
    let first = tables.first_new as usize + tables.face_count();
    for (edge, &quad) in tables.edge_indices.iter().enumerate() {
        let [a, b, c, d] = quad.map(|i| points[i as usize]);
        points[first + edge] = (((a + b) + c) + d) * 0.25;
    }
}

/// shaders/subdivide/vertex.comp.
pub fn vertex_points(tables: &RefineTables, points: &mut [Vec3]) {
    let first = tables.first_new as usize + tables.face_count() + tables.edge_count();
    for (vertex, &[offset, valence]) in tables.vertex_spans.iter().enumerate() {
        let at = |i: u32| points[tables.vertex_indices[(offset + i) as usize] as usize];
        let old = match tables.old_in_rows {
            true => at(2 * valence),
            false => points[first + vertex - tables.old_distance() as usize],
        };
        points[first + vertex] = match valence {
            0 => old,
            1 => ((at(0) + at(1)) + 6.0 * old) * 0.125,
            valence => {
                let n = valence as f32;
                let sum = (0..2 * valence).fold(Vec3::ZERO, |sum, i| sum + at(i));
                old * ((n - 2.0) / n) + sum / (n * n)
            }
        };
    }
}

/// shaders/records/phantom.comp.
pub fn phantom_points(plan: &SurfacePlan, points: &mut [Vec3]) {
    for (phantom, &reflection) in plan.reflections.iter().enumerate() {
        let [a, b, c, d] = reflection.map(|i| points[i as usize]);
        let (first, second) = (2.0 * a - b, 2.0 * c - d);
        points[plan.first_phantom as usize + phantom] = 2.0 * first - second;
    }
}

/// Limit position and unit normal (zero where undefined) of a vertex record.
pub type VertexRecord = [Vec3; 2];

/// C0..C3, D0..D3 of an edge record.
pub type EdgeRecord = [Vec3; 8];

/// shaders/records/vertex_regular.comp and vertex_general.comp.
pub fn vertex_records(plan: &SurfacePlan, points: &[Vec3]) -> Vec<VertexRecord> {
    let regular = plan.vertex_records.regular.iter().map(|&source| regular_vertex(plan, points, source));
    let general = plan.vertex_records.general.iter().map(|source| {
        let [position, t1, t2] = [0, 1, 2].map(|row| matrix_row(plan, points, source, row));
        [position, unit_or_zero(cross_product(t1, t2))]
    });
    regular.chain(general).collect()
}

fn regular_net(plan: &SurfacePlan, points: &[Vec3], patch: u32, i: usize) -> Vec3 {
    points[plan.nets[16 * patch as usize + i] as usize]
}

const SIXTH: f32 = 1.0 / 6.0;
const THIRD: f32 = 1.0 / 3.0;
const TWO_THIRDS: f32 = 2.0 / 3.0;

fn regular_vertex(plan: &SurfacePlan, points: &[Vec3], source: u32) -> VertexRecord {
    let centre = [5, 6, 10, 9][(source & 3) as usize];
    let net = |i: usize| regular_net(plan, points, source >> 2, i);
    let row = |j: usize| {
        let at = centre - 4 + 4 * j;
        let (a, b, c) = (net(at - 1), net(at), net(at + 1));
        ((a + c) * SIXTH + b * TWO_THIRDS, (c - a) * 0.5)
    };
    let ((m0, d0), (m1, d1), (m2, d2)) = (row(0), row(1), row(2));
    let position = (m0 + m2) * SIXTH + m1 * TWO_THIRDS;
    let along_u = (d0 + d2) * SIXTH + d1 * TWO_THIRDS;
    [position, unit_or_zero(cross_product(along_u, (m2 - m0) * 0.5))]
}

/// shaders/records/edge_regular.comp, edge_general.comp and edge_gathered.comp.
pub fn edge_records(plan: &SurfacePlan, points: &[Vec3]) -> Vec<EdgeRecord> {
    let regular = plan.edge_records.regular.iter().map(|&source| regular_edge(plan, points, source));
    let general = plan
        .edge_records
        .general
        .iter()
        .map(|source| [0, 1, 2, 3, 4, 5, 6, 7].map(|row| matrix_row(plan, points, source, row)));
    let vectors = if plan.gathers.edges.is_empty() { Vec::new() } else { projected_vectors(plan, points) };
    let gathered = plan.gathers.edges.iter().map(|source| gathered::edge(plan, &vectors, source));
    regular.chain(general).chain(gathered).collect()
}

fn regular_edge(plan: &SurfacePlan, points: &[Vec3], source: u32) -> EdgeRecord {
    let side = (source & 3) as usize;
    let (start, along, left): (i32, i32, i32) = [(4, 1, 4), (2, 4, -1), (11, -1, -4), (13, -4, 1)][side];
    let rows = [0, 1, 2, 3].map(|i| {
        let at = start + i * along;
        let [l, m, r] = [at + left, at, at - left].map(|i| regular_net(plan, points, source >> 2, i as usize));
        ((l + r) * SIXTH + m * TWO_THIRDS, (l - r) * 0.5)
    });
    let curve = bspline_to_bezier(rows.map(|row| row.0));
    let cross_field = bspline_to_bezier(rows.map(|row| row.1));
    [curve[0], curve[1], curve[2], curve[3], cross_field[0], cross_field[1], cross_field[2], cross_field[3]]
}

fn bspline_to_bezier([a, b, c, d]: [Vec3; 4]) -> [Vec3; 4] {
    [
        (a + c) * SIXTH + b * TWO_THIRDS,
        b * TWO_THIRDS + c * THIRD,
        b * THIRD + c * TWO_THIRDS,
        (b + d) * SIXTH + c * TWO_THIRDS,
    ]
}

/// shaders/records/coefficients.comp and patch_gathered.comp.
pub fn coefficients(plan: &SurfacePlan, points: &[Vec3]) -> Vec<Vec3> {
    let mut vectors = projected_vectors(plan, points);
    for source in &plan.gathers.patches {
        vectors.extend(gathered::control_points(plan, &vectors, source));
    }
    vectors
}

/// shaders/records/coefficients.comp.
fn projected_vectors(plan: &SurfacePlan, points: &[Vec3]) -> Vec<Vec3> {
    let mut vectors = Vec::with_capacity(plan.vector_count as usize);
    for (i, source) in plan.projections.iter().enumerate() {
        let end = plan.projections.get(i + 1).map_or(plan.projected_count(), |next| next.first);
        vectors.extend((0..end - source.first).map(|row| projected(plan, points, source, row)));
    }
    vectors
}

/// A row of a matrix times a net less its first point, summed from the last point to the first with compensation (W. Kahan, *Further remarks on reducing
/// truncation errors*, 1965).
fn projected(plan: &SurfacePlan, points: &[Vec3], source: &ProjectionSource, row: u32) -> Vec3 {
    let net = &plan.nets[source.net as usize..][..source.columns as usize];
    let weights = &plan.weights[(source.weights + row * source.columns) as usize..][..net.len()];
    let origin = points[net[0] as usize];
    let (mut sum, mut lost) = (Vec3::ZERO, Vec3::ZERO);
    for (&weight, &point) in weights.iter().zip(net).skip(1).rev() {
        let term = weight * (points[point as usize] - origin) - lost;
        let next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    if row < source.absolute_rows { origin + sum } else { sum }
}

fn matrix_row(plan: &SurfacePlan, points: &[Vec3], source: &MatrixSource, row: usize) -> Vec3 {
    let columns = source.columns as usize;
    let net = &plan.nets[source.net as usize..][..columns];
    let weights = &plan.weights[source.weights as usize + row * columns..][..columns];
    weights.iter().zip(net).rev().fold(Vec3::ZERO, |sum, (&w, &i)| sum + w * points[i as usize])
}

fn cross_product(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

fn unit_or_zero(a: Vec3) -> Vec3 {
    let largest = a.x.abs().max(a.y.abs()).max(a.z.abs());
    if largest.is_nan() || largest < f32::MIN_POSITIVE {
        return Vec3::ZERO;
    }
    let b = a / largest;
    b / ((b.x * b.x + b.y * b.y) + b.z * b.z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Devices may flush subnormal numbers to zero, and dividing by one would then give no number.
    #[test]
    fn unit_vectors_exist_down_to_normal_numbers() {
        for size in [1e30, 1.0, 1e-18, 1e-37] {
            assert!((unit_or_zero(Vec3::new(size, 2.0 * size, -2.0 * size)).length() - 1.0).abs() < 1e-6, "{size:e}");
        }
        for size in [1e-40, 0.0, f32::NAN] {
            assert_eq!(unit_or_zero(Vec3::splat(size)), Vec3::ZERO, "{size:e}");
        }
    }
}
