//! The nets of control points that patches are evaluated from, and the order of their points.
//!
//! ```text
//!  O6(-1,2)----O5(0,2)----O4(1,2)----O3(2,2)    grid coordinates (x,y) about the quad (V, Ej, Fj, Ej+1);
//!     |           |          |          |       j = 0 for a smooth interior vertex
//!  Fj+1(-1,1)--Ej+1(0,1)---Fj(1,1)----O2(2,1)
//!     |           |   PATCH  |          |
//!  Ej+2(-1,0)-----V--------Ej(1,0)----O1(2,0)
//!               / |          |          |
//!                Ej-1(0,-1)-Fj-1(1,-1)-O0(2,-1)
//! ```

/// What surrounds corner 0 (the vertex V) of a quad whose other three corners are regular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum NetKind {
    /// The 16-point grid net of a bicubic B-spline patch, index `(x+1) + 4 (y+1)` for x, y in -1..=2. Points beyond a
    /// boundary are reflected points (`2a - b`) that the caller supplies.
    Regular,
    /// V is an interior vertex of `valence` >= 2 edges. `2n+8` points: V, E0, F0, .., E(n-1), F(n-1), O0..O6.
    Interior {
        /// Number of edges at V.
        valence: u32,
    },
    /// V lies on a boundary (or on a sharp crease, seen from one side) that follows the 1:6:1 rule. The points are V,
    /// E0, F0, .., F(k-1), Ek and O0..O6, without O0 for the first quad and without O6 for the last: those lie beyond
    /// the boundary.
    Crease {
        /// Number k >= 1 of faces at V on this side.
        faces: u32,
        /// Which of them, counted counter-clockwise from the boundary edge V-E0; less than `faces`.
        quad: u32,
    },
}

impl NetKind {
    /// Whether the valence or the sector exists: valence >= 2, faces >= 1, quad < faces.
    pub fn is_valid(self) -> bool {
        match self {
            Self::Regular => true,
            Self::Interior { valence } => valence >= 2,
            Self::Crease { faces, quad } => faces >= 1 && quad < faces,
        }
    }

    /// Number of points of the net: 16, `2n+8`, or `2k+9` less the points beyond the boundary.
    pub fn net_size(self) -> usize {
        match self {
            Self::Regular => 16,
            Self::Interior { valence } => 2 * valence as usize + 8,
            Self::Crease { faces, .. } => {
                2 * faces as usize + 9 - usize::from(self.side_is_sharp(0)) - usize::from(self.side_is_sharp(3))
            }
        }
    }

    /// Whether side `side` of the patch lies on the sharp curve through V, so that it has a face on one side only.
    ///
    /// A boundary of the `Regular` kind is not visible here: its reflected points make it look like an interior edge.
    pub fn side_is_sharp(self, side: usize) -> bool {
        match (self, side) {
            (Self::Crease { quad, .. }, 0) => quad == 0,
            (Self::Crease { faces, quad }, 3) => quad + 1 == faces,
            _ => false,
        }
    }
}

/// A point as a combination of a few points of a net: one point, or the reflection `2a - b`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Point(Vec<(usize, f64)>);

impl Point {
    /// The net point with index `i`.
    pub(crate) fn at(i: usize) -> Self {
        Self(vec![(i, 1.0)])
    }

    /// The point `2 mirror - inner`, the reflection of `inner` beyond a boundary.
    pub(crate) fn reflected(mirror: &Self, inner: &Self) -> Self {
        let (m, n) = (mirror.0.iter().map(|&(i, w)| (i, 2.0 * w)), inner.0.iter().map(|&(i, w)| (i, -w)));
        Self(m.chain(n).collect())
    }

    /// Adds `weight` times this point to a row of weights over the net.
    pub(crate) fn add_to(&self, row: &mut [f64], weight: f64) {
        for &(i, w) in &self.0 {
            row[i] += weight * w;
        }
    }
}

