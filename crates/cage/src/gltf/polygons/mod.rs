//! Polygons from the triangles that glTF is limited to.
//!
//! A cage of quads leaves its maker as quads and arrives as triangles; smoothed as triangles it is another surface. Three signs
//! tell which triangles were one polygon, in falling order of trust: the mark `FB_ngon_encoding`, the order in which exporters write
//! the halves of a quad, and the shape of the quad that two neighbours would make.

mod marked;
mod order;
mod shape;

use std::fmt;

use glam::{DVec2, DVec3};

use crate::Listed;
use crate::listed::plural;
use crate::progress::{Cancelled, Watch};

/// Which signs of polygons are believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolygonRecovery {
    /// The extension `FB_ngon_encoding`: triangles in a row with the same first corner are one polygon.
    pub marked: bool,
    /// Halves of quads in a row, if most triangles of a primitive pair up in one or two patterns of corners.
    pub order: bool,
    /// Neighbours that make good quads, if most triangles of a primitive do.
    pub shape: bool,
}

impl PolygonRecovery {
    /// Triangles stay triangles.
    pub const NONE: Self = Self { marked: false, order: false, shape: false };
}

impl Default for PolygonRecovery {
    fn default() -> Self {
        Self { marked: true, order: true, shape: true }
    }
}

/// What became of the triangles of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct PolygonReport {
    /// Triangles with an area, or in a marked polygon.
    pub triangles: usize,
    /// Polygons with more than three corners that the file marks.
    pub marked: usize,
    /// Triangles of which the file says that they are no part of a larger polygon.
    pub marked_triangles: usize,
    /// Quads found by the order of triangles.
    pub by_order: usize,
    /// Quads found by their shape.
    pub by_shape: usize,
    /// Faces that stay triangles although nothing says that they should.
    pub left: usize,
    /// The first few of them.
    #[serde(skip)]
    pub left_faces: Listed<u32>,
}

impl PolygonReport {
    /// True if there is nothing to doubt: no face was guessed by shape, and none is left over.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        self.by_shape == 0 && self.left == 0
    }

    fn count(&mut self, face: u32, source: FaceSource, corners: usize) {
        match source {
            FaceSource::Marked if corners > 3 => self.marked += 1,
            FaceSource::Marked => self.marked_triangles += 1,
            FaceSource::Order => self.by_order += 1,
            FaceSource::Shape => self.by_shape += 1,
            FaceSource::Triangle => {
                self.left += 1;
                self.left_faces.push(face);
            }
        }
    }
}

impl fmt::Display for PolygonReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sources: Vec<String> = [(self.marked, "marked"), (self.by_order, "by order"), (self.by_shape, "by shape")]
            .into_iter()
            .filter(|(n, _)| *n > 0)
            .map(|(n, how)| format!("{n} {how}"))
            .collect();
        write!(f, "{} give ", plural(self.triangles, "triangle"))?;
        match &sources[..] {
            [] => f.write_str("no larger polygons")?,
            sources => {
                let found = self.marked + self.by_order + self.by_shape;
                write!(f, "{} ({})", plural(found, "larger polygon"), sources.join(", "))?;
            }
        }
        match self.left {
            0 => Ok(()),
            left => write!(f, "; {left} stay as they are: {}", self.left_faces),
        }
    }
}

/// What says that a face is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceSource {
    Triangle,
    Marked,
    Order,
    Shape,
}

/// Points as triangles see them: the vertex they were welded to, where that is, and their texture coordinates.
pub(super) struct Points<'a> {
    pub(super) vertices: &'a [u32],
    pub(super) positions: &'a [DVec3],
    pub(super) uv: &'a [Option<DVec2>],
}

/// Faces as rows of points, in the order of their first triangles.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) offsets: Vec<u32>,
    pub(super) points: Vec<u32>,
    pub(super) report: PolygonReport,
    /// Triangles without area, and marked polygons that collapse.
    pub(super) dropped: usize,
}

impl Faces {
    pub(super) fn new() -> Self {
        Self { offsets: vec![0], ..Self::default() }
    }

    pub(super) fn count(&self) -> u32 {
        self.offsets.len() as u32 - 1
    }

    fn push(&mut self, points: &[u32], source: FaceSource) {
        self.report.count(self.count(), source, points.len());
        self.points.extend_from_slice(points);
        self.offsets.push(self.points.len() as u32);
    }

    /// Turns the faces from `first` on inside out; each keeps its first corner.
    fn reverse_from(&mut self, first: u32) {
        for row in self.offsets[first as usize..].windows(2) {
            self.points[row[0] as usize + 1..row[1] as usize].reverse();
        }
    }
}

