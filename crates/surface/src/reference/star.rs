//! A star: one vertex and the quads around it, refined as a whole. What a subdivision step does
//! around a vertex needs nothing but its star.

use std::borrow::Cow;

use glam::DVec3;

use super::Boundary;

/// A vertex and its ring of quads, counter-clockwise: quad `i` is (`centre`, `spokes[i]`,
/// `diagonals[i]`, `spokes[i + 1]`).
///
/// A closed star has as many spokes as quads. An open one, at the boundary, has one spoke more; its
/// first and last spokes are boundary edges. One of the quads is the core, the quad that the
/// descent is in; spokes and quads are asked for by their number counted from it.
#[derive(Clone, Debug)]
pub(super) struct Star {
    pub(super) centre: DVec3,
    pub(super) spokes: Vec<DVec3>,
    pub(super) diagonals: Vec<DVec3>,
    pub(super) core: usize,
}

/// How the limit surface behaves at the centre of a star.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// All around, any valence.
    Interior,
    /// On a smooth boundary curve.
    Crease,
    /// Fixed at the end of two boundary curves; it has a single quad.
    Corner,
}

impl Kind {
    fn of(spokes: usize, faces: usize, rule: Boundary) -> Self {
        match (spokes == faces, rule, faces) {
            (true, _, _) => Self::Interior,
            (false, Boundary::EdgeAndCorner, 1) => Self::Corner,
            (false, _, _) => Self::Crease,
        }
    }
}

impl Star {
    /// Whether the quads go all the way round.
    pub(super) fn is_closed(&self) -> bool {
        self.spokes.len() == self.diagonals.len()
    }

    /// What `rule` makes of the centre.
    pub(super) fn kind(&self, rule: Boundary) -> Kind {
        Kind::of(self.spokes.len(), self.diagonals.len(), rule)
    }

    /// Whether the surface around the centre is made of bicubic B-spline patches (with reflected
    /// points beyond a boundary).
    pub(super) fn is_regular(&self, rule: Boundary) -> bool {
        match self.kind(rule) {
            Kind::Interior => self.diagonals.len() == 4,
            Kind::Crease => self.diagonals.len() == 2,
            Kind::Corner => true,
        }
    }

    /// Spoke number `i` counted from the core quad's first; negative numbers are clockwise of it.
    /// `None` beyond the boundary.
    pub(super) fn spoke(&self, i: i32) -> Option<DVec3> {
        self.counted(&self.spokes, i)
    }

    /// The vertex opposite the centre in quad number `i` counted from the core.
    pub(super) fn diagonal(&self, i: i32) -> Option<DVec3> {
        self.counted(&self.diagonals, i)
    }

    fn counted(&self, points: &[DVec3], i: i32) -> Option<DVec3> {
        let index = self.core as i64 + i64::from(i);
        let index = if self.is_closed() { index.rem_euclid(points.len() as i64) } else { index };
        usize::try_from(index).ok().and_then(|index| points.get(index)).copied()
    }

    /// The core quad's side that leaves the centre.
    pub(super) fn leaving(&self) -> DVec3 {
        self.spokes[self.core]
    }

    /// The core quad's side that arrives at the centre.
    pub(super) fn arriving(&self) -> DVec3 {
        self.spokes[(self.core + 1) % self.spokes.len()]
    }

    /// The star around the same vertex one level finer.
    pub(super) fn refine(&self, rule: Boundary) -> Self {
        let n = self.spokes.len();
        let face_point =
            |i: usize| 0.25 * (self.centre + self.spokes[i] + self.diagonals[i] + self.spokes[(i + 1) % n]);
        let face_points = (0..self.diagonals.len()).map(face_point).collect();
        Ring { centre: self.centre, spokes: (&self.spokes).into(), face_points, core: self.core }.refine(rule)
    }

    /// Moves all points by `-origin`.
    pub(super) fn subtract(&mut self, origin: DVec3) {
        self.centre -= origin;
        for point in self.spokes.iter_mut().chain(&mut self.diagonals) {
            *point -= origin;
        }
    }
}

/// What refining a vertex needs to know of the faces around it, which may have any size.
/// Counter-clockwise and open or closed as a [`Star`].
pub(super) struct Ring<'a> {
    pub(super) centre: DVec3,
    /// The neighbours along the edges.
    pub(super) spokes: Cow<'a, [DVec3]>,
    /// The centroids of the faces.
    pub(super) face_points: Vec<DVec3>,
    pub(super) core: usize,
}

impl Ring<'_> {
    /// The star around the vertex one level finer: its new neighbours are edge points and face
    /// points.
    pub(super) fn refine(self, rule: Boundary) -> Star {
        let spokes = (0..self.spokes.len()).map(|i| self.edge_point(i)).collect();
        Star { centre: self.vertex_point(rule), spokes, diagonals: self.face_points, core: self.core }
    }

    fn edge_point(&self, i: usize) -> DVec3 {
        let faces = self.face_points.len();
        let is_boundary = self.spokes.len() > faces && (i == 0 || i == faces);
        let beside = || [(i + faces - 1) % faces, i].map(|face| self.face_points[face]);
        edge_point([self.centre, self.spokes[i]], (!is_boundary).then(beside))
    }

    /// Weights (n-2)/n, 1/n^2, 1/n^2 of the vertex, its n neighbours and its n face points; on the
    /// boundary 6:1:1 along the boundary.
    pub(super) fn vertex_point(&self, rule: Boundary) -> DVec3 {
        match Kind::of(self.spokes.len(), self.face_points.len(), rule) {
            Kind::Corner => self.centre,
            Kind::Crease => (6.0 * self.centre + self.spokes[0] + self.spokes[self.spokes.len() - 1]) / 8.0,
            Kind::Interior => {
                let n = self.face_points.len() as f64;
                let ring = self.spokes.iter().sum::<DVec3>() + self.face_points.iter().sum::<DVec3>();
                (n - 2.0) / n * self.centre + ring / (n * n)
            }
        }
    }
}

/// The new point on an edge: the mean of both ends and both face points beside it, on the boundary
/// the midpoint.
pub(super) fn edge_point(ends: [DVec3; 2], beside: Option<[DVec3; 2]>) -> DVec3 {
    let ends = ends[0] + ends[1];
    beside.map_or(0.5 * ends, |[right, left]| 0.25 * (ends + right + left))
}
