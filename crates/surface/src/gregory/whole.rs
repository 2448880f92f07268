//! Gregory patches of a mesh that is not refined: quads with 20 points, triangles with 15, any valence at any corner.
//!
//! Loop, Schaefer, Ni and Castano, *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation*
//! (2009), sections 3 and 4. All of it is gathered from the [`Fan`](super::Fan)s of the corners.

use glam::DVec3;

use super::edge::{CrossEnd, settle_ends};
use super::fan::Combine;

/// What one end of an edge contributes: rows of its vertex's fan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Limit position p of the vertex.
    pub position: DVec3,
    /// Edge point e.
    pub edge_point: DVec3,
    /// Inner cross vector r.
    pub cross_inner: DVec3,
    /// Cross derivative at the vertex.
    pub cross_end: DVec3,
}

/// The corner of a patch: the edges to the next and to the previous corner, walked away from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeCorner {
    /// The edge to the next corner.
    pub plus: Side,
    /// The edge to the previous corner.
    pub minus: Side,
    /// [`Fan::cosine`](super::Fan::cosine).
    pub cosine: f64,
}

/// Curve C and cross derivative D of the edge from `a` to `b`, as cubic Bezier points: what [`edge`](super::edge) is for
/// nets of one irregular corner. D is gathered without any arithmetic unless an end is flat. Boundary edges are walked
/// with their face on the left.
pub fn edge_record(a: (&Side, CrossEnd), b: (&Side, CrossEnd)) -> ([DVec3; 4], [DVec3; 4]) {
    let ((a, a_end), (b, b_end)) = (a, b);
    let curve = [a.position, a.edge_point, b.edge_point, b.position];
    let cross = [a.cross_end, a.cross_inner, -b.cross_inner, -b.cross_end];
    (curve, settle_ends(cross, &curve, [a_end, b_end]))
}

/// The 20 points of a quad: `5 i + {0: p, 1: e+, 2: e-, 3: f+, 4: f-}` for corner i of (0,0), (1,0), (1,1), (0,1).
pub fn quad_points(corners: &[WholeCorner; 4]) -> [DVec3; 20] {
    let points = control_points(corners);
    std::array::from_fn(|k| points[k / 5][k % 5])
}

/// The 15 points of a triangle: `5 i + {0: p, 1: e+, 2: e-, 3: f+, 4: f-}` for corner i. p and e are points of cubics,
/// f of a quartic.
pub fn triangle_points(corners: &[WholeCorner; 3]) -> [DVec3; 15] {
    let points = control_points(corners);
    std::array::from_fn(|k| points[k / 5][k % 5])
}

/// Five points for each corner of a patch with `N` sides.
fn control_points<const N: usize>(corners: &[WholeCorner; N]) -> [[DVec3; 5]; N] {
    std::array::from_fn(|i| {
        let (at, next, previous) = (&corners[i], &corners[(i + 1) % N], &corners[(i + N - 1) % N]);
        let f_plus = face_point(N, (&at.plus, at.cosine), (&next.minus, next.cosine), 1.0);
        let f_minus = face_point(N, (&at.minus, at.cosine), (&previous.plus, previous.cosine), -1.0);
        [at.plus.position, at.plus.edge_point, at.minus.edge_point, f_plus, f_minus]
    })
}

/// The face point beside the edge from `a` to `b`, each with the cosine of its vertex; `left` is 1 for the face left of
/// a -> b, -1 for the one on its right.
///
/// `f = (cos_b p + (d - 2 cos_a - cos_b) e + 2 cos_a e_b + left r) / d`, d = 3 for quads and 4 for triangles, written with
/// differences from e so that nothing cancels far from the origin. With it the cross derivatives of the two faces add up
/// to a linear function times the tangent of the edge, from `2 cos_a` to `-2 cos_b`: a triangle's is the quad's plus `t`
/// times the tangent, so quads and triangles mix freely.
///
/// Differs from Loop 2009 section 5: boundary edges keep the cosines of their ends, as if the surface went on by
/// reflection; the edge record then has the normals of the patch, as everywhere else.
fn face_point(sides: usize, (a, cos_a): (&Side, f64), (b, cos_b): (&Side, f64), left: f64) -> DVec3 {
    let degree = if sides == 3 { 4.0 } else { 3.0 };
    let (to_corner, to_end) = (a.position - a.edge_point, b.edge_point - a.edge_point);
    let steps = [(cos_b, &to_corner), (2.0 * cos_a, &to_end), (left, &a.cross_inner)];
    a.edge_point + DVec3::combine(&steps) / degree
}