/// A run of triangles that were written together: those of one primitive.
pub(super) struct Run<'a> {
    pub(super) triangles: &'a [[u32; 3]],
    /// True if the file marks the polygons among them.
    pub(super) marked: bool,
    /// True if the transform of their node turns them inside out.
    pub(super) flipped: bool,
}

/// How often [`recover`] looks at each triangle, about.
pub(super) const STEPS: usize = 4;

/// Adds the faces of a run.
pub(super) fn recover(
    run: &Run,
    points: &Points,
    recovery: PolygonRecovery,
    watch: &Watch,
    faces: &mut Faces,
) -> Result<(), Cancelled> {
    let first = faces.count();
    watch.advance(run.triangles.len() as u64)?;
    if run.marked && recovery.marked {
        marked::add(run.triangles, points, faces);
    } else {
        let whole: Vec<[u32; 3]> = run.triangles.iter().copied().filter(|t| points.is_whole(t)).collect();
        faces.dropped += run.triangles.len() - whole.len();
        faces.report.triangles += whole.len();
        match find_pairs(&whole, points, recovery, watch)? {
            Some((pairs, source)) => add_pairs(&whole, &pairs, source, faces),
            None => whole.iter().for_each(|triangle| faces.push(triangle, FaceSource::Triangle)),
        }
    }
    if run.flipped {
        faces.reverse_from(first);
    }
    Ok(())
}

/// Pairs of triangles, if they are to be believed; or the end.
type Found<T> = Result<Option<T>, Cancelled>;

/// The quads that triangles make, and what says so.
fn find_pairs(
    triangles: &[[u32; 3]],
    points: &Points,
    recovery: PolygonRecovery,
    watch: &Watch,
) -> Found<(Vec<Pair>, FaceSource)> {
    let by_order = if recovery.order { order::pairs(triangles, points, watch)? } else { None };
    let is_all = |pairs: &Vec<Pair>| 2 * pairs.len() == triangles.len();
    if by_order.as_ref().is_some_and(is_all) || !recovery.shape {
        return Ok(by_order.map(|pairs| (pairs, FaceSource::Order)));
    }
    let by_shape = shape::pairs(triangles, points, watch)?.map(|pairs| (pairs, FaceSource::Shape));
    let Some(by_order) = by_order else { return Ok(by_shape) };
    // Strips look like halves in a row that some do not fit into. Their quads leave nothing over, and are no worse but for rounding.
    let least = mean_quality(&by_order) - 1e-9;
    let is_better = |(pairs, _): &(Vec<Pair>, _)| is_all(pairs) && mean_quality(pairs) >= least;
    Ok(Some(by_shape.filter(is_better).unwrap_or((by_order, FaceSource::Order))))
}

fn mean_quality(pairs: &[Pair]) -> f64 {
    pairs.iter().map(|pair| pair.quality).sum::<f64>() / pairs.len().max(1) as f64
}

/// Adds quads at the place of the earlier of their triangles, and the triangles that are in no pair.
fn add_pairs(triangles: &[[u32; 3]], pairs: &[Pair], source: FaceSource, faces: &mut Faces) {
    let mut owners = vec![None; triangles.len()];
    for pair in pairs {
        pair.triangles.iter().for_each(|&t| owners[t as usize] = Some(pair));
    }
    for ((t, triangle), owner) in (0..).zip(triangles).zip(owners) {
        match owner {
            Some(pair) if pair.triangles[0] == t => faces.push(&pair.quad, source),
            Some(_) => {}
            None => faces.push(triangle, FaceSource::Triangle),
        }
    }
}

/// Two triangles that make a quad.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    /// The triangles, the lower index first.
    triangles: [u32; 2],
    /// The points of the quad, starting with the first corner of the first triangle.
    quad: [u32; 4],
    /// The corner of each triangle that is not on the diagonal: 3 * that of the first + that of the second.
    pattern: u8,
    /// From 0, folded or concave, to 1, a flat rectangle.
    quality: f64,
}

