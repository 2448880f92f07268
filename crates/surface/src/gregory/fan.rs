//! The one-ring of a patch corner in terms of the patch's net, and what Gregory patches read from it.

use glam::DVec3;

use crate::angle::turn;
use crate::masks;
use crate::matrix::Matrix;
use crate::net::{NetKind, Point};

use super::edge::CrossEnd;
use super::vertex_fan::Fan;

/// A row of weights over the points of a net.
pub(super) type Weights = Vec<f64>;

/// Points, or rows of weights that stand for points.
pub(super) trait Combine: Clone {
    /// The combination `sum factor * row`; rows are of equal length.
    fn combine(terms: &[(f64, &Self)]) -> Self;
}

impl Combine for Weights {
    fn combine(terms: &[(f64, &Self)]) -> Self {
        let mut out = vec![0.0; terms[0].1.len()];
        for &(factor, row) in terms {
            for (o, w) in out.iter_mut().zip(row) {
                *o += factor * w;
            }
        }
        out
    }
}

impl Combine for DVec3 {
    fn combine(terms: &[(f64, &Self)]) -> Self {
        terms.iter().map(|&(factor, &point)| factor * point).sum()
    }
}

/// [`Combine::combine`] of rows.
pub(super) fn combine(terms: &[(f64, &Weights)]) -> Weights {
    Weights::combine(terms)
}

/// A corner of a patch with its ring of edges, counter-clockwise.
///
/// Edge i leaves the corner at the angle `i * step` of the tangent plane, with `step` = 2 pi / n around an interior
/// vertex, pi / k in the k faces of a boundary vertex and pi / 2 in a corner that stays where it is.
pub(super) struct Corner {
    net_size: usize,
    /// The corner, then edge and face neighbours alternating: E0, F0, E1, ..
    ring: Vec<Point>,
    /// Position and tangents over `ring`.
    mask: Matrix,
    /// Number of faces.
    faces: i64,
    /// Whether the ring ends at a boundary.
    open: bool,
    /// `step` as a part of a full turn: 2 pi over this.
    steps_in_turn: i64,
    /// The ring edge that is the patch's side towards the next corner.
    plus: i64,
}

impl Corner {
    /// Corner `i` of the patch.
    pub(super) fn of(kind: NetKind, i: usize) -> Self {
        match (kind, i) {
            (NetKind::Interior { valence }, 0) => Self::at_vertex(kind, masks::interior(valence), valence, false),
            (NetKind::Crease { faces, .. }, 0) => Self::at_vertex(kind, masks::crease(faces), faces, true),
            _ => Self::regular(kind, i),
        }
    }

    /// Corner 0 of an irregular net: the ring is the net's first points.
    fn at_vertex(kind: NetKind, mask: Matrix, faces: u32, open: bool) -> Self {
        let net_size = kind.net_size();
        let faces = i64::from(faces);
        let steps_in_turn = if open { 2 * faces } else { faces };
        Self { net_size, ring: whole(&mask), mask, faces, open, steps_in_turn, plus: kind.quad() }
    }

    /// A vertex alone: its net is its ring.
    pub(super) fn of_fan(fan: Fan) -> Self {
        let mask = match fan {
            Fan::Interior { valence } => masks::interior(valence),
            Fan::Crease { faces } => masks::crease(faces),
            Fan::Corner => masks::corner(),
        };
        let (faces, open, steps_in_turn) = match fan {
            Fan::Interior { valence } => (valence.into(), false, valence.into()),
            Fan::Crease { faces } => (faces.into(), true, 2 * i64::from(faces)),
            Fan::Corner => (1, true, 4),
        };
        Self { net_size: mask.cols(), ring: whole(&mask), mask, faces, open, steps_in_turn, plus: 0 }
    }

    /// A corner of valence 4 on the grid, starting with the edge to the next corner.
    fn regular(kind: NetKind, i: usize) -> Self {
        let (x, y) = [(0, 0), (1, 0), (1, 1), (0, 1)][i];
        let (mut dx, mut dy) = [(1, 0), (0, 1), (-1, 0), (0, -1)][i];
        let mut ring = vec![kind.grid(x, y)];
        for _ in 0..4 {
            ring.push(kind.grid(x + dx, y + dy));
            ring.push(kind.grid(x + dx - dy, y + dy + dx));
            (dx, dy) = (-dy, dx);
        }
        let mask = masks::interior(4);
        Self { net_size: kind.net_size(), ring, mask, faces: 4, open: false, steps_in_turn: 4, plus: 0 }
    }

    /// The ring edge towards the next corner of the patch.
    pub(super) fn plus(&self) -> i64 {
        self.plus
    }

