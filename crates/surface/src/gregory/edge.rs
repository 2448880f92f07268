//! Edge records: the curve of a side and the cross derivative along it.

use super::fan::{Combine, Weights, combine};
use crate::matrix::Matrix;
use crate::net::NetKind;

/// The record of side `side`, walked from corner `side` to the next: 8 x net size. Rows 0..4 are the cubic Bezier curve
/// C, rows 4..8 the cubic Bezier form of the cross derivative D. The surface normal on the edge is C' x D.
///
/// D is half the difference (left - right)/2 of the derivatives of the two patches across the edge per unit parameter,
/// left being into this patch; on a sharp side the other patch is the reflection of this one. Both patches of an edge
/// give the same record but for the direction: the neighbour's C is reversed, its D reversed and negated.
///
/// Between regular corners this is the bicubic B-spline edge: C = Bezier(m), D = Bezier(d) with m = (L+R)/6 + 2M/3 and
/// d = (L-R)/2 of the rows of points left of, on and right of the edge.
///
/// Where the edges of V are collinear (valence 2, or one face on a boundary) D would vanish at V; it is divided by the
/// parameter from there, which keeps its direction and gives C' x D a limit at V.
///
/// # Panics
/// If `kind` is not valid or `side > 3`.
pub fn edge(kind: NetKind, side: usize) -> Matrix {
    assert!(side < 4, "a quad has sides 0 to 3, not {side}");
    let corners = super::corners(kind);
    let (a, b) = (&corners[side], &corners[(side + 1) % 4]);
    let (ea, eb) = (a.plus(), b.minus());
    let curve = [a.position(), a.edge_point(ea), b.edge_point(eb), b.position()];
    let negated = |row: Weights| combine(&[(-1.0, &row)]);
    let cross = [a.cross_end(ea), a.cross_inner(ea), negated(b.cross_inner(eb)), negated(b.cross_end(eb))];
    let cross = settle_ends(cross, &curve, [a.cross_end_kind(), b.cross_end_kind()]);
    Matrix::from_rows(&[curve, cross].concat())
}

/// What becomes of the cross derivative D of an edge at one of its ends, V.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CrossEnd {
    /// Nothing: D crosses the edge there.
    Plain,
    /// The two edges of V are collinear and D(0) = 0: D is divided by t, which keeps its direction.
    Vanishing,
    /// V belongs to a single smooth face, which is flat there: D(0) is the tangent of the edge walked backwards. The
    /// normal stays the same when (1-t) C' is added, after which D vanishes at V and is divided by t. Point 0 of D is
    /// given as that zero already.
    Opposed,
}

impl CrossEnd {
    /// The number by which shaders know it (`CROSS_END_*` in shaders/include/constants.glsl).
    pub const fn number(self) -> u32 {
        match self {
            Self::Plain => 0,
            Self::Vanishing => 1,
            Self::Opposed => 2,
        }
    }
}

/// The cross derivative of an edge, given with the points that its two ends contribute, as its record has it.
pub(super) fn settle_ends<P: Combine>(cross: [P; 4], curve: &[P; 4], ends: [CrossEnd; 2]) -> [P; 4] {
    let mut cross = cross;
    if ends[0] == CrossEnd::Opposed {
        cross = plus_fading_tangent(cross, curve);
    }
    if ends[1] == CrossEnd::Opposed {
        cross = reversed(plus_fading_tangent(reversed(cross), &reversed(curve.clone())));
    }
    if ends[0] != CrossEnd::Plain {
        cross = over_parameter(cross);
    }
    if ends[1] != CrossEnd::Plain {
        cross = reversed(over_parameter(reversed(cross)));
    }
    cross
}

/// `D + (1-t) C'` for the cross derivative into a single face, which is `-C'` at its corner: the sum vanishes there and
/// has the same normal. Point 0 of D is given as that zero already.
fn plus_fading_tangent<P: Combine>(cross: [P; 4], curve: &[P; 4]) -> [P; 4] {
    let step = |i: usize| P::combine(&[(1.0, &curve[i + 1]), (-1.0, &curve[i])]);
    let [d0, d1, d2, d3] = cross;
    [d0, P::combine(&[(1.0, &d1), (2.0, &step(1))]), P::combine(&[(1.0, &d2), (1.0, &step(2))]), d3]
}

/// `D / t` for a cubic D with D(0) = 0, a quadratic raised to degree 3.
fn over_parameter<P: Combine>([_, d1, d2, d3]: [P; 4]) -> [P; 4] {
    [P::combine(&[(3.0, &d1)]), P::combine(&[(1.0, &d1), (1.0, &d2)]), P::combine(&[(1.0, &d2), (1.0 / 3.0, &d3)]), d3]
}

/// The same polynomial walked the other way.
fn reversed<P>([p0, p1, p2, p3]: [P; 4]) -> [P; 4] {
    [p3, p2, p1, p0]
}