impl Points<'_> {
    fn vertex(&self, point: u32) -> u32 {
        self.vertices[point as usize]
    }

    fn position(&self, point: u32) -> DVec3 {
        self.positions[self.vertex(point) as usize]
    }

    /// True if the corners are three vertices.
    fn is_whole(&self, triangle: &[u32; 3]) -> bool {
        let [a, b, c] = triangle.map(|point| self.vertex(point));
        a != b && b != c && c != a
    }

    /// True for points of one vertex with the same texture coordinates: no diagonal of a polygon is a seam.
    fn joined(&self, a: u32, b: u32) -> bool {
        self.vertex(a) == self.vertex(b) && self.uv(a) == self.uv(b)
    }

    fn uv(&self, point: u32) -> Option<DVec2> {
        self.uv.get(point as usize).copied().flatten()
    }

    /// The quad that two whole triangles make, if they share one edge, run it in opposite directions, and no seam lies along it.
    fn pair(&self, triangles: &[[u32; 3]], [first, second]: [u32; 2]) -> Option<Pair> {
        let [t, u] = [first, second].map(|triangle| triangles[triangle as usize]);
        let next = |corner: usize| (corner + 1) % 3;
        let mut shared = (0..9).filter_map(|pattern| {
            let (i, j) = (pattern / 3, pattern % 3);
            let (a, b) = (next(i), next(next(i)));
            let (c, d) = (next(j), next(next(j)));
            (self.joined(t[a], u[d]) && self.joined(t[b], u[c])).then_some((pattern as u8, i, j))
        });
        let (pattern, i, j) = shared.next()?;
        if shared.next().is_some() || self.vertex(t[i]) == self.vertex(u[j]) {
            return None;
        }
        let mut quad = [t[0], t[1], t[2], u[j]];
        // The new corner belongs after the start of the diagonal.
        quad[next(i) + 1..].rotate_right(1);
        let around = [t[i], t[next(i)], u[j], t[next(next(i))]].map(|point| self.position(point));
        Some(Pair { triangles: [first, second], quad, pattern, quality: quality(around) })
    }
}

/// How good a quad is whose triangles meet along the diagonal from its second corner to its fourth: the angle that is farthest from a
/// right one, by Remacle et al., Blossom-Quad (2012), section 2, times the cosine of the fold. Folded at a right angle or more,
/// concave or without area: 0.
fn quality(corners: [DVec3; 4]) -> f64 {
    let corner = |k: usize| corners[k % 4];
    let normal = |k: usize| (corner(k + 1) - corner(k)).cross(corner(k + 3) - corner(k));
    let (n0, n1) = (normal(0).normalize_or_zero(), normal(2).normalize_or_zero());
    let fold = n0.dot(n1);
    let worst = (0..4).map(|k| {
        let (a, b) = (corner(k + 1) - corner(k), corner(k + 3) - corner(k));
        let angle = if a.cross(b).dot(n0 + n1) > 0.0 { a.angle_between(b) } else { std::f64::consts::PI };
        (std::f64::consts::FRAC_PI_2 - angle).abs()
    });
    let worst = worst.fold(0.0, f64::max);
    let quality = (1.0 - worst / std::f64::consts::FRAC_PI_2) * fold;
    if quality > 0.0 { quality } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quality_of_quads() {
        let quad = |corners: [[f64; 3]; 4]| quality(corners.map(DVec3::from_array));
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
        close(quad([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]), 1.0);
        let h = 0.75_f64.sqrt();
        close(quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.5, h, 0.0], [0.5, h, 0.0]]), 2.0 / 3.0);
        close(quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.2, 0.0], [0.0, 1.0, 0.0]]), 0.0);
        close(quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]), 0.0);
        close(quad([[0.0; 3]; 4]), 0.0);
    }

    #[test]
    fn a_pair_starts_with_its_first_triangle() {
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let points = Points { vertices: &[0, 1, 2, 3], positions: &positions, uv: &[] };
        for (first, second, quad, pattern) in [
            ([0, 1, 2], [0, 2, 3], [0, 1, 2, 3], 5),
            ([0, 1, 2], [2, 3, 0], [0, 1, 2, 3], 4),
            ([0, 1, 3], [1, 2, 3], [0, 1, 2, 3], 1),
            ([2, 0, 1], [0, 2, 3], [2, 3, 0, 1], 8),
            ([1, 2, 0], [3, 0, 2], [1, 2, 3, 0], 0),
        ] {
            let pair = points.pair(&[first, second], [0, 1]).expect("a pair");
            assert_eq!((pair.quad, pair.pattern), (quad, pattern), "{first:?} {second:?}");
            assert!((pair.quality - 1.0).abs() < 1e-12, "{first:?} {second:?}");
        }
        assert_eq!(points.pair(&[[0, 1, 2], [0, 1, 3]], [0, 1]), None, "the same way");
        assert_eq!(points.pair(&[[0, 1, 2], [2, 1, 0]], [0, 1]), None, "back to back");
    }

    #[test]
    fn no_quad_crosses_a_seam() {
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let mut uv = [Some(DVec2::ZERO); 6];
        let vertices = [0, 1, 2, 3, 0, 2];
        let pair = |uv: &[Option<DVec2>]| {
            Points { vertices: &vertices, positions: &positions, uv }.pair(&[[0, 1, 2], [4, 5, 3]], [0, 1])
        };
        assert!(pair(&uv).is_some());
        uv[5] = Some(DVec2::X);
        assert!(pair(&uv).is_none());
    }
}
