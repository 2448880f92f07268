//! Gregory patches as linear maps of a net: control points, shared edges, corner limits.
//!
//! Two schemes share the rules: [`gregory2`] is one matrix per patch, for quads with one irregular corner; a cage that is
//! not refined at all is made from one matrix per vertex, [`Fan`], from which [`edge_record`], [`quad_points`] and
//! [`triangle_points`] take what they need.
//!
//! Loop, Schaefer, Ni and Castano, *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation*
//! (2009), section 3. Symbols kept: p (corner), e (edge point), f (face point), r (cross derivative), `+` towards the
//! next corner, `-` towards the previous one.

mod edge;
mod evaluate;
mod fan;
mod triangle;
mod vertex_fan;
mod whole;

pub use edge::{CrossEnd, edge};
pub use evaluate::{bezier_grid, evaluate};
pub use triangle::{evaluate_triangle, evaluate_triangle_frozen};
pub use vertex_fan::{Fan, FanEdge};
pub use whole::{Side, WholeCorner, edge_record, quad_points, triangle_points};

use crate::matrix::Matrix;
use crate::net::NetKind;
use fan::{Corner, Weights, combine};

/// The 20 control points of the bicubic Gregory patch: 20 x net size, row `5 i + {0: p, 1: e+, 2: e-, 3: f+, 4: f-}`
/// for corner i of (0,0), (1,0), (1,1), (0,1).
///
/// * `Regular`: exactly the bicubic B-spline patch (`f+ = f-`).
/// * `Interior`: tangent-plane continuous with its neighbours; position and tangent plane at V are those of the limit.
///   At valence 2 the edge points lie on one line through p, for the limit surface has no tangent plane there; the two
///   patches still share their edge curves and the normals along them, up to and including V.
/// * `Crease`: the sharp sides are exactly the cubic B-spline of the boundary polygon, position and tangent plane at V
///   are those of the limit along that curve; the interior is an approximation. Two faces give exactly the bicubic with
///   reflected points.
/// * `Crease` with one face: both sharp sides are exact, and as on the limit surface both derivatives at V are parallel.
///   The face point is that of the bicubic with reflected points. The normal of the patch at V is the limit normal for
///   a planar or parallelogram-shaped quad; otherwise it is off by the angle that the limit surface, whose normal
///   converges like 1/log of the distance, still shows at about 1/16 of the quad. [`vertex`] holds the limit.
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
        rows.push(face_point((at, at.minus()), (previous, previous.plus()), -1.0));
    }
    Matrix::from_rows(&rows)
}

/// The face point beside the edge from corner `a` to corner `b`, each given with its ring edge towards the other;
/// `left` is 1 for the face left of a -> b, -1 for the one on its right.
///
/// With it the cross derivatives of the two faces add up to a linear function times the tangent of the edge, from
/// `2 cos` at a to `-2 cos` at b: both are cubics, so their tangent planes agree along the whole edge.
///
/// Differs from Loop 2009 §5: a boundary side with three or more faces at V keeps `cos(pi/k)`, as if the surface went on
/// by reflection. The skew of the edge points at V then fades along the side, which takes a third to a
/// half off the normal error from 8 faces on and changes little below.
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
    assert!(kind.is_valid(), "{kind:?} does not exist: see NetKind::is_valid");
    std::array::from_fn(|i| Corner::of(kind, i))
}
