//! Gregory patches as linear maps of a net: control points, shared edges, corner limits.
//!
//! Loop, Schaefer, Ni and Castano, *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation*
//! (2009), section 3. Symbols kept: p (corner), e (edge point), f (face point), r (cross derivative), `+` towards the
//! next corner, `-` towards the previous one.

mod evaluate;
mod fan;

pub use evaluate::{bezier_grid, evaluate};

use crate::matrix::Matrix;
use crate::net::NetKind;
use fan::{Corner, Weights, combine};

/// The 20 control points of the bicubic Gregory patch: 20 x net size, row `5 i + {0: p, 1: e+, 2: e-, 3: f+, 4: f-}`
/// for corner i of (0,0), (1,0), (1,1), (0,1).
///
/// * `Regular`: exactly the bicubic B-spline patch (`f+ = f-`).
/// * `Interior`: tangent-plane continuous with its neighbours; position and tangent plane at V are those of the limit.
///   At valence 2 the edge points lie on one line through p, as far as the limit surface allows no tangent plane; the
///   patch is finite, its edges are those of its neighbour and the normals of both agree along them.
/// * `Crease`: the sharp sides are exactly the cubic B-spline of the boundary polygon, the normal at V is that of the
///   limit; the interior is an approximation. Two faces give exactly the bicubic with reflected points. With one face
///   the derivatives at V are parallel, as they are on the limit surface.
///
/// # Panics
/// If `kind` is not valid.
pub fn gregory2(kind: NetKind) -> Matrix {
    let corners = corners(kind);
    let mut rows = Vec::with_capacity(20);
    for (i, at) in corners.iter().enumerate() {
        let (next, previous) = (&corners[(i + 1) % 4], &corners[(i + 3) % 4]);
        rows.push(at.position());
        rows.push(at.edge_point(at.plus()));
        rows.push(at.edge_point(at.minus()));
        rows.push(face_point((at, at.plus()), (next, next.minus()), 1.0));
        rows.push(face_point(
            (at, at.minus()),
            (previous, previous.plus()),
            -1.0,
        ));
    }
    Matrix::from_rows(&rows)
}

/// The face point beside the edge from corner `a` to corner `b`, each given with its ring edge towards the other;
/// `left` is 1 for the face left of a -> b, -1 for the one on its right.
///
/// With it the cross derivatives of the two faces add up to a linear function times the tangent of the edge, from
/// `2 cos` at a to `-2 cos` at b: both are cubics, so their tangent planes agree along the whole edge.
fn face_point((a, ea): (&Corner, i64), (b, eb): (&Corner, i64), left: f64) -> Weights {
    let (cos_a, cos_b) = (a.cosine(), b.cosine());
    let to_b = a.edge_point(ea);
    let to_a = b.edge_point(eb);
    combine(&[
        (cos_b / 3.0, &a.position()),
        (1.0 - (2.0 * cos_a + cos_b) / 3.0, &to_b),
        (2.0 * cos_a / 3.0, &to_a),
        (left / 3.0, &a.cross_inner(ea)),
    ])
}

/// The record of side `side`, walked from corner `side` to the next: 8 x net size. Rows 0..4 are the cubic Bezier curve
/// C, rows 4..8 the cubic Bezier form of the cross derivative D = (left - right)/2 per unit parameter, left being this
/// patch: the mean of the derivatives into this patch and out of the other. The surface normal on the edge is C' x D.
///
/// Both patches of an edge give the same record but for the direction: the neighbour's C is reversed, its D reversed
/// and negated. Sides 1 and 2 are bicubic B-spline edges, C = Bezier(m), D = Bezier(d) with m = (L+R)/6 + 2M/3 and
/// d = (L-R)/2 of the rows left, on and right of the edge. On a sharp side the missing rows are reflections.
///
/// # Panics
/// If `kind` is not valid or `side > 3`.
pub fn edge(kind: NetKind, side: usize) -> Matrix {
    assert!(side < 4, "a quad has sides 0 to 3, not {side}");
    let corners = corners(kind);
    let (a, b) = (&corners[side], &corners[(side + 1) % 4]);
    let (ea, eb) = (a.plus(), b.minus());
    let negated = |row: Weights| combine(&[(-1.0, &row)]);
    Matrix::from_rows(&[
        a.position(),
        a.edge_point(ea),
        b.edge_point(eb),
        b.position(),
        a.cross_end(ea),
        a.cross_inner(ea),
        negated(b.cross_inner(eb)),
        negated(b.cross_end(eb)),
    ])
}

/// Limit position and two tangents at corner `corner`: 3 x net size. Row 1 x row 2 is the outward normal.
///
/// # Panics
/// If `kind` is not valid or `corner > 3`.
pub fn vertex(kind: NetKind, corner: usize) -> Matrix {
    assert!(corner < 4, "a quad has corners 0 to 3, not {corner}");
    let at = &corners(kind)[corner];
    Matrix::from_rows(&[at.position(), at.tangent(0), at.tangent(1)])
}

fn corners(kind: NetKind) -> [Corner; 4] {
    assert!(
        kind.is_valid(),
        "{kind:?} does not exist: see NetKind::is_valid"
    );
    std::array::from_fn(|i| Corner::of(kind, i))
}
