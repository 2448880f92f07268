//! The eigenbasis of a side that leaves V, and its evaluation in f64: the records that two patches share.

use glam::DVec3;

use crate::bezier::{bernstein, bernstein_first};
use crate::bspline::TO_BEZIER;
use crate::matrix::Matrix;
use crate::net::NetKind;

use super::eigen::{Eigensystem, Expansion, Split};
use super::outer::Outer;
use super::place::Place;
use super::refine::{refined_points, step};

/// The limit surface along side 0 or 3 of a patch: the curve and the derivative across it.
///
/// The ring of V and the outer points around the side refine among themselves, so the side has an eigensystem of its
/// own: 2n+4 modes at valence n, 2k+5 in a sector of k faces, 2k+4 on a sharp side. Both patches of the side have
/// these points, and give the same record.
#[derive(Clone, Debug)]
pub struct Side {
    kind: NetKind,
    system: Eigensystem,
    basis: Matrix,
}

/// Point and derivatives on a side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SidePoint {
    /// The point.
    pub position: DVec3,
    /// Derivative of the curve.
    pub tangent: DVec3,
    /// Half the difference (left - right)/2 of the derivatives of the two patches across the side, both pointing away
    /// from it; `tangent x cross` points outwards. On a sharp side the other patch is the reflection of this one, which
    /// makes it the derivative of this patch.
    pub cross: DVec3,
}

impl Side {
    /// Builds the eigenstructure of side 0 (v = 0) or 3 (u = 0).
    ///
    /// Both are walked from V outwards, with `t` the parameter u or v: side 3 against its direction as a side of the
    /// patch, since levels follow from the distance to V alone. An inner edge is side 0 of the patch left of it and
    /// side 3 of the one on its right; the sharp edge V-Ek is side 3 of the last quad only.
    ///
    /// # Panics
    /// If `kind` is regular or not valid, or `side` is not 0 or 3 (the others have the records of
    /// [`crate::gregory::edge`], exactly).
    pub fn new(kind: NetKind, side: usize) -> Self {
        assert!(side == 0 || side == 3, "sides 0 and 3 leave V, side {side} does not");
        let step = step(kind);
        // Modes even or odd about the side: even ones move the curve, odd ones the derivative across.
        let axis = if side == 0 { 0 } else { 2 };
        let system = Eigensystem::new(kind, axis, Outer::of_side(kind, side, &step));
        let basis = system.basis(&to_bezier(), &refined_rows(kind, side, &step));
        Self { kind, system, basis }
    }

    /// The nets that this is for.
    pub fn kind(&self) -> NetKind {
        self.kind
    }

    /// The eigenvalues, ordered as those of [`super::Patch::eigenvalues`].
    pub fn eigenvalues(&self) -> &[f64] {
        &self.system.lambdas
    }

    /// As [`super::Patch::coupling`].
    pub fn coupling(&self) -> f64 {
        self.system.coupling
    }

    /// A row per mode over the points of the patch's net: the record is this matrix times the net. Row 0 is the limit
    /// position of V and sums to 1, the others sum to 0; points of the net that the other patch lacks weigh 0.
    pub fn projection(&self) -> &Matrix {
        &self.system.projection
    }

    /// The functions of the modes for t in [1/2, 1]: 8 x modes, rows 0..4 the cubic Bezier points of the curve, rows
    /// 4..8 those of the derivative across, per unit of the half side.
    pub fn basis(&self) -> &Matrix {
        &self.basis
    }

    /// The record for a net: the limit position of V, then a vector per mode.
    ///
    /// # Panics
    /// If the net is not of this kind.
    pub fn project(&self, net: &[DVec3]) -> Vec<DVec3> {
        self.system.project(net)
    }

    /// The point at t in 0..=1, from the result of [`Self::project`]. At V the derivatives, which do not exist, are zero.
    ///
    /// # Panics
    /// If there are not as many coefficients as modes.
    pub fn evaluate(&self, record: &[DVec3], t: f64) -> SidePoint {
        let Some((place, surface)) = self.expand(record, t) else {
            return SidePoint { position: record[0], ..SidePoint::default() };
        };
        SidePoint {
            position: surface.limit + surface.whole(curve(&surface, bernstein(place.u))),
            tangent: place.scale() * surface.whole(curve(&surface, bernstein_first(place.u))),
            cross: place.scale() * surface.whole(across(&surface, bernstein(place.u))),
        }
    }

    /// The unit normal at t, precise however near V; `None` at V and where the derivatives are parallel.
    ///
    /// # Panics
    /// If there are not as many coefficients as modes.
    pub fn normal(&self, record: &[DVec3], t: f64) -> Option<DVec3> {
        let (place, surface) = self.expand(record, t)?;
        let (tangent, cross) = (curve(&surface, bernstein_first(place.u)), across(&surface, bernstein(place.u)));
        surface.cross(tangent, cross).try_normalize()
    }

    fn expand(&self, record: &[DVec3], t: f64) -> Option<(Place, Expansion)> {
        let place = Place::of(t, 0.0)?;
        Some((place, self.system.expand(&self.basis, record, place.level)))
    }

    pub(super) fn system(&self) -> &Eigensystem {
        &self.system
    }
}

fn curve(surface: &Expansion, weights: [f64; 4]) -> Split {
    surface.combine(|i| if i < 4 { weights[i] } else { 0.0 })
}

fn across(surface: &Expansion, weights: [f64; 4]) -> Split {
    surface.combine(|i| if i < 4 { 0.0 } else { weights[i - 4] })
}

/// B-spline points of the curve, `(L + 4 M + R)/6`, and of the derivative across, `(L - R)/2`, over the net: from the
/// rows of refined points left of, on and right of the side.
fn refined_rows(kind: NetKind, side: usize, step: &Matrix) -> Matrix {
    let row = |across: i32| {
        let at = |along: i32| if side == 0 { (along, across) } else { (-across, along) };
        refined_points(kind, step, (0..4).map(at))
    };
    let (left, middle, right) = (row(1), row(0), row(-1));
    Matrix::from_fn(8, kind.net_size(), |r, c| {
        let [l, m, n] = [&left, &middle, &right].map(|points| points.get(r % 4, c));
        if r < 4 { (l + 4.0 * m + n) / 6.0 } else { (l - n) / 2.0 }
    })
}

fn to_bezier() -> Matrix {
    Matrix::from_fn(8, 8, |r, c| if r / 4 == c / 4 { TO_BEZIER[r % 4][c % 4] } else { 0.0 })
}