    /// The ring edge towards the previous corner of the patch.
    pub(super) fn minus(&self) -> i64 {
        self.plus + 1
    }

    /// Cosine of the angle between neighbouring edges, by which faces share their cross derivatives. A single face
    /// shares with none: 0, as at a regular corner.
    pub(super) fn cosine(&self) -> f64 {
        if self.is_single_face() { 0.0 } else { self.direction(1).0 }
    }

    /// Whether the corner belongs to one face only, which spans a straight angle in the tangent plane.
    pub(super) fn is_single_face(&self) -> bool {
        self.open && self.steps_in_turn == 2
    }

    /// Whether neighbouring edges leave in opposite directions: cross derivatives vanish here.
    pub(super) fn is_flat(&self) -> bool {
        self.direction(1) == (-1.0, 0.0)
    }

    /// `(cos, sin)` of the angle of edge i.
    fn direction(&self, i: i64) -> (f64, f64) {
        turn(i, self.steps_in_turn)
    }

    /// What an edge has to do about its cross derivative here.
    pub(super) fn cross_end_kind(&self) -> CrossEnd {
        match (self.is_single_face(), self.is_flat()) {
            (true, _) => CrossEnd::Opposed,
            (false, true) => CrossEnd::Vanishing,
            (false, false) => CrossEnd::Plain,
        }
    }

    /// The limit position.
    pub(super) fn position(&self) -> Weights {
        self.expand(0)
    }

    /// Tangent 0 or 1: see [`masks`].
    pub(super) fn tangent(&self, which: usize) -> Weights {
        self.expand(1 + which)
    }

    /// The point e of edge i: `p + (cos t0 + sin t1) / 3`.
    pub(super) fn edge_point(&self, i: i64) -> Weights {
        let (cos, sin) = self.direction(i);
        combine(&[(1.0, &self.position()), (cos / 3.0, &self.tangent(0)), (sin / 3.0, &self.tangent(1))])
    }

    /// Bezier point 0 of the cross derivative D of edge i walked outwards: `3 (e(i+1) - e(i-1)) / 2`, written without
    /// the cancellation that many edges would bring.
    pub(super) fn cross_end(&self, i: i64) -> Weights {
        let ((cos, sin), step) = (self.direction(i), self.direction(1).1);
        combine(&[(-step * sin, &self.tangent(0)), (step * cos, &self.tangent(1))])
    }

    /// Bezier point 1 of the cross derivative of edge i walked outwards: r of Loop 2009, `(E(i+1) - E(i-1))/3 +
    /// (F(i) - F(i-1))/6`, with points beyond a boundary reflected.
    pub(super) fn cross_inner(&self, i: i64) -> Weights {
        let mut row = vec![0.0; self.net_size];
        self.edge(i + 1).add_to(&mut row, 1.0 / 3.0);
        self.edge(i - 1).add_to(&mut row, -1.0 / 3.0);
        self.face(i).add_to(&mut row, 1.0 / 6.0);
        self.face(i - 1).add_to(&mut row, -1.0 / 6.0);
        row
    }

    /// Edge neighbour i, reflected in the corner when it is beyond the boundary.
    fn edge(&self, i: i64) -> Point {
        let at = |i: i64| &self.ring[1 + 2 * i as usize];
        match (self.open, i) {
            (false, _) => at(i.rem_euclid(self.faces)).clone(),
            (true, -1) => Point::reflected(&self.ring[0], at(1)),
            (true, _) if i > self.faces => Point::reflected(&self.ring[0], at(self.faces - 1)),
            (true, _) => at(i).clone(),
        }
    }

    /// The far point of the face between edges i and i+1, reflected in the boundary edge when it is beyond it.
    fn face(&self, i: i64) -> Point {
        let at = |i: i64| &self.ring[2 + 2 * i as usize];
        match (self.open, i) {
            (false, _) => at(i.rem_euclid(self.faces)).clone(),
            (true, -1) => Point::reflected(&self.edge(0), at(0)),
            (true, _) if i == self.faces => Point::reflected(&self.edge(i), at(i - 1)),
            (true, _) => at(i).clone(),
        }
    }

    /// A row of the mask as weights over the net.
    fn expand(&self, row: usize) -> Weights {
        let mut out = vec![0.0; self.net_size];
        for (point, &weight) in self.ring.iter().zip(self.mask.row(row)) {
            point.add_to(&mut out, weight);
        }
        out
    }
}

/// The points of a ring that is the beginning of its net.
fn whole(mask: &Matrix) -> Vec<Point> {
    (0..mask.cols()).map(Point::at).collect()
}