/// Grid coordinates of O0..O6.
const OUTER: [(i32, i32); 7] = [(2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];

impl NetKind {
    /// The grid point (x, y), x and y in -1..=2, with points beyond the boundary through V reflected.
    ///
    /// # Panics
    /// For (-1, -1) unless the net is regular: there is no such point.
    pub(crate) fn grid(self, x: i32, y: i32) -> Point {
        match self {
            Self::Regular => Point::at(((x + 1) + 4 * (y + 1)) as usize),
            _ if y < 0 && self.side_is_sharp(0) => Point::reflected(&self.grid(x, 0), &self.grid(x, 1)),
            _ if x < 0 && self.side_is_sharp(3) => Point::reflected(&self.grid(0, y), &self.grid(1, y)),
            _ => Point::at(self.grid_index(x, y)),
        }
    }

    fn grid_index(self, x: i32, y: i32) -> usize {
        if let Some(o) = OUTER.iter().position(|&at| at == (x, y)) {
            return self.outer_start() + o;
        }
        let j = self.quad();
        match (x, y) {
            (0, 0) => 0,
            (1, 0) => self.edge_index(j),
            (1, 1) => self.face_index(j),
            (0, 1) => self.edge_index(j + 1),
            (-1, 1) => self.face_index(j + 1),
            (-1, 0) => self.edge_index(j + 2),
            (0, -1) => self.edge_index(j - 1),
            (1, -1) => self.face_index(j - 1),
            _ => panic!("the {self:?} net has no grid point ({x}, {y})"),
        }
    }

    /// Index of the (possibly missing) point O0.
    fn outer_start(self) -> usize {
        match self {
            Self::Regular => 0,
            Self::Interior { valence } => 2 * valence as usize + 1,
            Self::Crease { faces, .. } => 2 * faces as usize + 2 - usize::from(self.side_is_sharp(0)),
        }
    }

    /// Which quad around V the patch is.
    pub(crate) fn quad(self) -> i64 {
        match self {
            Self::Crease { quad, .. } => i64::from(quad),
            _ => 0,
        }
    }

    fn edge_index(self, i: i64) -> usize {
        match self {
            Self::Interior { valence } => 1 + 2 * i.rem_euclid(i64::from(valence)) as usize,
            _ => 1 + 2 * i as usize,
        }
    }

    fn face_index(self, i: i64) -> usize {
        self.edge_index(i) + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_follow_the_layouts() {
        assert_eq!(NetKind::Regular.net_size(), 16);
        assert_eq!(NetKind::Interior { valence: 5 }.net_size(), 18);
        let crease = |faces, quad| NetKind::Crease { faces, quad }.net_size();
        assert_eq!([crease(1, 0), crease(2, 0), crease(2, 1), crease(3, 1), crease(5, 4)], [9, 12, 12, 15, 18]);
    }

    #[test]
    fn impossible_kinds_are_invalid() {
        assert!(!NetKind::Interior { valence: 1 }.is_valid());
        assert!(!NetKind::Crease { faces: 3, quad: 3 }.is_valid());
        assert!(!NetKind::Crease { faces: 0, quad: 0 }.is_valid());
        assert!(NetKind::Crease { faces: 1, quad: 0 }.is_valid());
    }

    #[test]
    fn every_net_point_but_those_behind_the_vertex_is_on_the_grid() {
        for kind in [NetKind::Interior { valence: 3 }, NetKind::Crease { faces: 3, quad: 1 }] {
            let mut seen = vec![0; kind.net_size()];
            for (x, y) in (-1..=2).flat_map(|y| (-1..=2).map(move |x| (x, y))).filter(|&at| at != (-1, -1)) {
                seen[kind.grid_index(x, y)] += 1;
            }
            // At three edges or faces (-1,0) and (0,-1), or (-1,1) and (1,-1), may be the same point.
            assert!(seen.iter().all(|&n| n >= 1), "{kind:?}: {seen:?}");
        }
    }

    #[test]
    fn first_quad_reflects_below_and_last_to_the_left() {
        let kind = NetKind::Crease { faces: 1, quad: 0 };
        let mut row = [0.0; 9];
        kind.grid(1, -1).add_to(&mut row, 1.0); // 2 E0 - F0
        kind.grid(-1, 0).add_to(&mut row, 1.0); // 2 V - E0
        assert_eq!(row, [2.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(kind.grid(2, 0), Point::at(4)); // O1 follows E1
    }
}
